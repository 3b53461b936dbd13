// Every design of a grid is tried, and the best are verified.
#pragma once

#include "model/statistics.hpp"
#include "objectives/design_grid.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/design_trial.hpp"
#include "studies/run/request.hpp"
#include "studies/run/run_record.hpp"
#include "studies/search/verified_ranking.hpp"
#include "studies/settings/trials.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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
class Sweep {
 public:
  /// @param record  gets the evaluations
  Sweep(const SweepTask& task, RunRecord& record)
      : task_(task),
        record_(record),
        designs_(task.grid.distinct_designs()),
        outcomes_(designs_.size()) {}

  /// Tries every design; an interrupt ends it early.
  /// @throws std::runtime_error where too many in a row fail
  void run(const Request& request);

  /// That are to be tried.
  const std::vector<GridDesign>& designs() const { return designs_; }
  /// In the order of the designs; nothing where the sweep did not get there.
  const std::vector<std::optional<SweepOutcome>>& outcomes() const { return outcomes_; }
  /// How many are.
  std::size_t done() const { return done_; }
  /// What the designs took, in earlier runs too, s.
  double seconds() const { return seconds_; }
  /// Whether all are.
  bool is_complete() const { return done_ == designs_.size(); }

 private:
  const SweepTask& task_;
  RunRecord& record_;
  std::vector<GridDesign> designs_;
  std::vector<std::optional<SweepOutcome>> outcomes_;
  std::size_t done_ = 0;
  double seconds_ = 0.0;
};

/// The cheapest designs that keep the limits, or come closest, best first; `most` at most.
/// @throws std::runtime_error where all failed
std::vector<std::size_t> best_of(const Sweep& sweep, std::size_t most);

/// The outcome of each point; null where the grid has no design.
std::vector<const SweepOutcome*> outcomes_of_points(const SweepTask& task, const Sweep& sweep);

/// On fresh screens, without those that fail there.
/// @throws VerificationFailed where all do
std::vector<RankedDesign> ranking_of(const std::vector<std::size_t>& best, const Sweep& sweep,
                                     const SweepTask& task, RunRecord& record,
                                     const Progress* whole);

}  // namespace nlcwfs
