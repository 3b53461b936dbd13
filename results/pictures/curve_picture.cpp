// Curves are drawn.
#include "results/pictures/curve_picture.hpp"

#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
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

/// A step of 1, 2 or 5 times a power of ten that has about five places in the narrow panel that
/// these curves stand in.
double panel_step(const std::vector<Curve>& curves) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const Curve& curve : curves) {
    for (const double x : curve.x) {
      least = std::min(least, x);
      greatest = std::max(greatest, x);
    }
  }
  const double rough = (greatest - least) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double digit = rough / power;
  return (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0) * power;
}

/// What a picture's curves and axes are drawn with.
/// What a picture's curves and axes are drawn with.
GnuplotPanel curve_panel(const CurvePicture& picture) {
  GnuplotPanel panel{
      fmt::format("set xlabel {}\nset ylabel {}\nset grid linecolor rgb '#dddddd'\n{}{}",
                  gnuplot_text(picture.x_label), gnuplot_text(picture.y_label),
                  axis("x", picture.curves, &Curve::x, picture.has_log_x),
                  axis("y", picture.curves, &Curve::y, picture.has_log_y)),
      {}};
  if (picture.band) {
    panel.settings += fmt::format(
        "set object 1 rectangle from first {},graph 0 to first {},graph 1 behind fillcolor rgb "
        "'#dcebf5' fillstyle solid noborder\n",
        picture.band->first, picture.band->second);
  }
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    if (!has_values(curve)) continue;
    const std::string name = fmt::format("curve{}", i);
    panel.settings += data_block(name, rows_of(curve, picture.has_log_y));
    const std::string_view colour =
        distinct_colours[static_cast<std::size_t>(curve.colour) % distinct_colours.size()];
    if (!curve.spread.empty()) {
      panel.plots.push_back(fmt::format(
          "${} using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb '#{}' notitle",
          name, colour));
    }
    const std::string style = curve.is_points ? "points pointtype 7 pointsize 0.7"
                              : curve.is_pale ? "lines linewidth 1"
                                              : "lines linewidth 2";
    panel.plots.push_back(fmt::format(
        "${} using 1:2 with {} linecolor rgb '#{}{}' {}", name, style, curve.is_pale ? "90" : "00",
        colour, curve.label.empty() ? "notitle" : "title " + gnuplot_text(curve.label)));
  }
  return panel;
}

constexpr const char* nothing_to_draw = "there is no value to draw";

}  // namespace

std::optional<std::string> write_picture(const CurvePicture& picture,
                                         const std::filesystem::path& stem) {
  const GnuplotPanel panel = curve_panel(picture);
  if (panel.plots.empty()) return nothing_to_draw;
  const auto labels = std::ranges::count_if(
      picture.curves, [](const Curve& curve) { return has_values(curve) && !curve.label.empty(); });
  return draw(picture.title, static_cast<int>((labels + 3) / 4), panel, stem);
}

std::optional<std::string> write_picture(const std::string& title,
                                         const std::vector<CurvePicture>& pictures,
                                         const std::filesystem::path& stem) {
  std::vector<GnuplotPanel> panels;
  for (const CurvePicture& picture : pictures) {
    GnuplotPanel panel = curve_panel(picture);
    if (panel.plots.empty()) continue;
    const double step = panel_step(picture.curves);
    if (!picture.has_log_x && step > 0.0) panel.settings += fmt::format("set xtics {}\n", step);
    panel.settings.insert(0, fmt::format("set title {}\n", gnuplot_text(picture.title)));
    panels.push_back(std::move(panel));
  }
  if (panels.empty()) return nothing_to_draw;
  const std::size_t columns = std::min<std::size_t>(3, panels.size());
  return draw(
      {.title = title,
       .columns = columns,
       .room = {.width = 300, .height = 230, .left = 82, .right = 22, .below = 70, .above = 24},
       .panels = std::move(panels)},
      stem);
}

}  // namespace nlcwfs
