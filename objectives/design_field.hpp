// The fields of a design: their names, keys, words, units, and how they are read and set.
#pragma once

#include "model/sensor_design.hpp"
#include "optimizer/problem.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// How the numbers of a range are spaced.
enum class Scale { linear, logarithmic };

/// A field of a sensor other than its planes.
struct DesignField {
  /// Member of a design in summaries, with its unit; fields of one member are a list there. Empty
  /// for what others say already.
  std::string_view summary;
  std::string_view variable;  ///< as the sections search and sweep have it; empty where they do not
  std::string_view key;       ///< of the configuration
  std::string_view label;     ///< for people, with its unit behind a comma
  std::string_view unit;      ///< SI; empty for what has none
  VariableKind kind;  ///< integer: ranges are of whole numbers; categorical: lists of words only
  Scale scale;        ///< of ranges, unless they have their own
  std::vector<std::string_view> words;  ///< of a categorical one, in the order of its values
  double (*get)(const SensorDesign&);   ///< in SI; the place among the words of a categorical one
  void (*set)(SensorDesign&, double);   ///< the inverse of get
};

/// All of them, in the order of the summaries.
std::span<const DesignField> design_fields();

/// Those that a search may vary, in the order of its tables: pupil_pixels, detector_window,
/// reconstruction_window, relaxation (start and end alike), relaxation_start, relaxation_end,
/// initial_guess, reconstruction_oversampling, tolerance, exposure.
std::span<const DesignField> design_properties();

/// A field that a search may vary; null where there is none of this name.
const DesignField* find_design_property(std::string_view variable);

/// The unit of a variable of the sections search and sweep: "m", "s", or empty for what has none.
/// @param name  of a design property, "order", or a plane's or pair's distance
std::string_view unit_of_variable(std::string_view name);

}  // namespace nlcwfs
