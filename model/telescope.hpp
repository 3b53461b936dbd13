// The telescope, and what diffraction makes of its distances.
#pragma once

#include <optional>

namespace nlcwfs {

/// The telescope whose beam the sensor sees, and the wavelength that it works at.
struct Telescope {
  double diameter = 0.5;                           ///< pupil diameter D, m
  double wavelength = 532e-9;                      ///< m
  double central_obscuration = 0.0;                ///< obscured diameter over D, 0 <= eps < 1
  std::optional<double> relay_beam_diameter = {};  ///< beam diameter d behind a relay, m

  /// @throws InputError where a value is not physical
  void validate() const;
};

/// Talbot distance Z_T = 2 a^2 / lambda in m: where a phase of period a images itself.
/// @param period      a, m (the Fried parameter for a seeing condition's reference distance)
/// @param wavelength  m
/// Source: Letchev et al. 2022, eq. 1.
double talbot_distance(double period, double wavelength);

/// Fresnel number N_F = D^2 / (lambda Z), dimensionless and signed like Z; infinite at Z = 0.
/// Designs with equal Fresnel numbers are equal designs. (Letchev et al. 2022 print D^2 Z / lambda,
/// which is not dimensionless.)
/// @param distance  Z, m from the pupil
double fresnel_number(const Telescope& telescope, double distance);

/// The distance in m at which a telescope sees a given Fresnel number: Z = D^2 / (lambda N_F).
double distance_at_fresnel_number(const Telescope& telescope, double fresnel_number);

/// The distance with the same Fresnel number at another telescope:
/// Z' = Z (D'/D)^2 (lambda/lambda'), m.
double scaled_distance(double distance, const Telescope& from, const Telescope& to);

/// Where a plane stands on the bench behind a relay that compresses the beam to diameter d:
/// z_bench = Z (d/D)^2, m, the same Fresnel number at the same wavelength.
/// @pre telescope.relay_beam_diameter is set
double bench_distance(double distance, const Telescope& telescope);

}  // namespace nlcwfs
