#include "results/curve_picture.hpp"

#include "results/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Of Okabe & Ito (2008): distinct for the colour-blind.
constexpr std::array palette{"0072b2", "d55e00", "009e73", "cc79a7", "e69f00"};

bool has_values(const Curve& curve) {
  return std::ranges::any_of(curve.y, [](double value) { return std::isfinite(value); });
}

std::string rows_of(const Curve& curve) {
  assert(curve.x.size() == curve.y.size());
  std::string rows;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    rows += fmt::format("{} {} {}\n", number_text(curve.x[i]), number_text(curve.y[i]),
                        curve.spread.empty() ? "0" : number_text(curve.spread[i]));
  }
  return rows;
}

}  // namespace

std::optional<std::string> write_picture(const CurvePicture& picture,
                                         const std::filesystem::path& stem) {
  std::string script = fmt::format(
      "set xlabel {}\nset ylabel {}\nset xtics out nomirror\nset ytics out nomirror\n"
      "set grid linecolor rgb '#dddddd'\nset offsets graph 0.03, graph 0.03, graph 0.03, 0\n{}{}",
      gnuplot_text(picture.x_label), gnuplot_text(picture.y_label),
      picture.has_log_x ? "set logscale x\n" : "", picture.has_log_y ? "set logscale y\n" : "");
  std::vector<std::string> plots;
  int labels = 0;
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    if (!has_values(curve)) continue;
    const std::string name = fmt::format("curve{}", i);
    script += data_block(name, rows_of(curve));
    const char* colour = palette[static_cast<std::size_t>(curve.colour) % palette.size()];
    if (!curve.spread.empty()) {
      plots.push_back(fmt::format(
          "${} using 1:2:3 with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb '#{}' notitle",
          name, colour));
    }
    plots.push_back(
        fmt::format("${} using 1:2 with lines linewidth {} linecolor rgb '#{}{}' {}", name,
                    curve.is_pale ? 1 : 2, curve.is_pale ? "90" : "00", colour,
                    curve.label.empty() ? "notitle" : "title " + gnuplot_text(curve.label)));
    labels += curve.label.empty() ? 0 : 1;
  }
  if (plots.empty()) return "there is no value to draw";
  return draw(script, {picture.title, labels > 0 ? 1 + (labels - 1) / 4 : 0, plots}, stem);
}

}  // namespace nlcwfs
