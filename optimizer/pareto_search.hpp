// Several objectives are minimised at once.
#pragma once

#include "optimizer/evaluator.hpp"
#include "optimizer/pareto_algorithms.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nlcwfs {

/// What to search with, and from where.
struct ParetoOptions {
  std::string algorithm = "nsga2";       ///< one of pareto_algorithms()
  int population = 16;                   ///< of each sub-space; a multiple of 4, at least 8
  std::uint64_t seed = 1;                ///< of the algorithm's random numbers
  std::vector<SearchPoint> starts = {};  ///< in the first populations, as many as fit
  /// Budget, time limit, stop, observer. What concerns one cost plays no part: target, stagnation
  /// and races.
  EvaluatorOptions evaluation = {};
};

/// What a search for several objectives found.
struct ParetoResult : SearchOutcome {
  /// The designs that keep the limits and that no other design evaluated dominates: none is as good
  /// in all objectives and better in one. In ascending order of their objectives, the first one
  /// first. One design for equal objectives.
  std::vector<EvaluatedDesign> front;
};

/// Minimises all objectives of a problem (Assessment::objectives, two or more) at once. Each
/// sub-space has its own population, which begins with a Latin hypercube and the starts in it; the
/// populations take turns, a generation each, so their shares of the budget are equal, until a
/// limit is reached or no population brings forth new designs (Termination::converged). Their
/// fronts are merged.
///
/// A design that does not keep its limits counts as worse than any that does, and of two such
/// designs the one farther from them (Deb 2000); a failure as worse than all.
///
/// Runs in the calling thread; equal arguments evaluate the same designs in the same order,
/// whatever the number of threads.
///
/// @throws std::invalid_argument for an unknown algorithm, listing those that there are, and for a
///   population that does not suit it, before any evaluation
/// @throws SearchFailed where no design has a cost, or too many in a row have none
/// @throws whatever the observer throws
ParetoResult pareto_search(Problem& problem, const ParetoOptions& options);

/// Whether each of some designs is dominated by another: one that is as good in all objectives and
/// better in one, or equal and before it.
/// @param objectives  of each design, all to be minimised
std::vector<bool> dominated(const std::vector<std::vector<double>>& objectives);

/// Chooses among designs that stand in groups, so that the groups have as equal shares as their
/// sizes allow and the chosen of a group are spread evenly from its first to its last.
/// @param groups  the group of each design
/// @return        the indices of min(most, groups.size()) designs, ascending
std::vector<std::size_t> evenly_chosen(const std::vector<std::string>& groups, std::size_t most);

/// The volume that is dominated by designs and dominates a reference point (Zitzler & Thiele 1998),
/// in the product of the objectives' units. Designs that do not dominate the point add nothing.
/// @param reference  as many objectives as the designs have
double hypervolume(const std::vector<EvaluatedDesign>& front, const std::vector<double>& reference);

/// The index of a front's knee: where the sum of the objectives, each as a fraction of its range
/// over the front, is lowest. For two objectives that is the design farthest below the chord
/// between the two extreme ones (Das 1999), for more the one farthest below the plane through the
/// ends of the normalised axes; it is the best of the front for equal weights (Branke, Deb, Dierolf
/// & Osswald 2004). The first of several. On a front that bends away from the best point it is an
/// extreme design.
/// @param front  at least one design
std::size_t knee(const std::vector<EvaluatedDesign>& front);

}  // namespace nlcwfs
