#pragma once

#include "optimizer/problem.hpp"

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace nlcwfs {

/// Why a search ended.
enum class Termination {
  converged,         ///< nothing that the method knows to try improved the best design any more
  budget_exhausted,  ///< all evaluations were used
  time_limit,        ///< the time limit was over
  stop_requested     ///< the caller asked to stop
};

/// The name of a termination: "converged", "budget_exhausted", "time_limit", "stop_requested".
std::string_view to_string(Termination termination);

/// One evaluation of the cost, in the order in which they happened.
struct EvaluationRecord {
  int index = 0;  ///< counts from 1
  SearchPoint point;
  std::string key;
  double cost = 0.0;       ///< NaN where the evaluation failed
  double best_cost = 0.0;  ///< lowest cost so far, this one included; infinity before there is one
  std::string failure;     ///< why the evaluation failed; empty where it did not
  double seconds = 0.0;    ///< how long the cost took, s
};

/// The limits of a search, and who watches it.
struct EvaluatorOptions {
  int budget = 150;  ///< evaluations at most, at least 1; answers from the cache are free
  /// No evaluation starts later than this after the evaluator was made, s; the first always does.
  std::optional<double> time_limit = {};
  std::stop_token stop = {};  ///< no evaluation starts once a stop is requested
  /// Called after each new evaluation, in the thread of the search and before the problem is asked
  /// for another cost. Its exceptions end the search and reach the caller.
  std::function<void(const EvaluationRecord&)> observer = {};
};

/// Thrown by the evaluator to unwind an optimizer when a limit is reached; searches turn it into
/// their result's termination.
struct SearchStopped : std::exception {
  explicit SearchStopped(Termination why) : termination(why) {}
  const char* what() const noexcept override { return "the search was stopped"; }
  Termination termination;
};

/// A search that cannot go on: evaluations fail one after the other. Names the last reason.
class SearchFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The single owner of a search's budget, cache, best design, failures and stopping: every
/// optimizer calls the cost through it, and what an optimizer itself believes about any of these is
/// ignored.
class Evaluator {
 public:
  /// After this many failures with no success in between, where they are at least half of all
  /// evaluations, the search is given up as failed. (A local search beside a region of failures may
  /// meet as many late in a search that is going well.)
  static constexpr int failures_in_a_row_allowed = 20;

  /// @param problem  used by reference
  Evaluator(Problem& problem, EvaluatorOptions options);

  /// The finite cost of a design for an optimizer to work with. A point outside the bounds (by an
  /// optimizer's rounding, or by one without bounds) is moved onto them first.
  ///
  /// A design without a cost (an exception of any kind, NaN, an infinity or an absolute value above
  /// 1e100) is a failure and answered with a penalty: worst + 10 max(worst - best, |worst|) of the
  /// costs known at that time, or 1e6 before there is any. That is worse than the costs to be
  /// expected, of their order of magnitude so that optimizers that fit models survive it, and the
  /// same whenever the design is asked for again.
  ///
  /// @throws SearchStopped where a new evaluation is needed and none may start
  /// @throws SearchFailed after too many failures in a row
  double operator()(const SearchPoint& requested);

  const std::vector<Variable>& variables() const { return variables_; }
  int choice_count() const { return static_cast<int>(best_of_choice_.size()); }

  int evaluations() const { return evaluations_; }
  int failures() const { return failures_; }
  int cache_hits() const { return cache_hits_; }
  const std::string& last_failure() const { return last_failure_; }  ///< empty without any

  /// How many more evaluations there will be: what is left of the budget, or fewer where the time
  /// limit, at the mean time per evaluation so far, comes first.
  int evaluations_left() const;

  /// The design of the lowest cost so far; nothing before an evaluation succeeds.
  const std::optional<EvaluatedDesign>& best() const { return best_; }

  /// The same among the points of one choice, whether evaluated there or known from the cache.
  const std::optional<EvaluatedDesign>& best_of(int choice) const {
    return best_of_choice_[static_cast<std::size_t>(choice)];
  }

  /// The best designs that differ, best first: of the points of one choice that are within 2 % of
  /// each variable's range of a better one, only the better one counts.
  std::vector<EvaluatedDesign> best_designs(int count) const;

 private:
  struct Answer {
    double value;
    bool failed;
  };

  double seconds_since_start() const;
  void stop_at_limits() const;
  double penalty() const;
  void keep_if_best(const EvaluatedDesign& design);

  Problem& problem_;
  EvaluatorOptions options_;
  std::vector<Variable> variables_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::unordered_map<std::string, Answer> cache_;
  std::vector<EvaluatedDesign> designs_;  ///< all successes, in order
  std::optional<EvaluatedDesign> best_;
  std::vector<std::optional<EvaluatedDesign>> best_of_choice_;
  double worst_cost_ = 0.0;  ///< of the successes; meaningless before there is one
  int evaluations_ = 0;
  int failures_ = 0;
  int failures_in_a_row_ = 0;
  int cache_hits_ = 0;
  std::string last_failure_;
};

}  // namespace nlcwfs
