// Widths that grids may have: bounded, and with small prime factors.
#include "model/grid_width.hpp"

#include "model/input_error.hpp"

#include <cmath>

namespace nlcwfs {

int grid_width(double window, int samples_per_diameter) {
  return static_cast<int>(std::lround(window * samples_per_diameter));
}

void validate_grid_window(std::string_view window_key, double window, std::string_view samples_key,
                          int samples_per_diameter) {
  require(window >= 1.0 && std::isfinite(window), window_key, window, "at least 1 pupil diameter");
  const double samples = window * samples_per_diameter;
  require(samples <= max_grid_width, window_key, window,
          fmt::format("at most {:g} pupil diameters of {} samples, {} in all",
                      std::floor(double(max_grid_width) / samples_per_diameter),
                      samples_per_diameter, max_grid_width));
  const double nearest_even = 2.0 * std::round(samples / 2.0);
  require(std::abs(samples - nearest_even) <= 1e-9 * samples, window_key, window,
          fmt::format("window x {} must be an even whole number of samples, but is "
                      "{:g}; the nearest window is {}",
                      samples_key, samples, nearest_even / samples_per_diameter));
}

}  // namespace nlcwfs
