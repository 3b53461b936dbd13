// Square images are drawn in their colours.
#include "results/pictures/image_picture.hpp"

#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::pair<double, double> range_of(const ImagePanel& panel) {
  if (panel.range) return *panel.range;
  double least = panel.values.minCoeff<Eigen::PropagateNumbers>();
  double greatest = panel.values.maxCoeff<Eigen::PropagateNumbers>();
  if (panel.is_signed) {
    greatest = std::max(std::abs(least), std::abs(greatest));
    least = -greatest;
  }
  // A plain image: any range will do, but not none.
  if (least == greatest) greatest += std::max(1e-9, std::abs(greatest));
  return {least, greatest};
}

/// @param data   the file that holds the values of all panels
/// @param first  of the panel's values there
GnuplotPanel panel_of(const ImagePicture& picture, const ImagePanel& panel, const std::string& data,
                      std::size_t first) {
  const auto [least, greatest] = range_of(panel);
  const Eigen::Index samples = panel.values.rows();
  const double half_width = 0.5 * double(samples) * panel.pitch;
  GnuplotPanel drawn;
  drawn.settings = fmt::format(
      "set title {} offset 0,-0.5\n"
      "set size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\nset xlabel {}\n"
      "set ylabel {} offset 1,0\nset xtics out nomirror\nset ytics out nomirror\n"
      "set cblabel {} offset 1,0\nset format cb '%g'\nset cbrange [{}:{}]\n{}",
      gnuplot_text(panel.title), -half_width, half_width, -half_width, half_width,
      gnuplot_text("x, " + picture.axis_unit), gnuplot_text("y, " + picture.axis_unit),
      gnuplot_text(panel.value_label), least, greatest,
      panel.is_signed ? signed_palette : sequential_palette);
  if (picture.circle > 0.0) {
    drawn.settings += fmt::format(
        "set object 1 circle at first 0,0 size first {} front fillstyle empty border linecolor rgb "
        "'{}' dashtype (6,6) linewidth 1\n",
        0.5 * picture.circle, panel.is_signed ? "#404040" : "#ffffff");
  }
  drawn.plots.push_back(fmt::format(
      "{} binary array=({},{}) format='%float32' skip={} origin=({},{}) dx={} dy={} with image "
      "notitle",
      gnuplot_text(data), samples, samples, first * sizeof(float), -half_width + 0.5 * panel.pitch,
      -half_width + 0.5 * panel.pitch, panel.pitch, panel.pitch));
  return drawn;
}

}  // namespace

std::optional<std::string> write_picture(const ImagePicture& picture,
                                         const std::filesystem::path& stem) {
  const std::filesystem::path data = std::filesystem::absolute(stem).string() + ".data.part";
  std::error_code ignored;
  std::filesystem::remove(data, ignored);  // never written through a link
  const std::size_t count = picture.panels.size();
  GnuplotPanels figure{
      .title = picture.title,
      .columns = count == 4 ? 2 : std::min<std::size_t>(count, 3),
      .room = {.width = 250, .height = 250, .left = 68, .right = 92, .below = 70, .above = 30},
      .panels = {}};
  std::ofstream file(data, std::ios::binary);
  std::size_t written = 0;
  for (const ImagePanel& panel : picture.panels) {
    if (!panel.values.isFinite().any()) continue;
    figure.panels.push_back(panel_of(picture, panel, data.string(), written));
    const Image<float> values = panel.values.cast<float>();
    file.write(
        reinterpret_cast<const char*>(values.data()),
        static_cast<std::streamsize>(static_cast<std::size_t>(values.size()) * sizeof(float)));
    written += static_cast<std::size_t>(values.size());
  }
  file.close();
  std::optional<std::string> failure;
  if (!file) {
    failure = fmt::format("cannot write {}", data.string());
  } else if (figure.panels.empty()) {
    failure = "there is no value to draw";
  } else {
    failure = draw(figure, stem);
  }
  std::filesystem::remove(data, ignored);
  return failure;
}

}  // namespace nlcwfs
