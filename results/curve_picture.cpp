#include "results/curve_picture.hpp"

#include "results/gnuplot.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

bool has_values(const Curve& curve) {
  return std::ranges::any_of(curve.y, [](double value) { return std::isfinite(value); });
}

/// The ends of its bars, where it has any, beside each value.
std::string rows_of(const Curve& curve, bool has_log_y) {
  assert(curve.x.size() == curve.y.size());
  std::string rows;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double spread = curve.spread.empty() ? 0.0 : curve.spread[i];
    const double low = has_log_y ? lower_end(curve.y[i], spread) : curve.y[i] - spread;
    rows += fmt::format("{} {} {} {}\n", number_text(curve.x[i]), number_text(curve.y[i]),
                        number_text(low), number_text(curve.y[i] + spread));
  }
  return rows;
}

/// @param values  of the curves on this axis
std::string axis(std::string_view name, const std::vector<Curve>& curves,
                 std::vector<double> Curve::*values, bool is_logarithmic) {
  std::vector<double> drawn;
  for (const Curve& curve : curves) {
    std::ranges::copy_if(curve.*values, std::back_inserter(drawn),
                         [](double value) { return std::isfinite(value) && value > 0.0; });
  }
  if (is_logarithmic && !drawn.empty()) return logarithmic_axis(name, drawn);
  return fmt::format("set {}tics out nomirror\n", name);
}

}  // namespace

std::optional<std::string> write_picture(const CurvePicture& picture,
                                         const std::filesystem::path& stem) {
  std::string script =
      fmt::format("set xlabel {}\nset ylabel {}\nset grid linecolor rgb '#dddddd'\n{}{}",
                  gnuplot_text(picture.x_label), gnuplot_text(picture.y_label),
                  axis("x", picture.curves, &Curve::x, picture.has_log_x),
                  axis("y", picture.curves, &Curve::y, picture.has_log_y));
  std::vector<std::string> plots;
  int labels = 0;
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    if (!has_values(curve)) continue;
    const std::string name = fmt::format("curve{}", i);
    script += data_block(name, rows_of(curve, picture.has_log_y));
    const std::string_view colour =
        distinct_colours[static_cast<std::size_t>(curve.colour) % distinct_colours.size()];
    if (!curve.spread.empty()) {
      plots.push_back(fmt::format(
          "${} using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb '#{}' notitle",
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
