// The path of a search and its sensitivity are drawn.
#pragma once

#include "objectives/optimum_range.hpp"
#include "results/pictures/picture_set.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

/// A design of a search, in the order in which they were tried.
struct SearchStep {
  int evaluation;    ///< counted from 1
  double cost;       ///< NaN where the design failed
  double best_cost;  ///< so far; infinite before there is one
  bool given_up;     ///< clearly worse, so the cost is of its first screens alone
};

/// The cost of each tried design, and the lowest so far.
PlannedPicture search_picture(const std::string& title, const std::vector<SearchStep>& steps);

/// How much more it costs to move each variable alone, with standard errors and the range that is
/// as good.
PlannedPicture sensitivity_picture(const std::string& title,
                                   const std::vector<OptimumRange>& ranges);

/// The same as CSV: a line for each value that was tried, the best with a difference of 0.
std::string sensitivity_table(const std::vector<OptimumRange>& ranges);

}  // namespace nlcwfs
