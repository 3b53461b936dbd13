#include "studies/plane_map.hpp"

#include "results/json_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double km = 1e3;

/// Axes of one value stand around the two.
const Json& element(const Json& matrix, std::size_t near, std::size_t far) {
  const Json* rows = &matrix;
  while (rows->size() == 1 && rows->front().front().is_array()) rows = &rows->front();
  return rows->at(near).at(far);
}

std::size_t nearest(const std::vector<double>& values, double wanted) {
  const auto found =
      std::ranges::min_element(values, {}, [&](double value) { return std::abs(value - wanted); });
  return static_cast<std::size_t>(found - values.begin());
}

}  // namespace

PlaneMap::PlaneMap(const Json& grid) : grid_(grid) {
  for (const Json& axis : grid.at("axes")) {
    if (axis.at("name") == "z_near") near_ = axis.at("values").get<std::vector<double>>();
    if (axis.at("name") == "z_far") far_ = axis.at("values").get<std::vector<double>>();
  }
}

double PlaneMap::value(const std::string& figure, std::size_t near, std::size_t far) const {
  return number_from_json(element(grid_.at(figure), near, far));
}

MeanAndError PlaneMap::mean(const std::string& figure, std::size_t near, std::size_t far) const {
  return {value(figure, near, far),
          number_from_json(element(grid_.at("standard_error").at(figure), near, far))};
}

double PlaneMap::mean_over(const std::string& figure,
                           const std::function<bool(double near, double far)>& wanted) const {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t k = 0; k < far_.size(); ++k) {
      if (!wanted(near_[i], far_[k])) continue;
      const double here = value(figure, i, k);
      if (!std::isfinite(here)) continue;
      sum += here;
      ++count;
    }
  }
  return sum / count;  // NaN without any
}

double PlaneMap::greatest_over(const std::string& figure,
                               const std::function<bool(double near, double far)>& wanted) const {
  double greatest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t k = 0; k < far_.size(); ++k) {
      if (wanted(near_[i], far_[k])) greatest = std::fmax(greatest, value(figure, i, k));
    }
  }
  return greatest;
}

double PlaneMap::lowest(const std::string& figure) const {
  double lowest = HUGE_VAL;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t k = 0; k < far_.size(); ++k) {
      lowest = std::fmin(lowest, value(figure, i, k));
    }
  }
  return lowest;
}

double PlaneMap::mean_at_near(const std::string& figure, std::size_t near) const {
  return mean_over(figure, [&](double z_near, double z_far) {
    return z_near == near_[near] && z_far >= 100 * km && z_far > 1.5 * z_near;
  });
}

std::size_t PlaneMap::valley() const {
  std::vector<double> loops;
  for (std::size_t near = 0; near < near_.size(); ++near) {
    const double mean = mean_at_near("loops", near);
    loops.push_back(std::isfinite(mean) ? mean : HUGE_VAL);
  }
  return static_cast<std::size_t>(std::ranges::min_element(loops) - loops.begin());
}

double PlaneMap::least_good_far() const {
  const std::size_t near = valley();
  double fewest = HUGE_VAL;
  for (std::size_t k = 0; k < far_.size(); ++k) {
    fewest = std::fmin(fewest, value("loops", near, k));
  }
  double least = far_.back();
  for (std::size_t k = far_.size(); k-- > 0 && value("loops", near, k) <= 1.1 * fewest;) {
    least = far_[k];
  }
  return least;
}

std::size_t PlaneMap::nearest_far(double distance) const { return nearest(far_, distance); }

}  // namespace nlcwfs
