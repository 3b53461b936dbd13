#include "results/tables/design_summary.hpp"

#include "results/tables/json_numbers.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

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

/// Of the two values that a word of a design may stand for, that which it does.
template <class Value>
Value value_of(const Json& json, const char* member, std::pair<const char*, Value> one,
               std::pair<const char*, Value> other) {
  const std::string word = json.at(member);
  if (word == one.first) return one.second;
  if (word == other.first) return other.second;
  throw std::runtime_error(
      fmt::format("{} is '{}', but should be {} or {}", member, word, one.first, other.first));
}

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

SensorDesign design_from_json(const Json& json) {
  using enum StoppingRule;
  using enum InitialGuess;
  using enum OutsideDetector;
  using enum UnwrappingMethod;
  const double photon_rate = json.at("photon_rate");
  return {.planes = json.at("planes_m"),
          .detector = {.pupil_pixels = integer_from_json(json.at("pupil_pixels")),
                       .window = json.at("detector_window"),
                       // Of a rate the summary has its product with the exposure.
                       .photons = photon_rate > 0.0 ? 0.0 : json.at("photons").get<double>(),
                       .read_noise = json.at("read_noise"),
                       .photon_rate = photon_rate,
                       .exposure = json.at("exposure_s")},
          .reconstruction = {
              .max_loops = integer_from_json(json.at("max_loops")),
              .tolerance = json.at("tolerance_m"),
              .stopping = value_of<StoppingRule>(json, "stopping", {"difference", difference},
                                                 {"rms_change", rms_change}),
              .relaxation_start = json.at("relaxation").at(0),
              .relaxation_end = json.at("relaxation").at(1),
              .initial_guess = value_of<InitialGuess>(json, "initial_guess", {"flat", flat},
                                                      {"centroid", centroid}),
              .window = json.at("reconstruction_window"),
              .outside = value_of<OutsideDetector>(json, "outside", {"free", free}, {"zero", zero}),
              .oversampling = integer_from_json(json.at("oversampling")),
              .unwrapping =
                  value_of<UnwrappingMethod>(json, "unwrapping", {"quality_guided", quality_guided},
                                             {"least_squares", least_squares})}};
}

}  // namespace nlcwfs
