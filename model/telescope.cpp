// The telescope, and what diffraction makes of its distances.
#include "model/telescope.hpp"

#include "model/input_error.hpp"

#include <cassert>
#include <cmath>

namespace nlcwfs {

void Telescope::validate() const {
  require(diameter > 0.0 && std::isfinite(diameter), "telescope.diameter", diameter,
          "a length above 0, such as 0.5 or 500mm");
  require(wavelength > 0.0 && std::isfinite(wavelength), "telescope.wavelength", wavelength,
          "a length above 0, such as 532nm");
  require(central_obscuration >= 0.0 && central_obscuration < 1.0, "telescope.central_obscuration",
          central_obscuration, "a fraction of the diameter, at least 0 and below 1");
  if (relay_beam_diameter && !(*relay_beam_diameter > 0.0 && std::isfinite(*relay_beam_diameter))) {
    throw InputError("telescope.relay_beam_diameter", *relay_beam_diameter,
                     "a length above 0, such as 10mm, or nothing");
  }
}

double talbot_distance(double period, double wavelength) {
  return 2.0 * period * period / wavelength;
}

double fresnel_number(const Telescope& telescope, double distance) {
  return telescope.diameter * telescope.diameter / (telescope.wavelength * distance);
}

double distance_at_fresnel_number(const Telescope& telescope, double fresnel_number) {
  return telescope.diameter * telescope.diameter / (telescope.wavelength * fresnel_number);
}

double scaled_distance(double distance, const Telescope& from, const Telescope& to) {
  const double diameter_ratio = to.diameter / from.diameter;
  return distance * diameter_ratio * diameter_ratio * (from.wavelength / to.wavelength);
}

double bench_distance(double distance, const Telescope& telescope) {
  assert(telescope.relay_beam_diameter);
  const double compression = *telescope.relay_beam_diameter / telescope.diameter;
  return distance * compression * compression;
}

}  // namespace nlcwfs
