// A search method is chosen by name, and run: global, then local.
#pragma once

#include "optimizer/evaluator.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// The two algorithms of a chained search; either may be absent.
struct SearchMethod {
  std::string global;  ///< finds the region; empty = start from the starting points
  std::string local;   ///< refines; empty = the global algorithm goes on instead
};

/// The method that a name stands for: `GLOBAL+LOCAL` such as `direct_l+sbplx`, one algorithm alone
/// (see nlopt_scope, and `dlib`, which is global and needs no continuous variable: see
/// minimize_with_dlib), or `auto`. That is, in one sub-space without integer variables and
/// of at most 32 slices, direct_l+sbplx up to 2 continuous variables and direct_l+nelder_mead
/// above; elsewhere dlib+nelder_mead, or dlib
/// where a sub-space has no continuous variable.
/// @throws std::invalid_argument for an unknown name, for an algorithm in the wrong place, and for
///   an algorithm that cannot search that space, naming one that can
SearchMethod search_method(std::string_view optimizer, const std::vector<SubSpace>& sub_spaces);

/// What to search with, and from where.
struct SearchOptions {
  std::string optimizer = "auto";  ///< see search_method
  std::uint64_t seed = 1;          ///< of algorithms that draw random numbers
  std::vector<SearchPoint> starts =
      {};                            ///< to begin with; none = the centre of the first sub-space
  EvaluatorOptions evaluation = {};  ///< budget, time limit, stopping, observer
};

/// A part of a search.
struct SearchStage {
  std::string name;     ///< `starts`, `choices` (the slices beside the best one), or the algorithm
  int evaluations = 0;  ///< new ones
};

/// What a search found.
struct SearchResult : SearchOutcome {
  /// The best design; nothing where the search was stopped before its first evaluation.
  std::optional<EvaluatedDesign> best;
  /// The best designs that differ (see Evaluator::best_designs), at most 5, best first.
  std::vector<EvaluatedDesign> best_designs;
  std::vector<SearchStage> stages;  ///< in order; their evaluations sum to `evaluations`
};

/// Searches a problem's sub-spaces within a budget:
/// 1. the starting points;
/// 2. a global search over the continuous variables in the best point's slice (a sub-space with
///    given values of the discrete variables), or with dlib over all variables of all sub-spaces;
/// 3. the slices beside the best point so far: one discrete variable changed at a time, and the
///    other sub-spaces with what they share with this one;
/// 4. a local search in each of the best few slices, ever longer in ever fewer of them (successive
///    halving, Jamieson & Talwalkar 2016);
/// then 2 to 4 again from the best design, with other random numbers (and direct_l_rand for
/// direct_l), until such a round improves nothing or a limit is reached. `dlib` alone takes all
/// evaluations after the starting points.
///
/// Runs in the calling thread; equal arguments evaluate the same designs in the same order, unless
/// a time limit comes into sight of the search (stages shrink to fit into it).
///
/// @throws std::invalid_argument see search_method
/// @throws SearchFailed where no design has a cost, or too many in a row have none
/// @throws whatever the observer throws
SearchResult search(Problem& problem, const SearchOptions& options);

}  // namespace nlcwfs
