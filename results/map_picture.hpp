#pragma once

#include "model/statistics.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

/// Where the values of a picture stand: numbers, which are drawn on a logarithmic scale where they
/// are evenly spaced in the logarithm, or words, which are numbered from 0.
struct PictureAxis {
  std::string label;                    ///< ends with the unit, where there is one
  std::vector<double> values;           ///< in that unit, in any order
  std::vector<std::string> words = {};  ///< one for each value, where these are no quantities
};

/// A point of a picture.
struct PicturePoint {
  double x;
  double y;
};

/// A point with a symbol of its own.
struct PictureMark {
  std::string label;
  PicturePoint point;
};

/// A dashed line.
struct PictureCurve {
  std::string label;
  std::vector<PicturePoint> points;  ///< joined in their order
};

/// What is drawn over a map or a line.
struct PictureOverlay {
  std::string path_label = {};
  std::vector<PicturePoint> path = {};    ///< joined in its order on a map
  std::vector<PictureMark> marks = {};    ///< at most 2
  std::vector<PictureCurve> curves = {};  ///< at most 3; a map is not made larger for them
};

/// A quantity over two others, in colours that are distinct for the colour-blind and in print, with
/// contours.
struct MapPicture {
  std::string title;
  PictureAxis x;
  PictureAxis y;
  std::string value_label;
  std::vector<std::vector<double>> values;  ///< of each x, of each y; NaN where there is none
  PictureOverlay overlay = {};
  /// Colours that are even in the values, however wide their range: for shares of a whole.
  bool is_linear = false;
};

/// A quantity over another, with its standard errors.
struct LinePicture {
  std::string title;
  PictureAxis x;
  std::string value_label;
  std::vector<MeanAndError> values;  ///< of each x; NaN where there is none
  PictureOverlay overlay = {};
};

/// Draws a picture with gnuplot, as SVG and as PNG. What is there already is overwritten.
/// @param stem  the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, fails, or there is nothing to draw);
///         nothing where there is one
std::optional<std::string> write_picture(const MapPicture& picture,
                                         const std::filesystem::path& stem);
std::optional<std::string> write_picture(const LinePicture& picture,
                                         const std::filesystem::path& stem);

}  // namespace nlcwfs
