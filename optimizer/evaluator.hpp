// Costs are asked for: with budget, cache, races, and the best so far.
#pragma once

#include "optimizer/failure_count.hpp"
#include "optimizer/problem.hpp"
#include "optimizer/race.hpp"

#include <any>
#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nlcwfs {

/// Why a search ended.
enum class Termination {
  converged,         ///< nothing that the method knows to try improved the best design any more
  target_reached,    ///< a design costs as little as was asked for
  stagnated,         ///< too many evaluations in a row improved nothing
  budget_exhausted,  ///< all evaluations were used
  time_limit,        ///< the time limit was over
  stop_requested     ///< the caller asked to stop
};

/// The name of a termination, as it is spelt here: "converged", "target_reached", ...
std::string_view to_string(Termination termination);

/// One evaluation of the cost, in the order in which they happened.
struct EvaluationRecord {
  int index = 0;             ///< counts from 1
  SearchPoint point;         ///< that was evaluated
  std::string key;           ///< Problem::key of the point
  double cost = 0.0;         ///< NaN where the evaluation failed
  double violation = 0.0;    ///< of the limits
  double best_cost = 0.0;    ///< of the best design so far, this one included; infinity before one
  std::size_t samples = 0;   ///< that the cost is of
  bool given_up = false;     ///< clearly worse than the best: the cost is an estimate
  std::string failure = {};  ///< why the evaluation failed; empty where it did not
  double seconds = 0.0;      ///< how long it took, s
  std::vector<double> objectives = {};  ///< Assessment::objectives
  std::any detail = {};                 ///< Assessment::detail
};

/// The limits of a search, and who watches it.
struct EvaluatorOptions {
  int budget = 150;  ///< evaluations at most, at least 1; answers from the cache are free
  /// No evaluation starts later than this after the evaluator was made, s; the first always does.
  std::optional<double> time_limit = {};
  /// No evaluation starts once a stop is requested; the first one always does, so that there is a
  /// result.
  std::stop_token stop = {};
  /// No evaluation starts once the best design keeps the limits and costs no more than this.
  std::optional<double> target = {};
  /// No evaluation starts after so many in a row that improved nothing; 0 = whatever they did.
  int stagnation = 0;
  /// The chance that a race (see Race) gives up a design that is as good as the best, at most;
  /// 0 = no races: every design is assessed on all samples.
  double race_significance = 0.0;
  /// Called after each new evaluation, in the thread of the search and before the problem is asked
  /// for another cost (or batch of them). Its exceptions end the search and reach the caller.
  std::function<void(const EvaluationRecord&)> observer = {};
};

/// Thrown by the evaluator to unwind an optimizer when a limit is reached, or by a problem that is
/// to give up a design half way; searches turn it into their result's termination.
struct SearchStopped : std::exception {
  /// For the reason that a search ended with.
  explicit SearchStopped(Termination why) : termination(why) {}
  /// Says that the search was stopped.
  const char* what() const noexcept override { return "the search was stopped"; }
  Termination termination;  ///< why the search ended
};

/// A search that cannot go on: evaluations fail one after the other, or the problem throws it.
/// Names the last reason.
struct SearchFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How a search ended.
struct SearchOutcome {
  Termination termination = Termination::stop_requested;  ///< why
  int evaluations = 0;                                    ///< designs that were tried
  int failures = 0;                                       ///< evaluations without a cost
  int cache_hits = 0;  ///< designs asked for again, which cost nothing
};

/// The single owner of a search's budget, cache, best design, failures and stopping: every
/// optimizer calls the cost through it, and what an optimizer itself believes about any of these is
/// ignored.
class Evaluator {
 public:
  /// @param problem  used by reference
  Evaluator(Problem& problem, EvaluatorOptions options);

  /// The finite cost of a design for an optimizer to work with. A point outside the bounds (by an
  /// optimizer's rounding, or by one without bounds) is moved onto them first.
  ///
  /// A design without a cost (an exception of any kind, NaN, an infinity or an absolute value above
  /// 1e100, of the cost or of an objective) is a failure and answered with a penalty: worst + 10
  /// max(worst - best, |worst|) of the costs known at that time, or 1e6 before there is any. That
  /// is worse than the costs to be expected, of their order of magnitude so that optimizers that
  /// fit models survive it, and the same whenever the design is asked for again.
  ///
  /// A design that does not keep its limits is answered with its cost and 100 (1 + |cost|) times
  /// its violation on top.
  ///
  /// @throws SearchStopped where a new evaluation is needed and none may start
  /// @throws SearchFailed after too many failures in a row
  double operator()(const SearchPoint& requested);

  /// The same of several points, whose new designs are assessed in parallel, some at a time. The
  /// answers do not depend on the number of threads.
  /// @throws as above; where not all new designs may be evaluated, the first ones are
  std::vector<double> evaluate(const std::vector<SearchPoint>& requested);

  /// Those of the problem.
  const std::vector<SubSpace>& sub_spaces() const { return sub_spaces_; }
  /// Those of the point's sub-space.
  const std::vector<Variable>& variables_of(const SearchPoint& point) const {
    return sub_spaces_[static_cast<std::size_t>(point.sub_space)].variables;
  }

  /// Runs a search that asks this evaluator until it converges or is stopped.
  /// @throws SearchFailed where no design has a cost, and whatever the search throws
  SearchOutcome outcome_of(const std::function<void()>& run);

  /// Designs that were tried, failures included.
  int evaluations() const { return evaluations_; }
  /// Designs that could not be tried.
  int failures() const { return failure_count_.failures(); }
  /// Points whose design had been tried already.
  int cache_hits() const { return cache_hits_; }

  /// How many more evaluations there will be: what is left of the budget, or fewer where the time
  /// limit, at the mean time per evaluation so far, comes first.
  int evaluations_left() const;

  /// Whether asking for a point costs no evaluation.
  bool was_evaluated(const SearchPoint& point) const;

  /// The design at a point; nothing where it was not evaluated or has no cost.
  std::optional<EvaluatedDesign> known(const SearchPoint& point) const;

  /// The best design so far (see is_better); nothing before an evaluation succeeds.
  const std::optional<EvaluatedDesign>& best() const { return best_; }

  /// The best design of each slice that was tried, best first, whether evaluated there or known
  /// from the cache. A slice is a sub-space with given values of the discrete variables.
  std::vector<EvaluatedDesign> best_of_slices() const;

  /// The same of the slice that a point lies in.
  std::optional<EvaluatedDesign> best_of_slice(const SearchPoint& point) const;

  /// The best designs that differ, best first: of the points of one slice that are within 2 % of
  /// each variable's range of a better one, only the better one counts. Designs that a race gave
  /// up are not among them.
  std::vector<EvaluatedDesign> best_designs(int count) const;

 private:
  struct Answer {
    EvaluatedDesign design;
    double value = 0.0;  ///< what optimizers are told
    bool failed = false;
  };

  struct Evaluation {
    EvaluationRecord record;
    std::vector<double> costs;              ///< of the samples
    std::optional<Termination> ended = {};  ///< by the problem; then there is nothing else
  };
  /// A sub-space and the values of its discrete variables.
  using Slice = std::pair<int, std::vector<double>>;

  SearchPoint within_bounds(const SearchPoint& requested) const;
  void evaluate_batch(std::span<const SearchPoint> requested, std::vector<double>& answers);
  void assess(Evaluation& evaluation, const std::optional<Race>& race) const;
  void commit(Evaluation& evaluation);
  Slice slice_of(const SearchPoint& point) const;
  bool is_close(const SearchPoint& a, const SearchPoint& b) const;
  /// @throws SearchStopped where none is allowed
  int allowed_evaluations(int wanted) const;
  std::optional<Race> race() const;
  double penalty() const;

  Problem& problem_;
  EvaluatorOptions options_;
  std::vector<SubSpace> sub_spaces_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::unordered_map<std::string, Answer> cache_;
  std::vector<EvaluatedDesign> designs_;  ///< all successes on all samples, in order
  std::optional<EvaluatedDesign> best_;
  std::vector<double> best_costs_;  ///< of the best design's samples
  std::map<Slice, EvaluatedDesign> best_of_slice_;
  double worst_cost_ = 0.0;  ///< of the successes; meaningless before there is one
  int evaluations_ = 0;
  FailureCount failure_count_;
  int evaluations_without_improvement_ = 0;
  int cache_hits_ = 0;
  std::string last_failure_;
};

}  // namespace nlcwfs
