// gnuplot is run: what all pictures share.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What is drawn within one pair of axes.
struct GnuplotPanel {
  std::string settings;            ///< data and axes; those of other panels do not reach it
  std::vector<std::string> plots;  ///< of one plot command
};

/// The room of a panel in pixels of the SVG; the PNG has 1.5 times as many.
struct PanelRoom {
  int width;   ///< within the axes
  int height;  ///< within the axes
  int left;    ///< of them, for tics and labels
  int right;   ///< likewise, also for a scale of colours
  int below;   ///< likewise
  int above;   ///< likewise, for the panel's title
};

/// Several plots beside and below each other.
struct GnuplotPanels {
  std::string title;                 ///< above all
  std::size_t columns;               ///< in which they stand
  PanelRoom room;                    ///< of each
  std::vector<GnuplotPanel> panels;  ///< row by row
};

/// A text that gnuplot takes as it stands.
std::string gnuplot_text(std::string_view text);

/// Colours that are distinct for the colour-blind, as gnuplot reads them behind # (Okabe & Ito
/// 2008).
inline constexpr std::array<std::string_view, 5> distinct_colours{"0072b2", "d55e00", "009e73",
                                                                  "cc79a7", "e69f00"};

/// Viridis by van der Walt & Smith (public domain): of even perceptual steps, also for the
/// colour-blind and in grey.
inline constexpr std::string_view sequential_palette =
    "set palette defined (0 '#440154', 1 '#482878', 2 '#3e4989', 3 '#31688e', 4 '#26828e', "
    "5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725')\n";

/// PuOr of ColorBrewer (Brewer & Harrower, Apache 2.0): two hues about white that the colour-blind
/// tell apart.
inline constexpr std::string_view signed_palette =
    "set palette defined (0 '#7f3b08', 1 '#b35806', 2 '#e08214', 3 '#fdb863', 4 '#fee0b6', "
    "5 '#f7f7f7', 6 '#d8daeb', 7 '#b2abd2', 8 '#8073ac', 9 '#542788', 10 '#2d004b')\n";

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
/// @param title     above the picture
/// @param key_rows  of the symbols' meanings below the picture; 0 = none
/// @param panel     the picture
/// @param stem      the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, or fails); nothing where there is one
std::optional<std::string> draw(const std::string& title, int key_rows, const GnuplotPanel& panel,
                                const std::filesystem::path& stem);
/// The same of several panels in one picture.
std::optional<std::string> draw(const GnuplotPanels& figure, const std::filesystem::path& stem);

}  // namespace nlcwfs
