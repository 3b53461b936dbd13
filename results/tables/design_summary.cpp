// Designs and performances become JSON, and designs come back.
#include "results/tables/design_summary.hpp"

#include "objectives/design_field.hpp"
#include "results/tables/json_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// Whether other fields have the same member.
bool is_of_a_list(const DesignField& field) {
  return std::ranges::count(design_fields(), field.summary, &DesignField::summary) > 1;
}

/// A field of a design as JSON has it.
Json value_of(const SensorDesign& design, const DesignField& field) {
  const double value = field.get(design);
  switch (field.kind) {
    case VariableKind::categorical:
      return field.words[static_cast<std::size_t>(value)];
    case VariableKind::integer:
      return static_cast<int>(value);
    case VariableKind::continuous:
      break;
  }
  // Of a rate the summary has its product with the exposure.
  return field.summary == "photons" ? design.detector.photons_per_frame() : value;
}

/// The inverse.
double value_of(const Json& json, const DesignField& field) {
  switch (field.kind) {
    case VariableKind::categorical: {
      const std::string word = json;
      const auto found = std::ranges::find(field.words, word);
      if (found == field.words.end()) {
        throw std::runtime_error(fmt::format("{} is '{}', but should be {}", field.summary, word,
                                             fmt::join(field.words, " or ")));
      }
      return double(found - field.words.begin());
    }
    case VariableKind::integer:
      return integer_from_json(json);
    case VariableKind::continuous:
      break;
  }
  return json;
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
  Json json;
  json["planes_m"] = design.planes;
  json["planes_talbot"] = of_each(design.planes, [&](double z) { return Json(z / talbot); });
  json["fresnel_numbers"] = of_each(
      design.planes, [&](double z) { return finite_or_null(fresnel_number(telescope, z)); });
  if (telescope.relay_beam_diameter) {
    json["planes_bench_m"] =
        of_each(design.planes, [&](double z) { return Json(bench_distance(z, telescope)); });
  }
  for (const DesignField& field : design_fields()) {
    if (field.summary.empty()) continue;
    const std::string member(field.summary);
    if (is_of_a_list(field)) {
      json[member].push_back(value_of(design, field));
    } else {
      json[member] = value_of(design, field);
    }
  }
  return json;
}

SensorDesign design_from_json(const Json& json) {
  SensorDesign design;
  design.planes = json.at("planes_m").get<std::vector<double>>();
  std::map<std::string, std::size_t> read;
  for (const DesignField& field : design_fields()) {
    if (field.summary.empty()) continue;
    const std::string member(field.summary);
    const Json& value = json.at(member);
    field.set(design, value_of(is_of_a_list(field) ? value.at(read[member]++) : value, field));
  }
  if (design.detector.photon_rate > 0.0) design.detector.photons = 0.0;
  return design;
}

}  // namespace nlcwfs
