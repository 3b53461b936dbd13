// A sweep over the distances of two pairs of planes, read.
#pragma once

#include "model/statistics.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A kilometre, m.
inline constexpr double km = 1e3;

/// The values of an axis of a sweep's grid; none where it has no such axis.
std::vector<double> axis_values(const nlohmann::ordered_json& grid, std::string_view name);

/// A sweep's metrics over the distances of the near and the far pair, in m. What else the grid has
/// must have one value each.
class PlaneMap {
 public:
  /// Says of a design whether it is meant.
  using Condition = std::function<bool(double near, double far)>;

  /// @param grid  the object `grid` of a sweep's summary, which must outlive the map
  explicit PlaneMap(const nlohmann::ordered_json& grid);

  /// Distances of the near pair, m.
  const std::vector<double>& near() const { return near_; }
  /// Distances of the far pair, m.
  const std::vector<double>& far() const { return far_; }

  /// A metric as the grid names it, "residual_wfe_nm", ...; NaN where the map has no design.
  double value(const std::string& metric, std::size_t near, std::size_t far) const;
  /// The same with its standard error.
  MeanAndError mean(const std::string& metric, std::size_t near, std::size_t far) const;

  /// Its values at the designs that are wanted and that the map has.
  std::vector<double> values_of(const std::string& metric, const Condition& wanted) const;

  /// A metric's median over the far distances from 100 km on that are clear of the near one: at
  /// least 1.5 times as far. NaN where there is none.
  double median_at_near(const std::string& metric, std::size_t near) const;

  /// The near distance at which residual and loops are low together: where median_at_near of
  /// residual WFE / 10 nm + loops / 10, the program's own default cost, is least. Few loops alone
  /// say little: a reconstruction that stops by chance has few.
  std::size_t valley() const;

  /// The least far distance, m, whose loops, averaged over the near distances within a factor 1.5
  /// of `talbot` that are clear of it, are within a tenth of the fewest such average. Nothing where
  /// that is the map's last distance: then it may lie beyond.
  std::optional<double> least_good_far(double talbot) const;

 private:
  const nlohmann::ordered_json& grid_;
  std::vector<double> near_;
  std::vector<double> far_;
};

}  // namespace nlcwfs
