// NLopt's algorithms, global and local.
#pragma once

#include "optimizer/evaluator.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What an algorithm searches: the whole box, or the surroundings of its start.
enum class SearchScope { global, local };

/// The names of the algorithms of NLopt that there are, global ones first.
std::vector<std::string_view> nlopt_algorithms();

/// The scope of an algorithm of NLopt.
///
/// Global: `direct_l` (DIRECT-L, Gablonsky & Kelley 2001), `direct_l_rand` (the same, with the side
/// to divide drawn at random where several are longest), `crs2` (controlled random search with
/// local mutation, Kaelo & Ali 2006), `mlsl` (multi-level single-linkage: local searches, here by
/// sbplx, from the most promising of scattered points, Rinnooy Kan & Timmer 1987; the points from a
/// Sobol sequence, Kucherenko & Sytsko 2005), `isres` (evolution strategy with stochastic ranking,
/// Runarsson & Yao 2005), `esch` (evolution strategy with Cauchy mutations, da Silva Santos,
/// Goncalves & Hernandez-Figueroa 2010).
///
/// Local: `sbplx` (subplex, Rowan 1990), `nelder_mead` (Nelder & Mead 1965, with bounds), `bobyqa`
/// (quadratic models, Powell 2009), `cobyla` (linear models, Powell 1994), `praxis` (principal
/// axes, Brent 1973; points outside the bounds are moved onto them).
/// @param variable_count  the number of continuous variables that it is meant for
/// @throws std::invalid_argument for an unknown name, listing those that there are, and for an
///   algorithm that cannot search that few variables, naming one that can
SearchScope nlopt_scope(std::string_view algorithm, int variable_count);

/// How far one run of an algorithm goes.
struct StageOptions {
  int max_evaluations = 100;  ///< new evaluations of this run at most, at least 1
  double x_tolerance = 1e-3;  ///< converged below this, fraction of each variable's range
  /// Of local algorithms, fraction of each variable's range, at most 0.5.
  double initial_step = 0.1;
  std::uint64_t seed = 1;  ///< of algorithms that draw random numbers; NLopt uses its low 32 bits
};

/// What became of one run. The best design is the evaluator's to tell.
struct StageResult {
  int evaluations = 0;  ///< new ones
  /// It ended before its limit: by its tolerance, by rounding, or because it went round in designs
  /// that are known. mlsl, isres and esch have no tolerance to end by.
  bool finished = false;
};

/// Minimises the cost over the continuous variables of a slice (see Evaluator::best_of_slices) with
/// an algorithm of NLopt (see nlopt_scope for the names). The run with the same arguments and a
/// higher limit takes the same path, through the evaluator's cache at no cost, so this is also how
/// a run is resumed.
/// @param start  gives the slice; where local algorithms start, and one of the first points of
///               crs2, mlsl, isres and esch
/// @throws std::invalid_argument see nlopt_scope
/// @throws whatever the evaluator throws: SearchStopped, SearchFailed, exceptions of the observer
StageResult minimize(std::string_view algorithm, Evaluator& evaluator, const SearchPoint& start,
                     const StageOptions& options);

}  // namespace nlcwfs
