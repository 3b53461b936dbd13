// The fields of a design: their names, keys, words, units, and how they are read and set.
#include "objectives/design_field.hpp"

#include "model/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nlcwfs {
namespace {

using Design = SensorDesign;

template <class Enum>
std::vector<std::string_view> words() {
  std::vector<std::string_view> list;
  for (const auto& [word, value] : word_table<Enum>) list.push_back(word);
  return list;
}

template <class Enum>
Enum enum_of(double value) {
  return static_cast<Enum>(std::lround(value));
}

int whole(double value) { return static_cast<int>(std::lround(value)); }

std::vector<DesignField> make_fields() {
  using enum VariableKind;
  using enum Scale;
  return {
      {"pupil_pixels",
       "pupil_pixels",
       "detector.pupil_pixels",
       "pupil pixels",
       "",
       integer,
       linear,
       {},
       [](const Design& d) { return double(d.detector.pupil_pixels); },
       [](Design& d, double v) { d.detector.pupil_pixels = whole(v); }},
      {"detector_window",
       "detector_window",
       "detector.window",
       "detector window, pupil diameters",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.detector.window; },
       [](Design& d, double v) { d.detector.window = v; }},
      {"photons",
       "",
       "detector.photons",
       "photons",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.detector.photons; },
       [](Design& d, double v) { d.detector.photons = v; }},
      {"photon_rate",
       "",
       "detector.photon_rate",
       "photons per second",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.detector.photon_rate; },
       [](Design& d, double v) { d.detector.photon_rate = v; }},
      {"exposure_s",
       "exposure",
       "detector.exposure",
       "exposure",
       "s",
       continuous,
       logarithmic,
       {},
       [](const Design& d) { return d.detector.exposure; },
       [](Design& d, double v) { d.detector.exposure = v; }},
      {"read_noise",
       "",
       "detector.read_noise",
       "read noise",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.detector.read_noise; },
       [](Design& d, double v) { d.detector.read_noise = v; }},
      {"max_loops",
       "",
       "reconstruction.max_loops",
       "max loops",
       "",
       integer,
       linear,
       {},
       [](const Design& d) { return double(d.reconstruction.max_loops); },
       [](Design& d, double v) { d.reconstruction.max_loops = whole(v); }},
      {"tolerance_m",
       "tolerance",
       "reconstruction.tolerance",
       "tolerance",
       "m",
       continuous,
       logarithmic,
       {},
       [](const Design& d) { return d.reconstruction.tolerance; },
       [](Design& d, double v) { d.reconstruction.tolerance = v; }},
      {"stopping", "", "reconstruction.stopping", "stopping", "", categorical, linear,
       words<StoppingRule>(), [](const Design& d) { return double(d.reconstruction.stopping); },
       [](Design& d, double v) { d.reconstruction.stopping = enum_of<StoppingRule>(v); }},
      {"relaxation",
       "relaxation_start",
       "reconstruction.relaxation",
       "relaxation start",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.reconstruction.relaxation_start; },
       [](Design& d, double v) { d.reconstruction.relaxation_start = v; }},
      {"relaxation",
       "relaxation_end",
       "reconstruction.relaxation",
       "relaxation end",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.reconstruction.relaxation_end; },
       [](Design& d, double v) { d.reconstruction.relaxation_end = v; }},
      {"",
       "relaxation",
       "reconstruction.relaxation",
       "relaxation",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.reconstruction.relaxation_start; },
       [](Design& d, double v) {
         d.reconstruction.relaxation_start = d.reconstruction.relaxation_end = v;
       }},
      {"initial_guess", "initial_guess", "reconstruction.initial_guess", "initial guess", "",
       categorical, linear, words<InitialGuess>(),
       [](const Design& d) { return double(d.reconstruction.initial_guess); },
       [](Design& d, double v) { d.reconstruction.initial_guess = enum_of<InitialGuess>(v); }},
      {"reconstruction_window",
       "reconstruction_window",
       "reconstruction.window",
       "reconstruction window, pupil diameters",
       "",
       continuous,
       linear,
       {},
       [](const Design& d) { return d.reconstruction.window; },
       [](Design& d, double v) { d.reconstruction.window = v; }},
      {"outside", "", "reconstruction.outside", "outside", "", categorical, linear,
       words<OutsideDetector>(), [](const Design& d) { return double(d.reconstruction.outside); },
       [](Design& d, double v) { d.reconstruction.outside = enum_of<OutsideDetector>(v); }},
      {"oversampling",
       "reconstruction_oversampling",
       "reconstruction.oversampling",
       "reconstruction oversampling",
       "",
       integer,
       linear,
       {},
       [](const Design& d) { return double(d.reconstruction.oversampling); },
       [](Design& d, double v) { d.reconstruction.oversampling = whole(v); }},
      {"unwrapping", "", "reconstruction.unwrapping", "unwrapping", "", categorical, linear,
       words<UnwrappingMethod>(),
       [](const Design& d) { return double(d.reconstruction.unwrapping); },
       [](Design& d, double v) { d.reconstruction.unwrapping = enum_of<UnwrappingMethod>(v); }}};
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
  return name == "order" ? "" : "m";
}

}  // namespace nlcwfs
