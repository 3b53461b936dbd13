// How far each variable of the best design may move.
#pragma once

#include "objectives/design_space.hpp"
#include "objectives/design_trial.hpp"

#include <functional>
#include <string>
#include <vector>

namespace nlcwfs {

/// A value of one variable that was tried, the others held.
struct ScannedValue {
  double value;                  ///< SI
  MeanAndError cost_difference;  ///< how much more than the best it costs, paired by screen; NaN
                                 ///< where there is no such design
  bool is_worse;                 ///< by Student's t test at 5 %, or of the limits
};

/// How far one variable of a design may move before the design is worse.
struct OptimumRange {
  std::string name;                  ///< of the property, without "log"
  double best;                       ///< its value in the design, SI
  double least;                      ///< the lowest value tried that cannot be told from the best
  double greatest;                   ///< the highest
  bool least_is_bound;               ///< the whole way to the end of the search's range is as good
  bool greatest_is_bound;            ///< likewise at the other end
  std::vector<ScannedValue> values;  ///< all that were tried, the best among them, ascending
};

/// What a scan found, and what it took.
struct OptimumScan {
  std::vector<OptimumRange> ranges;  ///< one for each variable that is done
  int designs = 0;                   ///< that were tried, one that the watch ended included
};

/// Scans each continuous variable of a design on both sides, the others held, until the costs on
/// the trial's screens are worse by Student's t test at 5 %, paired by screen. The scan steps out
/// by doubled steps from a hundredth of the variable's range, and then halves the last step twice,
/// so the ends are exact to a quarter of the distance from the best.
/// @param report  told after each design which share of the scan is done, from 0 to 1
/// @param watch   where it ends a trial, it ends the scan, with the variables that are done
OptimumScan optimum_ranges(const DesignSpace& space, const DesignTrial& trial,
                           const SearchPoint& best, const std::function<void(double)>& report = {},
                           const ScreenWatch& watch = {});

}  // namespace nlcwfs
