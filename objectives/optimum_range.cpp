#include "objectives/optimum_range.hpp"

#include "objectives/design_comparison.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

namespace nlcwfs {
namespace {

constexpr double first_step = 0.01;
constexpr int halvings = 2;

/// Thrown where the watch ends a trial.
struct ScanEnded {};

class Scan {
 public:
  Scan(const DesignSpace& space, const DesignTrial& trial, const SearchPoint& best,
       const std::function<void(double)>& report, const ScreenWatch& watch)
      : space_(space),
        trial_(trial),
        best_(best),
        report_(report),
        watch_(watch),
        ends_(2 * space.sub_spaces()[static_cast<std::size_t>(best.sub_space)].continuous_count()) {
  }

  /// What the others are held against; before them.
  void try_best() { reference_ = tried(best_); }

  int designs() const { return designs_; }

  /// The farthest value on one side that is as good.
  double end(std::size_t variable, double bound) {
    const double centre = best_.x[Eigen::Index(variable)];
    const Variable& limits =
        space_.sub_spaces()[static_cast<std::size_t>(best_.sub_space)].variables[variable];
    const double whole = std::abs(bound - centre);
    const double direction = bound > centre ? 1.0 : -1.0;
    designs_of_end_ = 0;
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
    ++ends_done_;
    return good == whole ? bound : centre + direction * good;
  }

 private:
  bool is_worse(std::size_t variable, double x) {
    SearchPoint point = best_;
    point.x[Eigen::Index(variable)] = x;
    try {
      const TriedDesign moved = tried(point);
      return moved.violation > reference_.violation ||
             improvement(moved, reference_).verdict == Verdict::worse;
    } catch (const std::exception&) {
      return true;  // no design at all
    }
  }

  /// @throws ScanEnded
  TriedDesign tried(const SearchPoint& point) {
    ++designs_;
    // Where there are as many threads as screens, all are begun before the first is done.
    std::atomic<bool> is_ended = false;
    TriedDesign design = trial_.run(space_.design(point), {}, [&] {
      if (watch_ && !watch_()) is_ended = true;
      return !is_ended;
    });
    if (is_ended) throw ScanEnded();
    // How far an end is, is not known before; most are nearer than the bound.
    constexpr double usual_designs_of_end = 8.0;
    const double share = std::min(1.0, ++designs_of_end_ / usual_designs_of_end);
    if (report_) report_((ends_done_ + share) / ends_);
    return design;
  }

  const DesignSpace& space_;
  const DesignTrial& trial_;
  const SearchPoint& best_;
  const std::function<void(double)>& report_;
  const ScreenWatch& watch_;
  int ends_;
  int ends_done_ = 0;
  int designs_of_end_ = 0;
  int designs_ = 0;
  TriedDesign reference_;
};

}  // namespace

OptimumScan optimum_ranges(const DesignSpace& space, const DesignTrial& trial,
                           const SearchPoint& best, const std::function<void(double)>& report,
                           const ScreenWatch& watch) {
  const SubSpace sub_space = space.sub_spaces()[static_cast<std::size_t>(best.sub_space)];
  if (sub_space.continuous_count() == 0) return {};
  Scan scan(space, trial, best, report, watch);
  std::vector<OptimumRange> ranges;
  try {
    scan.try_best();
    for (std::size_t i = 0; i < sub_space.variables.size(); ++i) {
      const Variable& variable = sub_space.variables[i];
      if (!variable.is_continuous()) continue;
      const double lower = scan.end(i, variable.lower);
      const double upper = scan.end(i, variable.upper);
      ranges.push_back({.name = space.name(best.sub_space, i),
                        .best = space.value(best.sub_space, i, best.x[Eigen::Index(i)]),
                        .least = space.value(best.sub_space, i, lower),
                        .greatest = space.value(best.sub_space, i, upper),
                        .least_is_bound = lower == variable.lower,
                        .greatest_is_bound = upper == variable.upper});
    }
  } catch (const ScanEnded&) {
  }
  return {std::move(ranges), scan.designs()};
}

}  // namespace nlcwfs
