#include "results/design_summary.hpp"

#include <cmath>
#include <string>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

template <class Function>
Json of_each(const std::vector<double>& values, const Function& function) {
  Json list = Json::array();
  for (const double value : values) list.push_back(function(value));
  return list;
}

/// JSON has no infinity: the Fresnel number of the pupil itself is null.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

Json to_json(const MeanAndError& value) {
  return {{"mean", value.mean}, {"standard_error", value.standard_error}};
}

Json to_json(const Performance& performance) {
  Json json;
  for (const PerformanceMetric& metric : performance_metrics()) {
    json[std::string(metric.name)] = to_json(performance.mean_of(metric));
  }
  json["captured_energy"] = performance.captured_energy();
  json["converged_fraction"] = performance.converged_fraction();
  json["screens"] = performance.screens.size();
  return json;
}

Json to_json(const SensorDesign& design, const Telescope& telescope, double fried_parameter) {
  const double talbot = talbot_distance(fried_parameter, telescope.wavelength);
  const ReconstructionOptions& reconstruction = design.reconstruction;
  Json json;
  json["planes_m"] = design.planes;
  json["planes_talbot"] = of_each(design.planes, [&](double z) { return Json(z / talbot); });
  json["fresnel_numbers"] = of_each(
      design.planes, [&](double z) { return finite_or_null(fresnel_number(telescope, z)); });
  if (telescope.relay_beam_diameter) {
    json["planes_bench_m"] =
        of_each(design.planes, [&](double z) { return Json(bench_distance(z, telescope)); });
  }
  json["pupil_pixels"] = design.detector.pupil_pixels;
  json["detector_window"] = design.detector.window;
  json["photons"] = design.detector.photons_per_frame();
  json["photon_rate"] = design.detector.photon_rate;
  json["exposure_s"] = design.detector.exposure;
  json["read_noise"] = design.detector.read_noise;
  json["max_loops"] = reconstruction.max_loops;
  json["tolerance_m"] = reconstruction.tolerance;
  json["stopping"] =
      reconstruction.stopping == StoppingRule::difference ? "difference" : "rms_change";
  json["relaxation"] = {reconstruction.relaxation_start, reconstruction.relaxation_end};
  json["initial_guess"] = reconstruction.initial_guess == InitialGuess::flat ? "flat" : "centroid";
  json["reconstruction_window"] = reconstruction.window;
  json["outside"] = reconstruction.outside == OutsideDetector::free ? "free" : "zero";
  json["oversampling"] = reconstruction.oversampling;
  json["unwrapping"] = reconstruction.unwrapping == UnwrappingMethod::quality_guided
                           ? "quality_guided"
                           : "least_squares";
  return json;
}

}  // namespace nlcwfs
