// The turbulence that a telescope looks through, and the theory of its phase.
#pragma once

#include <optional>

namespace nlcwfs {

/// The turbulence that the telescope looks through: Kolmogorov, or von Karman with an outer scale.
struct Seeing {
  double fried_parameter = 0.0;            ///< r0 at the telescope's wavelength, m, above 0
  std::optional<double> outer_scale = {};  ///< L0, m; absent = infinite (Kolmogorov)

  /// @throws InputError where a value is not physical
  void validate() const;
};

/// Fried parameter in m of a long-exposure seeing disc: r0 = 0.976 lambda / FWHM.
/// @param fwhm        full width at half maximum, arcsec
/// @param wavelength  where the FWHM holds, m; the result holds there too
/// It is the width of the image that Fried's long-exposure transfer function gives (1966, JOSA 56,
/// 1372; infinite outer scale).
double fried_parameter_of_fwhm(double fwhm, double wavelength);

/// The same turbulence's Fried parameter in m at another wavelength: r0' = r0
/// (lambda'/lambda)^(6/5). Source: Fried 1966, JOSA 56, 1372.
double scaled_fried_parameter(double fried_parameter, double from_wavelength, double to_wavelength);

/// Mean squared phase difference in rad^2 of two points: D(r) = 6.88 (r/r0)^(5/3).
/// @param separation       r >= 0, m
/// @param fried_parameter  r0, m
/// Source: Fried 1966, JOSA 56, 1372.
double kolmogorov_structure_function(double separation, double fried_parameter);

/// The same with the outer scale L0 of `seeing` (where absent, it is Kolmogorov's):
/// D(r) = 2 (B(0) - B(r)), B(r) proportional to x^(5/6) K_(5/6)(x), x = 2 pi r / L0, scaled so that
/// D tends to 6.88 (r/r0)^(5/3) as L0 grows. To rounding for every r / L0.
/// @param separation  r >= 0, m
/// Source: Conan 2008, JOSA A 25, 526.
double von_karman_structure_function(double separation, const Seeing& seeing);

/// Greenwood frequency in Hz of a single frozen layer: f_G = 0.427 v / r0.
/// @param wind_speed       v, m/s
/// @param fried_parameter  r0, m
/// Source: Greenwood 1977, JOSA 67, 390.
double greenwood_frequency(double wind_speed, double fried_parameter);

/// Mean squared phase in rad^2 by which Kolmogorov turbulence changes at a point during a delay:
/// 28.4 (tau f_G)^(5/3). For a single frozen layer it is the structure function at v tau, since
/// 28.4 = 6.88 / 0.427^(5/3). It counts all of the change, also that of piston and tilt: an upper
/// bound for a pupil of finite size.
/// @param delay                tau >= 0, s
/// @param greenwood_frequency  f_G, Hz
/// Source: Fried 1990, JOSA A 7, 1224.
double servo_lag_variance(double delay, double greenwood_frequency);

/// Kolmogorov phase variance in rad^2 over a circular pupil, piston removed:
/// 1.0299 (D/r0)^(5/3). Source: Noll 1976, JOSA 66, 207, table IV.
double noll_piston_removed_variance(double diameter, double fried_parameter);

/// The same with piston, tip and tilt removed: 0.134 (D/r0)^(5/3). Source: Noll 1976, table IV.
double noll_tilt_removed_variance(double diameter, double fried_parameter);

}  // namespace nlcwfs
