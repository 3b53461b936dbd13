// Names and units of axes, for people.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace nlcwfs {

/// A name of a summary for people, with its unit behind a comma where the name ends with one:
/// "total wfe, nm". Words that mean more than they say are spelt out.
std::string label_of(std::string_view name);

/// The variable's column in a table, which ends with its unit: "tolerance_m".
std::string column_of_variable(std::string_view name);

/// The unit that suits an axis.
struct AxisUnit {
  double size = 1.0;      ///< SI
  std::string word = {};  ///< empty for what has none

  /// What a label ends with: ", km", or nothing.
  std::string suffix() const { return word.empty() ? word : ", " + word; }
};

/// @param unit    of the values, SI: lengths are shown in km, m, mm or nm
/// @param values  of the axis
AxisUnit axis_unit_of(std::string_view unit, std::span<const double> values);

}  // namespace nlcwfs
