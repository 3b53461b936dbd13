#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What every picture that gnuplot draws has, apart from its data and axes.
struct GnuplotFigure {
  std::string title;               ///< above the picture
  int key_rows = 0;                ///< of the symbols' meanings below the picture; 0 = none
  std::vector<std::string> plots;  ///< of one plot command
};

/// A text that gnuplot takes as it stands.
std::string gnuplot_text(std::string_view text);

/// Colours that are distinct for the colour-blind, as gnuplot reads them behind # (Okabe & Ito
/// 2008).
inline constexpr std::array<std::string_view, 5> distinct_colours{"0072b2", "d55e00", "009e73",
                                                                  "cc79a7", "e69f00"};

/// A logarithmic axis that reaches little further than its values, where gnuplot's own would end at
/// whole decades, with round numbers on it.
/// @param name    "x" or "y"
/// @param values  at least one, all above 0
std::string logarithmic_axis(std::string_view name, const std::vector<double>& values);

/// The lower end of an error bar on such an axis, which has no place for an error as large as its
/// value.
double lower_end(double value, double error);

/// A number as gnuplot reads it, also one that is not finite.
std::string number_text(double value);

/// Data of a name, for plots of $name; a line for each row.
std::string data_block(std::string_view name, const std::string& rows);

/// Draws a picture with gnuplot, as SVG and as PNG. What is there already is overwritten.
/// @param script  data and axes
/// @param stem    the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, or fails); nothing where there is one
std::optional<std::string> draw(const std::string& script, const GnuplotFigure& figure,
                                const std::filesystem::path& stem);

}  // namespace nlcwfs
