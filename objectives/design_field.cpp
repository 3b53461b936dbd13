// The fields of a design: their names, keys, words, units, and how they are read and set.
#include "objectives/design_field.hpp"

#include "model/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace nlcwfs {
namespace {

/// A member of a design's parts.
template <class Design, class Value>
auto& value_in(Design& design, Value Detector::*member) {
  return design.detector.*member;
}
template <class Design, class Value>
auto& value_in(Design& design, Value ReconstructionOptions::*member) {
  return design.reconstruction.*member;
}

/// A field that is one member of a design's detector or reconstruction.
template <auto member>
DesignField field(std::string_view summary, std::string_view variable, std::string_view key,
                  std::string_view label, std::string_view unit = "", Scale scale = Scale::linear) {
  using Value = std::remove_reference_t<decltype(value_in(std::declval<SensorDesign&>(), member))>;
  DesignField row{
      .summary = summary,
      .variable = variable,
      .key = key,
      .label = label,
      .unit = unit,
      .kind = std::is_same_v<Value, double> ? VariableKind::continuous
              : std::is_enum_v<Value>       ? VariableKind::categorical
                                            : VariableKind::integer,
      .scale = scale,
      .words = {},
      .get =
          [](const SensorDesign& design) { return static_cast<double>(value_in(design, member)); },
      .set =
          [](SensorDesign& design, double value) {
            if constexpr (std::is_same_v<Value, double>) {
              value_in(design, member) = value;
            } else {
              value_in(design, member) = static_cast<Value>(std::lround(value));
            }
          }};
  if constexpr (std::is_enum_v<Value>) {
    for (const auto& [word, value] : word_table<Value>) row.words.push_back(word);
  }
  return row;
}

std::vector<DesignField> make_fields() {
  using enum Scale;
  using Loop = ReconstructionOptions;
  std::vector<DesignField> fields{
      field<&Detector::pupil_pixels>("pupil_pixels", "pupil_pixels", "detector.pupil_pixels",
                                     "pupil pixels"),
      field<&Detector::window>("detector_window", "detector_window", "detector.window",
                               "detector window, pupil diameters"),
      field<&Detector::photons>("photons", "", "detector.photons", "photons"),
      field<&Detector::photon_rate>("photon_rate", "", "detector.photon_rate", "photons/s"),
      field<&Detector::exposure>("exposure_s", "exposure", "detector.exposure", "exposure", "s",
                                 logarithmic),
      field<&Detector::read_noise>("read_noise", "", "detector.read_noise", "read noise"),
      field<&Loop::max_loops>("max_loops", "", "reconstruction.max_loops", "max loops"),
      field<&Loop::tolerance>("tolerance_m", "tolerance", "reconstruction.tolerance", "tolerance",
                              "m", logarithmic),
      field<&Loop::stopping>("stopping", "", "reconstruction.stopping", "stopping"),
      field<&Loop::relaxation_start>("relaxation", "relaxation_start", "reconstruction.relaxation",
                                     "relaxation start"),
      field<&Loop::relaxation_end>("relaxation", "relaxation_end", "reconstruction.relaxation",
                                   "relaxation end"),
      field<&Loop::initial_guess>("initial_guess", "initial_guess", "reconstruction.initial_guess",
                                  "initial guess"),
      field<&Loop::window>("reconstruction_window", "reconstruction_window",
                           "reconstruction.window", "reconstruction window, pupil diameters"),
      field<&Loop::outside>("outside", "", "reconstruction.outside", "outside"),
      field<&Loop::oversampling>("oversampling", "reconstruction_oversampling",
                                 "reconstruction.oversampling", "reconstruction oversampling"),
      field<&Loop::unwrapping>("unwrapping", "", "reconstruction.unwrapping", "unwrapping"),
      field<&Loop::relaxation_start>("", "relaxation", "reconstruction.relaxation", "relaxation")};
  // In every loop the same.
  fields.back().set = [](SensorDesign& design, double value) {
    design.reconstruction.relaxation_start = design.reconstruction.relaxation_end = value;
  };
  return fields;
}

/// In the order of design_key and of tables, which archives have.
constexpr std::array<std::string_view, 10> varied{
    "pupil_pixels",     "detector_window", "reconstruction_window", "relaxation",
    "relaxation_start", "relaxation_end",  "initial_guess",         "reconstruction_oversampling",
    "tolerance",        "exposure"};

}  // namespace

std::span<const DesignField> design_fields() {
  static const std::vector<DesignField> fields = make_fields();
  return fields;
}

std::span<const DesignField> design_properties() {
  static const std::vector<DesignField> properties = [] {
    std::vector<DesignField> found;
    for (const std::string_view name : varied) {
      found.push_back(*std::ranges::find(design_fields(), name, &DesignField::variable));
    }
    return found;
  }();
  return properties;
}

const DesignField* find_design_property(std::string_view variable) {
  const auto properties = design_properties();
  const auto found = std::ranges::find(properties, variable, &DesignField::variable);
  return found == properties.end() ? nullptr : &*found;
}

std::string_view unit_of_variable(std::string_view name) {
  if (const DesignField* property = find_design_property(name)) return property->unit;
  return name.starts_with('z') ? "m" : "";
}

}  // namespace nlcwfs
