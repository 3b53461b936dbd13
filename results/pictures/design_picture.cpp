// A design is drawn from the side.
#include "results/pictures/design_picture.hpp"

#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

constexpr double km = 1e3;

/// The lane of each label, counted from 0, so that neighbours in a lane do not touch.
/// @param places  of the labels along the axis
/// @param width   of a label
std::vector<int> lanes_of(const std::vector<double>& places, double width) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
  std::vector<int> lanes(places.size());
  std::vector<double> last_in_lane;
  for (const std::size_t i : order) {
    auto lane =
        std::ranges::find_if(last_in_lane, [&](double last) { return places[i] - last >= width; });
    if (lane == last_in_lane.end()) lane = last_in_lane.insert(lane, 0.0);
    *lane = places[i];
    lanes[i] = static_cast<int>(lane - last_in_lane.begin());
  }
  return lanes;
}

/// To 4 digits or to the kilometre, without an exponent.
std::string km_text(double distance) {
  return std::abs(distance) < 1e3 ? fmt::format("{:.4g}", distance)
                                  : fmt::format("{:.0f}", distance);
}

}  // namespace

std::optional<std::string> write_design_picture(const std::string& title,
                                                const SensorDesign& design,
                                                const Telescope& telescope, double fried_parameter,
                                                const std::filesystem::path& stem) {
  const double talbot = talbot_distance(fried_parameter, telescope.wavelength);
  const double radius = 0.5 * telescope.diameter;
  const double window = radius * design.detector.window;

  // Along the beam, in km.
  double first = std::min(0.0, std::ranges::min(design.planes)) / km;
  double last = std::max(0.0, std::ranges::max(design.planes)) / km;
  // Where it is far beyond the planes, they would all stand at the pupil.
  const bool shows_talbot = talbot / km < 2.0 * std::max(-first, last);
  std::string talbots;
  for (const double sign : {-1.0, 1.0}) {
    const double place = sign * talbot / km;
    if (!shows_talbot || (sign < 0.0 ? first : last) == 0.0) continue;
    first = std::min(first, place);
    last = std::max(last, place);
    talbots += fmt::format(
        "set arrow from {0},{1} to {0},{2} nohead dashtype (8,6) linewidth 1.5 linecolor rgb "
        "'#d55e00' front\n",
        place, -1.1 * window, 1.08 * window);
  }
  const double margin = 0.08 * (last - first);
  first -= margin;
  last += margin;

  std::vector<double> places;
  for (const double plane : design.planes) places.push_back(plane / km);
  const std::vector<int> lanes = lanes_of(places, 0.13 * (last - first));
  const double lane_height = 0.3 * window;
  std::string planes;
  std::string labels;
  for (std::size_t plane = 0; plane < places.size(); ++plane) {
    const double foot = 1.22 * window + lanes[plane] * lane_height;
    planes += fmt::format("{0} {1}\n{0} {2}\n\n", places[plane], -window, window);
    labels +=
        fmt::format("{} {} {} {} \"{} km\" {} {}\n", places[plane], window, foot + 0.13 * window,
                    plane + 1, km_text(places[plane]), foot, foot - 0.06 * window);
  }
  const double top = 1.2 * window + (std::ranges::max(lanes) + 1) * lane_height;

  // The edge of the geometric beam, and of the light that seeing of FWHM 0.98 lambda / r0 spreads,
  // as far as the picture goes: gnuplot fills areas beyond it wrongly.
  const double bottom = -1.1 * window;
  const double slope = 0.49 * telescope.wavelength / fried_parameter * km;
  std::vector<double> corners{first, 0.0, last};
  for (const double edge : {-bottom, top}) {
    const double reached = (edge - radius) / slope;
    if (-reached > first) corners.push_back(-reached);
    if (reached < last) corners.push_back(reached);
  }
  std::ranges::sort(corners);
  std::string beam;
  std::string shadow;
  for (const double place : corners) {
    const double spread = radius + slope * std::abs(place);
    beam += fmt::format("{} {} {} {} {}\n", place, std::max(-spread, bottom), std::min(spread, top),
                        -radius, radius);
    shadow += fmt::format("{} {} {}\n", place, -radius * telescope.central_obscuration,
                          radius * telescope.central_obscuration);
  }

  std::string script =
      data_block("beam", beam) + data_block("planes", planes) + data_block("labels", labels) +
      data_block("pupil", fmt::format("0 {}\n0 {}\n", -radius, radius)) +
      fmt::format(
          "set xrange [{}:{}]\nset yrange [{}:{}]\nset xlabel 'distance from the pupil, km'\n"
          "set ylabel 'across the beam, m'\nset xtics out nomirror\nset ytics out nomirror\n",
          first, last, bottom, top);
  if (telescope.relay_beam_diameter) {
    const double first_m = bench_distance(first * km, telescope);
    const double last_m = bench_distance(last * km, telescope);
    const bool is_long = std::max(-first_m, last_m) >= 1.0;
    const double unit = is_long ? 1.0 : 1e-3;
    script += fmt::format("set x2range [{}:{}]\nset x2tics out\nset x2label 'on the bench, {}'\n",
                          first_m / unit, last_m / unit, is_long ? "m" : "mm");
  }
  std::vector<std::string> plots{
      "$beam using 1:2:3 with filledcurves linecolor rgb '#e6f0f7' "
      "title 'light spread by seeing, 0.98 lambda / r0'",
      "$beam using 1:4:5 with filledcurves linecolor rgb '#a9cde4' "
      "title 'beam, as wide as the pupil'"};
  if (telescope.central_obscuration > 0.0) {
    script += data_block("shadow", shadow);
    plots.emplace_back("$shadow using 1:2:3 with filledcurves linecolor rgb '#d3e5f1' notitle");
  }
  if (!talbots.empty()) {
    script += talbots;
    plots.push_back(
        fmt::format("NaN with lines dashtype (8,6) linewidth 1.5 linecolor rgb '#d55e00' "
                    "title 'Talbot distance of r0, {} km'",
                    km_text(talbot / km)));
  }
  plots.insert(
      plots.end(),
      {"$pupil using 1:2 with lines linewidth 4 linecolor rgb '#404040' title 'pupil'",
       "$labels using 1:2:(0):($7-$2) with vectors nohead linewidth 0.7 linecolor rgb '#909090' "
       "notitle",
       "$planes using 1:2 with lines linewidth 2.5 linecolor rgb '#440154' "
       "title 'detector windows, numbered as visited'",
       "$labels using 1:3 with points pointtype 7 pointsize 2.4 linecolor rgb '#440154' notitle",
       "$labels using 1:3:4 with labels textcolor rgb 'white' font ',13' notitle",
       "$labels using 1:6:5 with labels font ',12' notitle"});
  return draw(title, 3, {script, plots}, stem);
}

}  // namespace nlcwfs
