// What a sensor is: planes, detector and reconstruction.
#include "model/sensor_design.hpp"

#include "model/array.hpp"
#include "model/bound_text.hpp"
#include "model/grid_width.hpp"
#include "model/input_error.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr double min_fresnel_number = 0.1;

}  // namespace

double farthest_distance(const Telescope& telescope) {
  return distance_at_fresnel_number(telescope, min_fresnel_number);
}

void validate_planes(std::string_view key, const std::vector<double>& planes,
                     const Telescope& telescope) {
  require(planes.size() >= 2, key, fmt::format("{}", fmt::join(planes, ",")),
          "at least 2 distances, such as -47km,47km");
  const double farthest = farthest_distance(telescope);
  for (const double plane : planes) {
    if (!(std::abs(plane) <= farthest)) {
      throw InputError(key, plane,
                       fmt::format("distances within +-{}, where the Fresnel number is {}",
                                   bound_text(farthest), min_fresnel_number));
    }
  }
}

double ReconstructionOptions::relaxation(int loop) const {
  if (max_loops == 1) return relaxation_start;
  return std::lerp(relaxation_start, relaxation_end, double(loop - 1) / (max_loops - 1));
}

int SensorDesign::grid_width() const {
  return nlcwfs::grid_width(reconstruction.window, pupil_samples());
}

void SensorDesign::validate(const Telescope& telescope) const {
  validate_planes("sensor.planes", planes, telescope);
  detector.validate();
  require(reconstruction.max_loops >= 1 && reconstruction.max_loops <= 10000,
          "reconstruction.max_loops", reconstruction.max_loops, "from 1 to 10000");
  require(reconstruction.tolerance >= 0.0 && std::isfinite(reconstruction.tolerance),
          "reconstruction.tolerance", reconstruction.tolerance,
          "a length of at least 0, such as 1nm");
  for (const double beta : {reconstruction.relaxation_start, reconstruction.relaxation_end}) {
    require(std::abs(beta) < 1.0, "reconstruction.relaxation", beta,
            "above -1 and below 1, or start:end of these");
  }
  require(reconstruction.oversampling >= 1 && reconstruction.oversampling <= 16,
          "reconstruction.oversampling", reconstruction.oversampling, "from 1 to 16");
  validate_grid_window("reconstruction.window", reconstruction.window,
                       "detector.pupil_pixels x reconstruction.oversampling", pupil_samples());
  require(grid_width() >= detector.width() * reconstruction.oversampling, "reconstruction.window",
          reconstruction.window,
          fmt::format("at least detector.window, which is {:g}", detector.window));
  const int width = grid_width();
  const double bytes_per_image = double(width) * width * sizeof(double);
  if (double(planes.size()) * bytes_per_image > max_image_memory) {
    throw InputError("sensor.planes", fmt::format("{} distances", planes.size()),
                     fmt::format("at most {:.0f}: images of {} x {} samples take {}",
                                 std::floor(max_image_memory / bytes_per_image), width, width,
                                 memory_text(double(planes.size()) * bytes_per_image)));
  }
}

}  // namespace nlcwfs
