// Curves are drawn.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nlcwfs {

/// One line of a curve picture.
struct Curve {
  std::string label = {};           ///< empty = not in the key
  std::vector<double> x = {};       ///< of each point
  std::vector<double> y = {};       ///< as many; NaN where there is no value
  std::vector<double> spread = {};  ///< of each y, drawn as bars; none = no bars
  int colour = 0;                   ///< there are 5 that are distinct for the colour-blind
  bool is_pale = false;             ///< for what others are the mean of, or what counts less
  bool is_points = false;           ///< not joined
};

/// Quantities over another one. Logarithmic axes show what is above 0.
struct CurvePicture {
  std::string title;                                   ///< above the picture
  std::string x_label;                                 ///< ends with the unit
  std::string y_label;                                 ///< ends with the unit
  std::vector<Curve> curves;                           ///< in the order of the key
  bool has_log_x = false;                              ///< whether the axis is logarithmic
  bool has_log_y = false;                              ///< whether the axis is logarithmic
  std::optional<std::pair<double, double>> band = {};  ///< of x, shaded
};

/// Draws a picture with gnuplot, as SVG and as PNG. What is there already is overwritten.
/// @param stem  the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, fails, or there is nothing to draw);
///         nothing where there is one
std::optional<std::string> write_picture(const CurvePicture& picture,
                                         const std::filesystem::path& stem);

/// The same of several pictures beside and below each other, without keys; those with no value are
/// left out.
std::optional<std::string> write_picture(const std::string& title,
                                         const std::vector<CurvePicture>& pictures,
                                         const std::filesystem::path& stem);

}  // namespace nlcwfs
