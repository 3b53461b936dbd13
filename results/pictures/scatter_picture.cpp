// Points of a front are drawn.
#include "results/pictures/scatter_picture.hpp"

#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Of gnuplot's numbers: disc, square, triangle, diamond, inverted triangle, pentagon.
constexpr std::array symbol_types{7, 5, 9, 13, 11, 15};

std::string row_of(const ScatterPoint& point) {
  const auto [mean, error] = point.y;
  return fmt::format("{} {} {} {}\n", point.x, mean, lower_end(mean, error), mean + error);
}

bool is_drawable(const ScatterPoint& point) { return point.x > 0.0 && point.y.mean > 0.0; }

/// Each point, the pale ones below the others.
/// @param script  gets their data
std::vector<std::string> plot_points(const ScatterPicture& picture, std::string& script) {
  std::vector<std::string> plots;
  for (const bool is_pale : {true, false}) {
    for (std::size_t i = 0; i < picture.points.size(); ++i) {
      const ScatterPoint& point = picture.points[i];
      if (point.is_pale != is_pale || !is_drawable(point)) continue;
      const std::string name = fmt::format("point{}", i);
      script += data_block(name, row_of(point));
      plots.push_back(fmt::format(
          "${} using 1:2:3:4 with yerrorbars pointtype {} pointsize 1 linecolor rgb '#{}{}' "
          "notitle",
          name, symbol_types[static_cast<std::size_t>(point.symbol) % symbol_types.size()],
          is_pale ? "b0" : "20",
          distinct_colours[static_cast<std::size_t>(point.colour) % distinct_colours.size()]));
    }
  }
  return plots;
}

}  // namespace

std::optional<std::string> write_picture(const ScatterPicture& picture,
                                         const std::filesystem::path& stem) {
  if (std::ranges::none_of(picture.points, is_drawable)) return "there is no value to draw";
  std::vector<double> xs;
  std::vector<double> ys;
  for (const ScatterPoint& point : picture.points) {
    if (!is_drawable(point)) continue;
    xs.push_back(point.x);
    ys.push_back(point.y.mean);
  }
  std::string script =
      fmt::format("set xlabel {}\nset ylabel {}\nset grid linecolor rgb '#dddddd'\n{}{}",
                  gnuplot_text(picture.x_label), gnuplot_text(picture.y_label),
                  logarithmic_axis("x", xs), logarithmic_axis("y", ys));
  std::vector<std::string> plots = plot_points(picture, script);
  if (picture.marked && is_drawable(picture.points[*picture.marked])) {
    script += data_block("marked", row_of(picture.points[*picture.marked]));
    plots.push_back(fmt::format(
        "$marked using 1:2 with points pointtype 6 pointsize 2.6 linewidth 1.6 linecolor rgb "
        "'black' title {}",
        gnuplot_text(picture.mark_label)));
  }
  for (std::size_t colour = 0; colour < picture.colours.size(); ++colour) {
    plots.push_back(fmt::format(
        "NaN with points pointtype 7 pointsize 1 linecolor rgb '#{}' title "
        "{}",
        distinct_colours[colour % distinct_colours.size()], gnuplot_text(picture.colours[colour])));
  }
  for (std::size_t symbol = 0; symbol < picture.symbols.size(); ++symbol) {
    plots.push_back(fmt::format(
        "NaN with points pointtype {} pointsize 1 linecolor rgb '#606060' "
        "title {}",
        symbol_types[symbol % symbol_types.size()], gnuplot_text(picture.symbols[symbol])));
  }
  return draw(picture.title, 2, {script, plots}, stem);
}

}  // namespace nlcwfs
