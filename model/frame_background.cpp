// What is left of the background in a calibrated frame.
#include "model/frame_background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace nlcwfs {
namespace {

constexpr std::size_t sector_count = 16;
constexpr double scattering_exponent = 11.0 / 3.0;

/// Normal equations of a fit of the level and of c.
struct Fit {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  int pixels = 0;

  /// @param distance  from the axis, in halves of the frame's width
  void add(double distance, double intensity) {
    const double falling = std::pow(distance, -scattering_exponent);
    // The variance is that of the light, which falls off.
    const double weight = 1.0 / falling;
    const Eigen::Vector2d terms(1.0, falling);
    normal += weight * terms * terms.transpose();
    right += weight * intensity * terms;
    ++pixels;
  }
  Fit without(const Fit& part) const {
    return {normal - part.normal, right - part.right, pixels - part.pixels};
  }
  double level() const { return (normal.inverse() * right).x(); }
};

}  // namespace

std::optional<FrameBackground> frame_background(const Image<double>& frame, double pupil_pixels,
                                                const Eigen::Array2d& axis) {
  const double half_width = 0.5 * double(frame.rows());
  const double nearest = std::max(0.9 * half_width, 0.75 * pupil_pixels);
  std::array<Fit, sector_count> sectors;
  Fit whole;
  for (Eigen::Index row = 0; row < frame.rows(); ++row) {
    const double y = double(row) + 0.5 - half_width - axis.y();
    for (Eigen::Index column = 0; column < frame.cols(); ++column) {
      const double x = double(column) + 0.5 - half_width - axis.x();
      const double distance = std::hypot(x, y);
      if (distance < nearest || std::isnan(frame(row, column))) continue;
      const double turn = 0.5 + 0.5 * std::atan2(y, x) * std::numbers::inv_pi;
      const auto sector = static_cast<std::size_t>(turn * double(sector_count)) % sector_count;
      sectors[sector].add(distance / half_width, frame(row, column));
      whole.add(distance / half_width, frame(row, column));
    }
  }
  constexpr int fewest_pixels = 64;
  constexpr int fewest_sectors = 8;
  const auto used = std::ranges::count_if(sectors, [](const Fit& one) { return one.pixels > 0; });
  if (whole.pixels < fewest_pixels || used < fewest_sectors) return std::nullopt;

  const double level = whole.level();
  double squares = 0.0;
  for (const Fit& sector : sectors) {
    if (sector.pixels > 0) squares += std::pow(whole.without(sector).level() - level, 2);
  }
  return FrameBackground{level, std::sqrt(squares * double(used - 1) / double(used))};
}

}  // namespace nlcwfs
