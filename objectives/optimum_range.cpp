#include "objectives/optimum_range.hpp"

#include "objectives/design_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nlcwfs {
namespace {

constexpr double first_step = 0.01;
constexpr int halvings = 2;

class Scan {
 public:
  Scan(const DesignSpace& space, const DesignTrial& trial, const SearchPoint& best)
      : space_(space),
        trial_(trial),
        best_(best),
        variables_(space.sub_spaces()[static_cast<std::size_t>(best.sub_space)].variables),
        reference_(trial.run(space.design(best))) {}

  int designs() const { return designs_; }

  OptimumRange range(std::size_t variable) {
    const Variable& limits = variables_[variable];
    const double best = value_of(variable, best_.x[Eigen::Index(variable)]);
    values_ = {{.value = best, .cost_difference = {}, .is_worse = false}};
    const double lower = end(variable, limits.lower);
    const double upper = end(variable, limits.upper);
    std::ranges::sort(values_, {}, &ScannedValue::value);
    return {.name = space_.name(best_.sub_space, variable),
            .best = best,
            .least = value_of(variable, lower),
            .greatest = value_of(variable, upper),
            .least_is_bound = lower == limits.lower,
            .greatest_is_bound = upper == limits.upper,
            .values = values_};
  }

  const std::vector<Variable>& variables() const { return variables_; }

 private:
  double value_of(std::size_t variable, double x) const {
    return space_.value(best_.sub_space, variable, x);
  }

  bool is_worse(std::size_t variable, double x) {
    SearchPoint point = best_;
    point.x[Eigen::Index(variable)] = x;
    ++designs_;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    ScannedValue scanned{
        .value = value_of(variable, x), .cost_difference = {nan, nan}, .is_worse = true};
    try {
      const TriedDesign tried = trial_.run(space_.design(point));
      const Improvement change = improvement(tried, reference_);
      scanned.cost_difference = {-change.cost.mean, change.cost.standard_error};
      scanned.is_worse = tried.violation > reference_.violation || change.verdict == Verdict::worse;
    } catch (const std::exception&) {
      // No design at all.
    }
    values_.push_back(scanned);
    return scanned.is_worse;
  }

  /// The farthest value on one side that is as good.
  double end(std::size_t variable, double bound) {
    const double centre = best_.x[Eigen::Index(variable)];
    const Variable& limits = variables_[variable];
    const double whole = std::abs(bound - centre);
    const double direction = bound > centre ? 1.0 : -1.0;
    double good = 0.0;
    double step = std::min(whole, first_step * (limits.upper - limits.lower));
    while (good < whole && !is_worse(variable, centre + direction * step)) {
      good = step;
      step = std::min(whole, 2.0 * step);
    }
    for (int i = 0; i < halvings && good < whole; ++i) {
      const double middle = 0.5 * (good + step);
      (is_worse(variable, centre + direction * middle) ? step : good) = middle;
    }
    return good == whole ? bound : centre + direction * good;
  }

  const DesignSpace& space_;
  const DesignTrial& trial_;
  const SearchPoint& best_;
  std::vector<Variable> variables_;
  TriedDesign reference_;
  std::vector<ScannedValue> values_;  ///< of the variable that is being scanned
  int designs_ = 1;
};

}  // namespace

OptimumScan optimum_ranges(const DesignSpace& space, const DesignTrial& trial,
                           const SearchPoint& best, const std::function<bool()>& stop) {
  if (stop()) return {};
  Scan scan(space, trial, best);
  std::vector<OptimumRange> ranges;
  for (std::size_t i = 0; i < scan.variables().size() && !stop(); ++i) {
    if (scan.variables()[i].is_continuous()) ranges.push_back(scan.range(i));
  }
  return {std::move(ranges), scan.designs()};
}

}  // namespace nlcwfs
