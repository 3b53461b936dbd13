// Maps and lines over axes are drawn.
#include "results/pictures/map_picture.hpp"

#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// More rectangles make files that no viewer opens.
constexpr std::size_t most_cells = 100'000;

/// Values over a wider range than this are shown on a logarithmic scale.
constexpr double linear_range = 4.0;

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  bool is_empty() const { return least > greatest; }
};

/// Round numbers of a range, about `count`: multiples of 1, 2 or 5 times a power of ten, or those
/// numbers themselves on a logarithmic scale.
std::vector<double> round_numbers(const Range& range, int count, bool logarithmic) {
  std::vector<double> numbers;
  if (logarithmic) {
    for (const std::vector<double>& digits :
         {std::vector{1.0, 2.0, 5.0}, std::vector{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}}) {
      numbers.clear();
      for (double power = std::floor(std::log10(range.least));
           std::pow(10.0, power) <= range.greatest; ++power) {
        for (const double digit : digits) {
          const double number = digit * std::pow(10.0, power);
          if (number >= range.least && number <= range.greatest) numbers.push_back(number);
        }
      }
      if (numbers.size() >= 5) return numbers;
    }
    numbers.clear();
  }
  const double wanted = (range.greatest - range.least) / count;
  // Of values that differ in their last digits steps would not add up.
  if (!(wanted > 1e-12 * std::max(std::abs(range.least), std::abs(range.greatest)))) {
    return {range.least};
  }
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  double step = 10.0 * power;
  for (const double digit : {5.0, 2.0, 1.0}) {
    if (digit * power >= wanted) step = digit * power;
  }
  // Of an index, or sums of steps would end in digits of rounding.
  for (double index = std::ceil(range.least / step); index * step <= range.greatest; ++index) {
    numbers.push_back(index * step);
  }
  return numbers;
}

/// An axis as it is drawn: its values in ascending order, and what of the axis each takes.
struct DrawnAxis {
  explicit DrawnAxis(const PictureAxis& axis);

  /// Makes room for a point.
  void include(double value) {
    if (is_logarithmic && !(value > 0.0)) return;
    range.include(value);
  }

  /// The script's lines for gnuplot's axis `name`: x or y.
  std::string script(std::string_view name) const;

  std::string label;
  std::vector<std::string> words;
  std::vector<std::size_t> order;  ///< of the axis' values, ascending
  std::vector<double> values;      ///< in that order
  bool is_logarithmic = false;
  std::vector<double> edges;  ///< half-way between values
  Range range = {};           ///< what is drawn
};

DrawnAxis::DrawnAxis(const PictureAxis& axis)
    : label(axis.label), words(axis.words), order(axis.values.size()) {
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return axis.values[i]; });
  for (const std::size_t i : order) values.push_back(axis.values[i]);

  const auto is_even = [&](const auto& scale) {
    const double step = scale(values[1]) - scale(values[0]);
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (std::abs(scale(values[i]) - scale(values[i - 1]) - step) > 1e-6 * step) return false;
    }
    return true;
  };
  is_logarithmic = values.size() > 2 && values.front() > 0.0 && words.empty() &&
                   is_even([](double v) { return std::log(v); }) &&
                   !is_even([](double v) { return v; });

  const auto scaled = [this](double v) { return is_logarithmic ? std::log(v) : v; };
  const auto unscaled = [this](double v) { return is_logarithmic ? std::exp(v) : v; };
  const std::size_t last = values.size() - 1;
  const double before = last > 0 ? scaled(values[1]) - scaled(values[0]) : 1.0;
  const double after = last > 0 ? scaled(values[last]) - scaled(values[last - 1]) : 1.0;
  edges.push_back(unscaled(scaled(values[0]) - 0.5 * before));
  for (std::size_t i = 1; i <= last; ++i) {
    edges.push_back(unscaled(0.5 * (scaled(values[i - 1]) + scaled(values[i]))));
  }
  edges.push_back(unscaled(scaled(values[last]) + 0.5 * after));
  range.include(edges.front());
  range.include(edges.back());
}

std::string DrawnAxis::script(std::string_view name) const {
  std::string script = fmt::format("set {}label {}\nset {}range [{}:{}]\n", name,
                                   gnuplot_text(label), name, range.least, range.greatest);
  if (is_logarithmic) script += fmt::format("set logscale {}\n", name);
  std::string tics =
      words.empty()
          ? fmt::format("{:.12g}", fmt::join(round_numbers(range, 6, is_logarithmic), ", "))
          : "";
  for (std::size_t i = 0; i < words.size(); ++i) {
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_text(words[order[i]]), values[i]);
  }
  const bool is_long = name == "x" && words.size() > 10;
  return script +
         fmt::format("set {}tics {}out nomirror ({})\n", name, is_long ? "rotate " : "", tics);
}

std::string rows_of(const std::vector<PicturePoint>& points) {
  std::string rows;
  for (const PicturePoint& point : points) rows += fmt::format("{} {}\n", point.x, point.y);
  return rows;
}

std::string overlay_data(const PictureOverlay& overlay) {
  std::string script;
  for (std::size_t i = 0; i < overlay.curves.size(); ++i) {
    script += data_block(fmt::format("curve{}", i), rows_of(overlay.curves[i].points));
  }
  if (!overlay.path.empty()) script += data_block("path", rows_of(overlay.path));
  for (std::size_t i = 0; i < overlay.marks.size(); ++i) {
    const PicturePoint& point = overlay.marks[i].point;
    script += data_block(fmt::format("mark{}", i), fmt::format("{} {}\n", point.x, point.y));
  }
  return script;
}

/// What of a plot command draws the overlay: light on dark and dark on light, since it crosses all
/// colours.
/// @param on_map  where lines join the points of the path
std::vector<std::string> overlay_plots(const PictureOverlay& overlay, bool on_map) {
  std::vector<std::string> plots;
  struct Stroke {
    const char* dashes;
    const char* on_map;
    const char* on_white;
  };
  constexpr std::array<Stroke, 3> strokes{{{"(10,5)", "#ff5d3c", "#d55e00"},
                                           {"(3,4)", "#ff4fd8", "#cc79a7"},
                                           {"(12,4,3,4)", "#bdbdbd", "#009e73"}}};
  assert(overlay.curves.size() <= strokes.size());
  for (std::size_t i = 0; i < overlay.curves.size(); ++i) {
    const Stroke& stroke = strokes[i];
    plots.push_back(fmt::format(
        "$curve{} with lines dashtype {} linewidth 2 linecolor rgb '{}' title {}", i, stroke.dashes,
        on_map ? stroke.on_map : stroke.on_white, gnuplot_text(overlay.curves[i].label)));
  }
  if (!overlay.path.empty() && on_map) {
    plots.insert(plots.end(), {"$path with lines linecolor rgb '#a0000000' linewidth 1.6 notitle",
                               "$path with lines linecolor rgb '#60ffffff' linewidth 0.7 notitle"});
  }
  if (!overlay.path.empty()) {
    plots.insert(plots.end(),
                 {"$path with points pointtype 7 pointsize 0.55 linecolor rgb 'black' title " +
                      gnuplot_text(overlay.path_label),
                  "$path with points pointtype 7 pointsize 0.35 linecolor rgb 'white' notitle"});
  }
  struct Symbol {
    int filled;
    double size;
    const char* colour;
  };
  // Up-triangle and diamond, of gnuplot's numbers.
  constexpr std::array<Symbol, 2> symbols{{{9, 1.5, "#ff5d3c"}, {13, 1.6, "#ff4fd8"}}};
  assert(overlay.marks.size() <= symbols.size());
  for (std::size_t i = 0; i < overlay.marks.size(); ++i) {
    const auto& [filled, size, colour] = symbols[i];
    plots.push_back(
        fmt::format("$mark{} with points pointtype {} pointsize {} linecolor rgb '{}' "
                    "title {}",
                    i, filled, size, colour, gnuplot_text(overlay.marks[i].label)));
    plots.push_back(
        fmt::format("$mark{} with points pointtype {} pointsize {} linewidth 1.5 "
                    "linecolor rgb 'black' notitle",
                    i, filled - 1, size));
  }
  return plots;
}

}  // namespace

std::optional<std::string> write_picture(const MapPicture& picture,
                                         const std::filesystem::path& stem) {
  DrawnAxis x(picture.x);
  DrawnAxis y(picture.y);
  if (x.values.size() * y.values.size() > most_cells) {
    return fmt::format("a map of {} x {} points has more than {}", x.values.size(), y.values.size(),
                       most_cells);
  }
  std::string cells;
  std::string grid;
  Range values;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    for (std::size_t j = 0; j < y.values.size(); ++j) {
      const double value = picture.values[x.order[i]][y.order[j]];
      values.include(value);
      grid += fmt::format("{} {} {}\n", x.values[i], y.values[j], number_text(value));
      if (!std::isfinite(value)) continue;
      cells += fmt::format("{} {} {} {} {} {} {}\n", x.values[i], y.values[j], x.edges[i],
                           x.edges[i + 1], y.edges[j], y.edges[j + 1], value);
    }
    grid += '\n';
  }
  if (values.is_empty()) return "there is no value to draw";
  for (const PicturePoint& point : picture.overlay.path) {
    x.include(point.x);
    y.include(point.y);
  }
  const bool is_logarithmic =
      !picture.is_linear && values.least > 0.0 && values.greatest > linear_range * values.least;
  const std::vector<double> levels = round_numbers(values, 8, is_logarithmic);
  // A plain: any range will do, but not none.
  if (values.least == values.greatest) values.greatest += std::max(1e-9, std::abs(values.least));

  std::string script = data_block("cells", cells) + overlay_data(picture.overlay);
  std::vector<std::string> plots{
      "$cells using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid border linewidth 0.4 linecolor "
      "palette "
      "notitle"};
  if (x.values.size() > 1 && y.values.size() > 1 && x.words.empty() && y.words.empty()) {
    script += data_block("grid", grid) +
              fmt::format(
                  "set contour base\nunset surface\nset cntrparam levels discrete {:.12g}\n"
                  "set table $contours\nsplot $grid using 1:2:3\nunset table\n"
                  "unset contour\nset surface\n",
                  fmt::join(levels, ", "));
    plots.emplace_back(
        "$contours using 1:2 with lines linecolor rgb '#50ffffff' linewidth 0.9 notitle");
  }
  script +=
      x.script("x") + y.script("y") +
      fmt::format(
          "{}set cblabel {} offset 0.8,0\n"
          "set cbrange [{}:{}]\n{}set cbtics ({:.12g})\n",
          sequential_palette, gnuplot_text(picture.value_label), values.least, values.greatest,
          is_logarithmic ? "set logscale cb\n" : "", fmt::join(levels, ", ")) +
      // Where there is no value.
      "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#d9d9d9' "
      "fillstyle solid noborder\n";
  const std::vector<std::string> overlay = overlay_plots(picture.overlay, true);
  plots.insert(plots.end(), overlay.begin(), overlay.end());
  return draw(picture.title, overlay.empty() ? 0 : 1, {script, plots}, stem);
}

std::optional<std::string> write_picture(const LinePicture& picture,
                                         const std::filesystem::path& stem) {
  DrawnAxis x(picture.x);
  std::string rows;
  Range values;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const MeanAndError& value = picture.values[x.order[i]];
    values.include(value.mean - value.standard_error);
    values.include(value.mean + value.standard_error);
    rows += fmt::format("{} {} {}\n", x.values[i], number_text(value.mean),
                        number_text(value.standard_error));
  }
  if (values.is_empty()) return "there is no value to draw";
  for (const PicturePoint& point : picture.overlay.path) {
    x.include(point.x);
    values.include(point.y);
  }
  for (const PictureMark& mark : picture.overlay.marks) values.include(mark.point.y);
  for (const PictureCurve& curve : picture.overlay.curves) {
    for (const PicturePoint& point : curve.points) values.include(point.y);
  }
  const double margin =
      0.05 * (values.greatest - values.least) + 1e-9 * std::max(1.0, std::abs(values.greatest));
  std::string script =
      data_block("line", rows) + overlay_data(picture.overlay) + x.script("x") +
      fmt::format(
          "set ylabel {}\nset ytics out nomirror\nset yrange [{}:{}]\nset grid linecolor "
          "rgb '#dddddd'\n",
          gnuplot_text(picture.value_label), values.least - margin, values.greatest + margin);
  std::vector<std::string> plots{
      "$line using 1:2 with lines linecolor rgb '#31688e' linewidth 1.5 " +
          // Beside curves it must be told which it is.
          (picture.overlay.curves.empty() ? "notitle"
                                          : "title " + gnuplot_text(picture.value_label)),
      "$line using 1:2:3 with yerrorbars pointtype 7 pointsize 0.6 linecolor rgb '#31688e' "
      "notitle"};
  const std::vector<std::string> overlay = overlay_plots(picture.overlay, false);
  plots.insert(plots.end(), overlay.begin(), overlay.end());
  return draw(picture.title, overlay.empty() ? 0 : 1, {script, plots}, stem);
}

}  // namespace nlcwfs
