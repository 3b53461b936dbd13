#include "results/scatter_picture.hpp"

#include "results/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Of Okabe & Ito (2008): distinct for the colour-blind.
constexpr std::array palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"};
/// Of gnuplot's numbers: disc, square, triangle, diamond, inverted triangle, pentagon.
constexpr std::array symbol_types{7, 5, 9, 13, 11, 15};

std::string row_of(const ScatterPoint& point) {
  // A logarithmic axis has no place for an error as large as its mean.
  const double low = std::max(point.y.mean - point.y.standard_error, 0.1 * point.y.mean);
  return fmt::format("{} {} {} {}\n", point.x, point.y.mean, low,
                     point.y.mean + point.y.standard_error);
}

/// A logarithmic axis that reaches little further than its values, where gnuplot's own would end at
/// whole decades, with round numbers on it.
std::string axis(std::string_view name, const std::vector<double>& values) {
  constexpr double margin = 1.3;
  const double least = std::ranges::min(values) / margin;
  const double greatest = std::ranges::max(values) * margin;
  std::string tics;
  const auto last = static_cast<int>(std::floor(std::log10(greatest)));
  for (auto decade = static_cast<int>(std::floor(std::log10(least))); decade <= last; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tic = factor * std::pow(10.0, decade);
      if (tic < least || tic > greatest) continue;
      tics += fmt::format("{}'{:g}' {:g}", tics.empty() ? "" : ", ", tic, tic);
    }
  }
  return fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics out nomirror ({3})\n",
                     name, least, greatest, tics);
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
          palette[static_cast<std::size_t>(point.colour) % palette.size()] + 1));
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
  std::string script = fmt::format(
      "set xlabel {}\nset ylabel {}\nset grid linecolor rgb '#dddddd'\n{}{}",
      gnuplot_text(picture.x_label), gnuplot_text(picture.y_label), axis("x", xs), axis("y", ys));
  std::vector<std::string> plots = plot_points(picture, script);
  if (picture.marked && is_drawable(picture.points[*picture.marked])) {
    script += data_block("marked", row_of(picture.points[*picture.marked]));
    plots.push_back(fmt::format(
        "$marked using 1:2 with points pointtype 6 pointsize 2.6 linewidth 1.6 linecolor rgb "
        "'black' title {}",
        gnuplot_text(picture.mark_label)));
  }
  for (std::size_t colour = 0; colour < picture.colours.size(); ++colour) {
    plots.push_back(
        fmt::format("NaN with points pointtype 7 pointsize 1 linecolor rgb '{}' title "
                    "{}",
                    palette[colour % palette.size()], gnuplot_text(picture.colours[colour])));
  }
  for (std::size_t symbol = 0; symbol < picture.symbols.size(); ++symbol) {
    plots.push_back(fmt::format(
        "NaN with points pointtype {} pointsize 1 linecolor rgb '#606060' "
        "title {}",
        symbol_types[symbol % symbol_types.size()], gnuplot_text(picture.symbols[symbol])));
  }
  return draw(script, {picture.title, 2, plots}, stem);
}

}  // namespace nlcwfs
