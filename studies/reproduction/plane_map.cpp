// A sweep over the distances of two pairs of planes, read.
#include "studies/reproduction/plane_map.hpp"

#include "results/tables/json_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Axes of one value stand around the two.
const Json& element(const Json& matrix, std::size_t near, std::size_t far) {
  const Json* rows = &matrix;
  while (rows->size() == 1 && rows->front().front().is_array()) rows = &rows->front();
  return rows->at(near).at(far);
}

bool are_clear(double near, double far) { return far >= 1.5 * near; }

}  // namespace

std::vector<double> axis_values(const Json& grid, std::string_view name) {
  for (const Json& axis : grid.at("axes")) {
    if (axis.at("name") == name) return numbers_from_json(axis.at("values"));
  }
  return {};
}

PlaneMap::PlaneMap(const Json& grid)
    : grid_(grid), near_(axis_values(grid, "z_near")), far_(axis_values(grid, "z_far")) {}

double PlaneMap::value(const std::string& metric, std::size_t near, std::size_t far) const {
  return number_from_json(element(grid_.at(metric), near, far));
}

MeanAndError PlaneMap::mean(const std::string& metric, std::size_t near, std::size_t far) const {
  return {value(metric, near, far),
          number_from_json(element(grid_.at("standard_error").at(metric), near, far))};
}

std::vector<double> PlaneMap::values_of(const std::string& metric, const Condition& wanted) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t k = 0; k < far_.size(); ++k) {
      if (!wanted(near_[i], far_[k])) continue;
      const double here = value(metric, i, k);
      if (std::isfinite(here)) values.push_back(here);
    }
  }
  return values;
}

double PlaneMap::median_at_near(const std::string& metric, std::size_t near) const {
  return quantile(values_of(metric,
                            [&](double z_near, double z_far) {
                              return z_near == near_[near] && z_far >= 100 * km &&
                                     are_clear(z_near, z_far);
                            }),
                  0.5);
}

std::size_t PlaneMap::valley() const {
  std::vector<double> costs;
  for (std::size_t near = 0; near < near_.size(); ++near) {
    const double cost =
        median_at_near("residual_wfe_nm", near) / 10.0 + median_at_near("loops", near) / 10.0;
    costs.push_back(std::isfinite(cost) ? cost : HUGE_VAL);
  }
  return static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin());
}

std::optional<double> PlaneMap::least_good_far(double talbot) const {
  std::vector<double> means;
  for (const double far : far_) {
    const std::vector<double> loops = values_of("loops", [&](double z_near, double z_far) {
      return z_far == far && are_clear(z_near, z_far) && z_near > talbot / 1.5 &&
             z_near < talbot * 1.5;
    });
    means.push_back(loops.empty() ? HUGE_VAL : mean_and_standard_error(loops).mean);
  }
  const double enough = 1.1 * *std::ranges::min_element(means);
  const auto least = std::ranges::find_if(means, [&](double mean) { return mean <= enough; });
  const auto place = static_cast<std::size_t>(least - means.begin());
  if (!std::isfinite(enough) || place + 1 == far_.size()) return std::nullopt;
  return far_[place];
}

}  // namespace nlcwfs
