#include "objectives/optimum_range.hpp"

#include "objectives/design_comparison.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nlcwfs {
namespace {

constexpr double first_step = 0.01;
constexpr int halvings = 2;

class Scan {
 public:
  Scan(const DesignSpace& space, const DesignTrial& trial, const SearchPoint& best)
      : space_(space), trial_(trial), best_(best), reference_(trial.run(space.design(best))) {}

  int designs() const { return designs_; }

  bool is_worse(std::size_t variable, double x) {
    SearchPoint point = best_;
    point.x[Eigen::Index(variable)] = x;
    ++designs_;
    try {
      const TriedDesign tried = trial_.run(space_.design(point));
      return tried.violation > reference_.violation ||
             improvement(tried, reference_).verdict == Verdict::worse;
    } catch (const std::exception&) {
      return true;  // no design at all
    }
  }

  /// The farthest value on one side that is as good.
  double end(std::size_t variable, double bound) {
    const double centre = best_.x[Eigen::Index(variable)];
    const Variable& limits =
        space_.sub_spaces()[static_cast<std::size_t>(best_.sub_space)].variables[variable];
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

 private:
  const DesignSpace& space_;
  const DesignTrial& trial_;
  const SearchPoint& best_;
  TriedDesign reference_;
  int designs_ = 1;
};

}  // namespace

OptimumScan optimum_ranges(const DesignSpace& space, const DesignTrial& trial,
                           const SearchPoint& best, const std::function<bool()>& stop) {
  if (stop()) return {};
  Scan scan(space, trial, best);
  const std::vector<Variable> variables =
      space.sub_spaces()[static_cast<std::size_t>(best.sub_space)].variables;
  std::vector<OptimumRange> ranges;
  for (std::size_t i = 0; i < variables.size() && !stop(); ++i) {
    if (!variables[i].is_continuous()) continue;
    const double lower = scan.end(i, variables[i].lower);
    const double upper = scan.end(i, variables[i].upper);
    ranges.push_back({.name = space.name(best.sub_space, i),
                      .best = space.value(best.sub_space, i, best.x[Eigen::Index(i)]),
                      .least = space.value(best.sub_space, i, lower),
                      .greatest = space.value(best.sub_space, i, upper),
                      .least_is_bound = lower == variables[i].lower,
                      .greatest_is_bound = upper == variables[i].upper});
  }
  return {std::move(ranges), scan.designs()};
}

}  // namespace nlcwfs
