// Every design of a grid is tried, and the best are verified.
#pragma once

#include "objectives/design_grid.hpp"
#include "studies/search/verified_ranking.hpp"

namespace nlcwfs {

/// What the configuration asks for, checked as a whole before anything is written.
struct SweepTask : TrialSetup {
  /// @throws InputError where values do not go together
  explicit SweepTask(const Configuration& configuration);

  DesignGrid grid;                    ///< of the section sweep
  DesignTrial trial;                  ///< of the grid
  DesignTrial verification;           ///< on fresh screens
  std::vector<DesignMetric> metrics;  ///< every one that the configuration says enough for
  std::size_t candidates;             ///< that are verified
};

/// How a design of the grid did, as the archive has it too.
struct SweepOutcome {
  MeanAndError cost{};                     ///< see DesignTrial
  double violation = 0.0;                  ///< of objective.limits
  std::vector<MeanAndError> metrics = {};  ///< in the order of SweepTask::metrics
  std::string failure = {};                ///< why there is none of these
};

/// A sweep under way: what is known of its designs.
struct Sweep {
  /// Tries every design; an interrupt ends it early.
  /// @throws std::runtime_error where too many in a row fail
  void run(const Request& request);

  const SweepTask& task;                                           ///< whose grid it is
  RunRecord& record;                                               ///< gets the evaluations
  std::vector<GridDesign> designs = task.grid.distinct_designs();  ///< that are to be tried
  /// In the order of the designs; nothing where the sweep did not get there.
  std::vector<std::optional<SweepOutcome>> outcomes =
      std::vector<std::optional<SweepOutcome>>(designs.size());
  std::size_t done = 0;  ///< how many are
  double seconds = 0.0;  ///< what the designs took, in earlier runs too
};

/// The cheapest designs that keep the limits, or come closest, best first; `most` at most.
/// @throws std::runtime_error where all failed
std::vector<std::size_t> best_of(const Sweep& sweep, std::size_t most);

/// The outcome of each point; null where the grid has no design.
std::vector<const SweepOutcome*> outcomes_of_points(const Sweep& sweep);

/// On fresh screens, without those that fail there.
/// @throws VerificationFailed where all do
std::vector<RankedDesign> ranking_of(const std::vector<std::size_t>& best, const Sweep& sweep,
                                     const Progress* whole);

}  // namespace nlcwfs
