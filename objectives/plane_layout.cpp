#include "objectives/plane_layout.hpp"

#include "model/input_error.hpp"
#include "model/sensor_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

constexpr double nearest_fresnel_number = 200.0;
constexpr double farthest_fresnel_number = 2.0;

double length_unit(const Telescope& telescope) {
  return distance_at_fresnel_number(telescope, 1.0);
}

bool is_equal_distance(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }

/// Planes come back from their logarithms with a rounding error, also at the ends of a range.
bool is_within(DistanceRange range, double distance) {
  return (distance >= range.first || is_equal_distance(distance, range.first)) &&
         (distance <= range.second || is_equal_distance(distance, range.second));
}

void require_range(const std::string& key, DistanceRange range, double least,
                   const Telescope& telescope) {
  const auto [min, max] = range;
  if (!(min < max) || !(min > least) || min == 0.0 || max == 0.0) {
    throw InputError(key, fmt::format("{:g}:{:g}", min, max),
                     least == 0.0 ? "min:max with 0 < min < max, such as 5km:100km"
                                  : "min:max with min < max, neither of them 0");
  }
  const double farthest = farthest_distance(telescope);
  if (min < -farthest || max > farthest) {
    throw InputError(
        key, fmt::format("{:g}:{:g}", min, max),
        fmt::format("min:max within +-{:.6g} m, the farthest that a plane may be", farthest));
  }
}

}  // namespace

DistanceRange default_distance_range(const Telescope& telescope) {
  return {distance_at_fresnel_number(telescope, nearest_fresnel_number),
          distance_at_fresnel_number(telescope, farthest_fresnel_number)};
}

SymmetricLayout::SymmetricLayout(const Telescope& telescope, DistanceRange near, DistanceRange far)
    : length_unit_(length_unit(telescope)), near_(near), far_(far) {
  require_range("search.z_near", near, 0.0, telescope);
  require_range("search.z_far", far, 0.0, telescope);
  std::vector<int> order(4);
  std::iota(order.begin(), order.end(), 0);
  do {
    orders_.push_back(order);
  } while (std::ranges::next_permutation(order).found);
}

std::vector<Variable> SymmetricLayout::variables() const {
  return {
      {"log z_near", std::log(near_.first / length_unit_), std::log(near_.second / length_unit_)},
      {"log z_far", std::log(far_.first / length_unit_), std::log(far_.second / length_unit_)}};
}

std::vector<double> SymmetricLayout::planes(const SearchPoint& point) const {
  const double near = length_unit_ * std::exp(point.x[0]);
  const double far = length_unit_ * std::exp(point.x[1]);
  const std::array<double, 4> numbered{-near, near, -far, far};
  std::vector<double> planes;
  for (const int plane : orders_[static_cast<std::size_t>(point.choice)]) {
    planes.push_back(numbered[static_cast<std::size_t>(plane)]);
  }
  return planes;
}

std::optional<SearchPoint> SymmetricLayout::point_of(const std::vector<double>& planes) const {
  if (planes.size() != 4) return std::nullopt;
  std::vector<double> sorted = planes;
  std::ranges::sort(sorted);
  if (!(sorted[2] > 0.0) || !is_equal_distance(-sorted[0], sorted[3]) ||
      !is_equal_distance(-sorted[1], sorted[2])) {
    return std::nullopt;
  }
  // Where the ranges overlap or are exchanged, the nearer pair may be the one called far.
  for (const auto& [near, far] : {std::pair(sorted[2], sorted[3]), {sorted[3], sorted[2]}}) {
    if (!is_within(near_, near) || !is_within(far_, far)) continue;
    SearchPoint point{0,
                      Eigen::Vector2d(std::log(near / length_unit_), std::log(far / length_unit_))};
    for (; point.choice < choice_count(); ++point.choice) {
      if (std::ranges::equal(this->planes(point), planes, is_equal_distance)) return point;
    }
  }
  return std::nullopt;
}

FreeLayout::FreeLayout(const Telescope& telescope, std::vector<DistanceRange> ranges)
    : length_unit_(length_unit(telescope)),
      nearest_plane_(default_distance_range(telescope).first) {
  for (std::size_t plane = 0; plane < ranges.size(); ++plane) {
    require_range(fmt::format("search.z{}", plane + 1), ranges[plane], -HUGE_VAL, telescope);
    const auto [min, max] = ranges[plane];
    if (min < 0.0 && max > 0.0) nearest_plane_ = std::min({nearest_plane_, -0.5 * min, 0.5 * max});
  }
  ranges_ = std::move(ranges);
}

// On one side of the pupil the variable is log(|Z| lambda / D^2), negated behind it so that it
// grows with Z. On both sides it is the signed number of e-folds from the nearest plane:
// sign(Z) log(|Z| / nearest).
std::vector<Variable> FreeLayout::variables() const {
  std::vector<Variable> variables;
  for (const auto& [min, max] : ranges_) {
    const std::string name = fmt::format("log z{}", variables.size() + 1);
    if (min > 0.0) {
      variables.push_back({name, std::log(min / length_unit_), std::log(max / length_unit_)});
    } else if (max < 0.0) {
      variables.push_back({name, -std::log(-min / length_unit_), -std::log(-max / length_unit_)});
    } else {
      variables.push_back({name, -std::log(-min / nearest_plane_), std::log(max / nearest_plane_)});
    }
  }
  return variables;
}

std::vector<double> FreeLayout::planes(const SearchPoint& point) const {
  std::vector<double> planes;
  for (const auto& [min, max] : ranges_) {
    const double x = point.x[static_cast<Eigen::Index>(planes.size())];
    if (min > 0.0) {
      planes.push_back(length_unit_ * std::exp(x));
    } else if (max < 0.0) {
      planes.push_back(-length_unit_ * std::exp(-x));
    } else {
      planes.push_back(std::copysign(nearest_plane_ * std::exp(std::abs(x)), x));
    }
  }
  return planes;
}

std::optional<SearchPoint> FreeLayout::point_of(const std::vector<double>& planes) const {
  if (planes.size() != ranges_.size()) return std::nullopt;
  SearchPoint point{0, Eigen::VectorXd(planes.size())};
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const auto [min, max] = ranges_[plane];
    const double z = planes[plane];
    if (!is_within(ranges_[plane], z) ||
        std::abs(z) < (min < 0.0 && max > 0.0 ? nearest_plane_ : 0.0)) {
      return std::nullopt;
    }
    double& x = point.x[static_cast<Eigen::Index>(plane)];
    if (min < 0.0 && max > 0.0) {
      x = std::copysign(std::log(std::abs(z) / nearest_plane_), z);
    } else {
      x = std::copysign(1.0, z) * std::log(std::abs(z) / length_unit_);
    }
  }
  return point;
}

}  // namespace nlcwfs
