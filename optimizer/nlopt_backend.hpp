#pragma once

#include "optimizer/evaluator.hpp"

#include <cstdint>
#include <string_view>

#include <Eigen/Core>

namespace nlcwfs {

/// What an algorithm searches: the whole box, or the surroundings of its start.
enum class SearchScope { global, local };

/// The scope of an algorithm of NLopt: global `direct_l` (DIRECT-L, Gablonsky & Kelley 2001),
/// `crs2` (controlled random search with local mutation, Kaelo & Ali 2006); local `sbplx`
/// (subplex, Rowan 1990), `nelder_mead` (Nelder & Mead 1965, with bounds), `bobyqa` (quadratic
/// models, Powell 2009), `cobyla` (linear models, Powell 1994).
/// @param variable_count  the number of variables that it is meant for
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
  /// It ended by itself (tolerance, rounding): a higher limit changes nothing.
  bool finished = false;
};

/// Minimises the cost of one choice with an algorithm of NLopt (see nlopt_scope for the names). The
/// run with the same arguments and a higher limit takes the same path, through the evaluator's
/// cache at no cost, so this is also how a run is resumed.
/// @param start  where local algorithms start, and one of the first points of crs2
/// @throws std::invalid_argument see nlopt_scope
/// @throws whatever the evaluator throws: SearchStopped, SearchFailed, exceptions of the observer
StageResult minimize(std::string_view algorithm, Evaluator& evaluator, int choice,
                     const Eigen::VectorXd& start, const StageOptions& options);

}  // namespace nlcwfs
