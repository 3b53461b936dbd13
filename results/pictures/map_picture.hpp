// Maps and lines over axes are drawn.
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
  double x;  ///< on axis x
  double y;  ///< on axis y
};

/// A point with a symbol of its own.
struct PictureMark {
  std::string label;   ///< in the key
  PicturePoint point;  ///< where it is
};

/// A dashed line.
struct PictureCurve {
  std::string label;                 ///< in the key
  std::vector<PicturePoint> points;  ///< joined in their order
};

/// What is drawn over a map or a line.
struct PictureOverlay {
  std::string path_label = {};            ///< of the path in the key
  std::vector<PicturePoint> path = {};    ///< joined in its order on a map
  std::vector<PictureMark> marks = {};    ///< at most 2
  std::vector<PictureCurve> curves = {};  ///< at most 3; a map is not made larger for them
};

/// A quantity over two others, in colours that are distinct for the colour-blind and in print, with
/// contours.
struct MapPicture {
  std::string title;                        ///< above the picture
  PictureAxis x;                            ///< columns of the map
  PictureAxis y;                            ///< rows of the map
  std::string value_label;                  ///< beside the colour scale, with the unit
  std::vector<std::vector<double>> values;  ///< of each x, of each y; NaN where there is none
  PictureOverlay overlay = {};              ///< what is drawn over the map
  /// Colours that are even in the values, however wide their range: for shares of a whole.
  bool is_linear = false;
};

/// A quantity over another, with its standard errors.
struct LinePicture {
  std::string title;                 ///< above the picture
  PictureAxis x;                     ///< of the values
  std::string value_label;           ///< of axis y, with the unit
  std::vector<MeanAndError> values;  ///< of each x; NaN where there is none
  PictureOverlay overlay = {};       ///< what is drawn over the line
};

/// Draws a picture with gnuplot, as SVG and as PNG. What is there already is overwritten.
/// @param stem  the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, fails, or there is nothing to draw);
///         nothing where there is one
std::optional<std::string> write_picture(const MapPicture& picture,
                                         const std::filesystem::path& stem);
/// The same of a line.
std::optional<std::string> write_picture(const LinePicture& picture,
                                         const std::filesystem::path& stem);

}  // namespace nlcwfs
