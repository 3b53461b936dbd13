// The turbulence that a telescope looks through, and the theory of its phase.
#include "model/seeing.hpp"

#include "model/input_error.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/bessel.hpp>

namespace nlcwfs {
namespace {

/// Von Karman's structure function over Kolmogorov's, with x = 2 pi r / L0 < 2.
///
/// 1 - B(r) / B(0) would cancel here. This is the power series that
/// K_nu = pi / (2 sin(nu pi)) (I_-nu - I_nu) leaves once its leading 1 is taken out
/// (DLMF 10.25.2, 10.27.4).
double von_karman_over_kolmogorov(double x) {
  const double q = x * x / 4.0;
  double even_term = 1.0;
  double odd_term = std::tgamma(11.0 / 6.0) / std::tgamma(7.0 / 6.0);
  double even_sum = even_term;
  double odd_sum = odd_term;
  for (int k = 1; k <= 12; ++k) {
    even_term *= q / (k * (k + 5.0 / 6.0));
    odd_term *= q / ((k + 1) * (k + 1.0 / 6.0));
    even_sum += even_term;
    odd_sum += odd_term;
  }
  return even_sum - std::pow(q, 1.0 / 6.0) * odd_sum;
}

/// B(r) / B(0), with x = 2 pi r / L0 > 0.
double von_karman_correlation(double x) {
  constexpr double nu = 5.0 / 6.0;
  return std::pow(2.0, 1.0 - nu) / std::tgamma(nu) * std::pow(x, nu) *
         boost::math::cyl_bessel_k(nu, x);
}

}  // namespace

void Seeing::validate() const {
  require(fried_parameter > 0.0 && std::isfinite(fried_parameter), "seeing.fried_parameter",
          fried_parameter, "a length above 0, such as 0.125 or 12.5cm");
  if (outer_scale && !(*outer_scale > 0.0 && std::isfinite(*outer_scale))) {
    throw InputError("seeing.outer_scale", *outer_scale,
                     "a length above 0, such as 25m, or nothing for an infinite outer scale");
  }
}

double fried_parameter_of_fwhm(double fwhm, double wavelength) {
  constexpr double radians_per_arcsecond = std::numbers::pi / (180.0 * 3600.0);
  return 0.976 * wavelength / (fwhm * radians_per_arcsecond);
}

double scaled_fried_parameter(double fried_parameter, double from_wavelength,
                              double to_wavelength) {
  return fried_parameter * std::pow(to_wavelength / from_wavelength, 6.0 / 5.0);
}

double kolmogorov_structure_function(double separation, double fried_parameter) {
  assert(separation >= 0.0);
  return 6.88 * std::pow(separation / fried_parameter, 5.0 / 3.0);
}

double von_karman_structure_function(double separation, const Seeing& seeing) {
  if (!seeing.outer_scale) return kolmogorov_structure_function(separation, seeing.fried_parameter);
  const double x = 2.0 * std::numbers::pi * separation / *seeing.outer_scale;
  if (x < 2.0) {
    return kolmogorov_structure_function(separation, seeing.fried_parameter) *
           von_karman_over_kolmogorov(x);
  }
  const double saturation = kolmogorov_structure_function(*seeing.outer_scale / std::numbers::pi,
                                                          seeing.fried_parameter) *
                            std::tgamma(11.0 / 6.0) / std::tgamma(1.0 / 6.0);
  return saturation * (1.0 - von_karman_correlation(x));
}

double greenwood_frequency(double wind_speed, double fried_parameter) {
  return 0.427 * wind_speed / fried_parameter;
}

double servo_lag_variance(double delay, double greenwood_frequency) {
  assert(delay >= 0.0);
  return 28.4 * std::pow(delay * greenwood_frequency, 5.0 / 3.0);
}

double noll_piston_removed_variance(double diameter, double fried_parameter) {
  return 1.0299 * std::pow(diameter / fried_parameter, 5.0 / 3.0);
}

double noll_tilt_removed_variance(double diameter, double fried_parameter) {
  return 0.134 * std::pow(diameter / fried_parameter, 5.0 / 3.0);
}

}  // namespace nlcwfs
