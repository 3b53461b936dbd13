// Square images are drawn in their colours.
#pragma once

#include "model/array.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nlcwfs {

/// A square image with its own colours.
struct ImagePanel {
  std::string title;        ///< above the image
  std::string value_label;  ///< ends with the unit, where there is one
  Image<double> values;     ///< NaN where there is none
  double pitch;             ///< from sample to sample, in the unit of the axes
  /// Colours about 0, as many to both sides; otherwise from the least value to the greatest.
  bool is_signed = false;
  std::optional<std::pair<double, double>> range = {};  ///< of the colours, in place of that
};

/// Images about the optical axis, beside and below each other.
struct ImagePicture {
  std::string title;               ///< above all
  std::string axis_unit;           ///< of x and y
  std::vector<ImagePanel> panels;  ///< row by row
  double circle = 0.0;             ///< diameter of one that is drawn about the middle; 0 = none
};

/// Draws a picture with gnuplot, as SVG and as PNG, in colours that are distinct for the
/// colour-blind and in print. What is there already is overwritten.
/// @param stem  the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, fails, or an image has no value);
///         nothing where there is one
std::optional<std::string> write_picture(const ImagePicture& picture,
                                         const std::filesystem::path& stem);

}  // namespace nlcwfs
