// Points of a front are drawn.
#pragma once

#include "model/statistics.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

/// A point of a scatter picture.
struct ScatterPoint {
  double x = 0.0;        ///< on axis x
  MeanAndError y = {};   ///< on axis y, with an error bar
  int colour = 0;        ///< index in ScatterPicture::colours
  int symbol = 0;        ///< index in ScatterPicture::symbols
  bool is_pale = false;  ///< for what counts less
};

/// Points of two kinds of groups: one by their colours, one by their symbols. Axes are logarithmic.
struct ScatterPicture {
  std::string title;                       ///< above the picture
  std::string x_label;                     ///< ends with the unit
  std::string y_label;                     ///< ends with the unit
  std::vector<std::string> colours = {};   ///< what each colour stands for; there are 5 that differ
  std::vector<std::string> symbols = {};   ///< what each symbol stands for; there are 6 that differ
  std::vector<ScatterPoint> points = {};   ///< all of them
  std::optional<std::size_t> marked = {};  ///< a point with a ring around it
  std::string mark_label = {};             ///< of the marked point in the key
};

/// Draws a picture with gnuplot, as SVG and as PNG. What is there already is overwritten.
/// @param stem  the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, fails, or no point has positive
///         coordinates); nothing where there is one
std::optional<std::string> write_picture(const ScatterPicture& picture,
                                         const std::filesystem::path& stem);

}  // namespace nlcwfs
