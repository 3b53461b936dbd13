// How far each variable of the best design may move.
#include "objectives/optimum_range.hpp"

#include "objectives/design_comparison.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace nlcwfs {
namespace {

constexpr double first_step = 0.01;
constexpr int halvings = 2;

/// Thrown where the watch ends a trial.
struct ScanEnded {};

struct Scan {
  const DesignSpace& space;
  const DesignTrial& trial;
  const SearchPoint& best;
  const std::function<void(double)>& report;
  const ScreenWatch& watch;
  SubSpace sub_space = space.sub_spaces()[static_cast<std::size_t>(best.sub_space)];
  int ends_done = 0;
  int designs_of_end = 0;
  int designs = 0;
  TriedDesign reference = {};             ///< what the others are held against
  std::vector<ScannedValue> values = {};  ///< of the variable that is being scanned

  /// @throws ScanEnded
  OptimumRange range(std::size_t variable) {
    const Variable& limits = sub_space.variables[variable];
    const double best_value = value_of(variable, best.x[Eigen::Index(variable)]);
    values = {{.value = best_value, .cost_difference = {}, .is_worse = false}};
    const double lower = end(variable, limits.lower);
    const double upper = end(variable, limits.upper);
    std::ranges::sort(values, {}, &ScannedValue::value);
    return {.name = space.name(best.sub_space, variable),
            .best = best_value,
            .least = value_of(variable, lower),
            .greatest = value_of(variable, upper),
            .least_is_bound = lower == limits.lower,
            .greatest_is_bound = upper == limits.upper,
            .values = values};
  }

  double value_of(std::size_t variable, double x) const {
    return space.value(best.sub_space, variable, x);
  }

  /// The farthest value on one side that is as good.
  double end(std::size_t variable, double bound) {
    const double centre = best.x[Eigen::Index(variable)];
    const Variable& limits = sub_space.variables[variable];
    const double whole = std::abs(bound - centre);
    const double direction = bound > centre ? 1.0 : -1.0;
    designs_of_end = 0;
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
    ++ends_done;
    return good == whole ? bound : centre + direction * good;
  }

  bool is_worse(std::size_t variable, double x) {
    SearchPoint point = best;
    point.x[Eigen::Index(variable)] = x;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    ScannedValue scanned{
        .value = value_of(variable, x), .cost_difference = {nan, nan}, .is_worse = true};
    try {
      const TriedDesign moved = tried(point);
      const Improvement change = improvement(moved, reference);
      scanned.cost_difference = {-change.cost.mean, change.cost.standard_error};
      scanned.is_worse = moved.violation > reference.violation || change.verdict == Verdict::worse;
    } catch (const TrialMemoryFailed&) {
      throw;  // no design is to blame
    } catch (const std::exception&) {
      // No design at all.
    }
    values.push_back(scanned);
    return scanned.is_worse;
  }

  /// @throws ScanEnded
  TriedDesign tried(const SearchPoint& point) {
    ++designs;
    // Where there are as many threads as screens, all are begun before the first is done.
    std::atomic<bool> is_ended = false;
    TriedDesign design = trial.run(space.design(point), {}, [&] {
      if (watch && !watch()) is_ended = true;
      return !is_ended;
    });
    if (is_ended) throw ScanEnded();
    // How far an end is, is not known before; most are nearer than the bound.
    constexpr double usual_designs_of_end = 8.0;
    const double share = std::min(1.0, ++designs_of_end / usual_designs_of_end);
    const int ends = 2 * sub_space.continuous_count();
    if (report) report((ends_done + share) / ends);
    return design;
  }
};

}  // namespace

OptimumScan optimum_ranges(const DesignSpace& space, const DesignTrial& trial,
                           const SearchPoint& best, const std::function<void(double)>& report,
                           const ScreenWatch& watch) {
  Scan scan{space, trial, best, report, watch};
  const SubSpace& sub_space = scan.sub_space;
  if (sub_space.continuous_count() == 0) return {};
  std::vector<OptimumRange> ranges;
  try {
    scan.reference = scan.tried(best);
    for (std::size_t i = 0; i < sub_space.variables.size(); ++i) {
      if (sub_space.variables[i].is_continuous()) ranges.push_back(scan.range(i));
    }
  } catch (const ScanEnded&) {
    // With the variables that are done.
  }
  return {std::move(ranges), scan.designs};
}

}  // namespace nlcwfs
