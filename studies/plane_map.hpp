#pragma once

#include "model/statistics.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A sweep's figures over the distances of the near and the far pair, in m. What else the grid has
/// must have one value each.
class PlaneMap {
 public:
  /// @param grid  the object `grid` of a sweep's summary, which must outlive the map
  explicit PlaneMap(const nlohmann::ordered_json& grid);

  const std::vector<double>& near() const { return near_; }
  const std::vector<double>& far() const { return far_; }

  /// A figure as the grid names it, "residual_wfe_nm", ...; NaN where the map has no design.
  double value(const std::string& figure, std::size_t near, std::size_t far) const;
  MeanAndError mean(const std::string& figure, std::size_t near, std::size_t far) const;

  /// Its mean over the points that are wanted; NaN where there is none.
  double mean_over(const std::string& figure,
                   const std::function<bool(double near, double far)>& wanted) const;

  /// The greatest of the points that are wanted; NaN where there is none.
  double greatest_over(const std::string& figure,
                       const std::function<bool(double near, double far)>& wanted) const;

  /// The lowest of the map.
  double lowest(const std::string& figure) const;

  /// A figure's mean over the far distances from 100 km on that are clear of the near one; NaN
  /// where there is none.
  double mean_at_near(const std::string& figure, std::size_t near) const;

  /// The near distance at which the loops' mean_at_near is least: the valley of Letchev et al.
  /// 2022, section 3.2.
  std::size_t valley() const;

  /// The least far distance from which on the loops in the valley stay within a tenth of their
  /// fewest, m.
  double least_good_far() const;

  std::size_t nearest_far(double distance) const;

 private:
  const nlohmann::ordered_json& grid_;
  std::vector<double> near_;
  std::vector<double> far_;
};

}  // namespace nlcwfs
