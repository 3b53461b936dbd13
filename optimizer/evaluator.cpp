// Costs are asked for: with budget, cache, races, and the best so far.
#include "optimizer/evaluator.hpp"

#include "optimizer/all_at_once.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Above this a cost, and with it the penalty, might overflow inside an optimizer.
constexpr double largest_cost = 1e100;
constexpr double penalty_without_costs = 1e6;
/// Steep enough that exceeding a limit by a hundredth costs as much as the design itself.
constexpr double violation_weight = 100.0;
/// Designs assessed together: enough for many cores, as each is parallel in itself, and few enough
/// to end soon where a stop is requested. Fixed, as it decides what designs race against.
constexpr std::size_t batch_size = 8;
/// In fractions of a variable's range.
constexpr double distinct_design_distance = 0.02;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

std::string_view to_string(Termination termination) {
  // In the order of the enumerators.
  constexpr std::array<std::string_view, 6> names{"converged",  "target_reached",
                                                  "stagnated",  "budget_exhausted",
                                                  "time_limit", "stop_requested"};
  return names.at(static_cast<std::size_t>(termination));
}

Evaluator::Evaluator(Problem& problem, EvaluatorOptions options)
    : problem_(problem), options_(std::move(options)), sub_spaces_(problem.sub_spaces()) {
  assert(!sub_spaces_.empty() && options_.budget >= 1);
#ifndef NDEBUG
  for (const SubSpace& sub_space : sub_spaces_) {
    assert(!sub_space.variables.empty());
    for (const Variable& variable : sub_space.variables) assert(variable.lower < variable.upper);
  }
#endif
}

double Evaluator::operator()(const SearchPoint& requested) { return evaluate({requested}).front(); }

std::vector<double> Evaluator::evaluate(const std::vector<SearchPoint>& requested) {
  std::vector<double> answers;
  for (std::size_t begin = 0; begin < requested.size(); begin += batch_size) {
    const std::size_t count = std::min(batch_size, requested.size() - begin);
    evaluate_batch(std::span(requested).subspan(begin, count), answers);
  }
  return answers;
}

void Evaluator::evaluate_batch(std::span<const SearchPoint> requested,
                               std::vector<double>& answers) {
  std::vector<Evaluation> fresh;
  std::vector<SearchPoint> points;
  std::vector<std::string> keys;
  std::set<std::string> asked;
  for (const SearchPoint& request : requested) {
    points.push_back(within_bounds(request));
    keys.push_back(problem_.key(points.back()));
    if (cache_.contains(keys.back()) || !asked.insert(keys.back()).second) continue;
    fresh.emplace_back().record = {.point = points.back(), .key = keys.back()};
  }

  const auto wanted = static_cast<int>(fresh.size());
  const int allowed = wanted > 0 ? allowed_evaluations(wanted) : 0;
  fresh.resize(static_cast<std::size_t>(allowed));
  const std::optional<Race> against_best = race();
  all_at_once(fresh.size(), [&](std::size_t i) { assess(fresh[i], against_best); });
  std::optional<Termination> ended;
  for (Evaluation& evaluation : fresh) {
    evaluation.ended ? void(ended = evaluation.ended) : commit(evaluation);
  }
  if (ended) throw SearchStopped(*ended);
  // The limit that the rest of the batch met says why.
  if (allowed < wanted) allowed_evaluations(wanted - allowed);

  cache_hits_ += static_cast<int>(points.size()) - allowed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Answer& answer = cache_.at(keys[i]);
    answers.push_back(answer.value);
    if (answer.failed) continue;
    // The design may be known from another slice.
    EvaluatedDesign here = answer.design;
    here.point = points[i];
    const auto [best_here, is_first] = best_of_slice_.emplace(slice_of(here.point), here);
    if (!is_first && is_better(here, best_here->second)) best_here->second = here;
  }
}

bool Evaluator::was_evaluated(const SearchPoint& point) const {
  return cache_.contains(problem_.key(within_bounds(point)));
}

std::optional<EvaluatedDesign> Evaluator::known(const SearchPoint& point) const {
  SearchPoint inside = within_bounds(point);
  const auto found = cache_.find(problem_.key(inside));
  if (found == cache_.end() || found->second.failed) return std::nullopt;
  EvaluatedDesign design = found->second.design;
  design.point = std::move(inside);
  return design;
}

std::vector<EvaluatedDesign> Evaluator::best_of_slices() const {
  std::vector<EvaluatedDesign> designs;
  for (const auto& [slice, design] : best_of_slice_) designs.push_back(design);
  std::ranges::stable_sort(designs, is_better);
  return designs;
}

std::optional<EvaluatedDesign> Evaluator::best_of_slice(const SearchPoint& point) const {
  const auto found = best_of_slice_.find(slice_of(point));
  if (found == best_of_slice_.end()) return std::nullopt;
  return found->second;
}

std::vector<EvaluatedDesign> Evaluator::best_designs(int count) const {
  std::vector<EvaluatedDesign> sorted = designs_;
  std::ranges::stable_sort(sorted, is_better);
  std::vector<EvaluatedDesign> chosen;
  for (const EvaluatedDesign& design : sorted) {
    if (static_cast<int>(chosen.size()) == count) break;
    const bool differs = std::ranges::none_of(chosen, [&](const EvaluatedDesign& better) {
      return slice_of(design.point) == slice_of(better.point) &&
             is_close(design.point, better.point);
    });
    if (differs) chosen.push_back(design);
  }
  return chosen;
}

int Evaluator::evaluations_left() const {
  const int budget_left = options_.budget - evaluations_;
  if (!options_.time_limit || evaluations_ == 0) return budget_left;
  const double seconds = seconds_since(start_);
  const double affordable = (*options_.time_limit - seconds) * evaluations_ / seconds;
  return affordable < budget_left ? std::max(0, static_cast<int>(affordable)) : budget_left;
}

SearchPoint Evaluator::within_bounds(const SearchPoint& requested) const {
  assert(requested.sub_space >= 0 && requested.sub_space < static_cast<int>(sub_spaces_.size()));
  assert(requested.x.allFinite());
  SearchPoint point = requested;
  Eigen::Index i = 0;
  for (const Variable& variable : variables_of(requested)) {
    double& value = point.x[i++];
    value = std::clamp(value, variable.lower, variable.upper);
    if (!variable.is_continuous()) value = std::round(value);
  }
  assert(i == point.x.size());
  return point;
}

void Evaluator::assess(Evaluation& evaluation, const std::optional<Race>& race) const {
  EvaluationRecord& record = evaluation.record;
  const auto start = std::chrono::steady_clock::now();
  try {
    GoesOn goes_on;
    if (race) {
      goes_on = [&](std::span<const double> costs) {
        record.given_up = !race->goes_on(costs);
        return !record.given_up;
      };
    }
    Assessment assessment = problem_.assess(record.point, goes_on);
    assert(!assessment.costs.empty() && assessment.violation >= 0.0);
    record.samples = assessment.costs.size();
    record.violation = assessment.violation;
    record.objectives = std::move(assessment.objectives);
    record.detail = std::move(assessment.detail);
    record.cost = record.given_up ? race->estimated_cost(assessment.costs) : mean(assessment.costs);
    evaluation.costs = std::move(assessment.costs);
    // Written so that NaN is caught too.
    if (!(std::abs(record.cost) <= largest_cost)) {
      record.failure = fmt::format("the cost is {}", record.cost);
    }
    for (const double objective : record.objectives) {
      if (!(std::abs(objective) <= largest_cost)) {
        record.failure = fmt::format("an objective is {}", objective);
      }
    }
  } catch (const SearchStopped& stopped) {
    evaluation.ended = stopped.termination;
  } catch (const SearchFailed&) {
    throw;  // no design is to blame
  } catch (const std::exception& error) {
    record.failure = fmt::format("exception: {}", error.what());
  } catch (...) {
    record.failure = "exception of an unknown type";
  }
  record.seconds = seconds_since(start);
}

void Evaluator::commit(Evaluation& evaluation) {
  EvaluationRecord& record = evaluation.record;
  record.index = ++evaluations_;
  Answer answer{
      {record.point, record.key, record.cost, record.violation, record.objectives}, 0.0, false};
  ++evaluations_without_improvement_;
  if (!record.failure.empty()) {
    record.cost = std::numeric_limits<double>::quiet_NaN();
    answer.failed = true;
    answer.value = penalty();
    last_failure_ = record.failure;
  } else {
    answer.value = record.cost;
    if (record.violation > 0.0) {
      answer.value += violation_weight * (1.0 + std::abs(record.cost)) * record.violation;
    }
    worst_cost_ = best_ ? std::max(worst_cost_, record.cost) : record.cost;
    if (!record.given_up) {
      designs_.push_back(answer.design);
      if (!best_ || is_better(answer.design, *best_)) {
        best_ = answer.design;
        best_costs_ = std::move(evaluation.costs);
        evaluations_without_improvement_ = 0;
      }
    }
  }
  failure_count_.add(answer.failed);
  cache_.emplace(record.key, answer);
  record.best_cost = best_ ? best_->cost : std::numeric_limits<double>::infinity();
  if (options_.observer) options_.observer(record);

  if (failure_count_.is_too_high()) {
    throw SearchFailed(
        fmt::format("the search failed: {} evaluations in a row failed, the last with {}",
                    failure_count_.in_a_row(), last_failure_));
  }
}

Evaluator::Slice Evaluator::slice_of(const SearchPoint& point) const {
  Slice slice{point.sub_space, {}};
  Eigen::Index i = 0;
  for (const Variable& variable : variables_of(point)) {
    if (!variable.is_continuous()) slice.second.push_back(point.x[i]);
    ++i;
  }
  return slice;
}

bool Evaluator::is_close(const SearchPoint& a, const SearchPoint& b) const {
  Eigen::Index i = 0;
  for (const Variable& variable : variables_of(a)) {
    const double distance = std::abs(a.x[i] - b.x[i]);
    if (distance > distinct_design_distance * (variable.upper - variable.lower)) return false;
    ++i;
  }
  return true;
}

int Evaluator::allowed_evaluations(int wanted) const {
  const bool is_stopped = options_.stop.stop_requested();
  const bool is_late = options_.time_limit && seconds_since(start_) >= *options_.time_limit;
  if (evaluations_ == 0 && (is_stopped || is_late)) return 1;
  if (is_stopped) throw SearchStopped(Termination::stop_requested);
  if (options_.target && best_ && best_->violation == 0.0 && best_->cost <= *options_.target) {
    throw SearchStopped(Termination::target_reached);
  }
  if (evaluations_ >= options_.budget) throw SearchStopped(Termination::budget_exhausted);
  if (is_late) throw SearchStopped(Termination::time_limit);
  if (options_.stagnation > 0 && evaluations_without_improvement_ >= options_.stagnation) {
    throw SearchStopped(Termination::stagnated);
  }
  return std::min(wanted, options_.budget - evaluations_);
}

std::optional<Race> Evaluator::race() const {
  if (options_.race_significance == 0.0 || !best_ || best_->violation > 0.0) return std::nullopt;
  return Race(best_costs_, options_.race_significance);
}

SearchOutcome Evaluator::outcome_of(const std::function<void()>& run) {
  SearchOutcome outcome;
  try {
    run();
    outcome.termination = Termination::converged;
  } catch (const SearchStopped& stopped) {
    outcome.termination = stopped.termination;
  }
  if (!best_ && failures() > 0) {
    throw SearchFailed(fmt::format("the search failed: all {} evaluations failed, the last with {}",
                                   evaluations_, last_failure_));
  }
  outcome.evaluations = evaluations_;
  outcome.failures = failures();
  outcome.cache_hits = cache_hits_;
  return outcome;
}

double Evaluator::penalty() const {
  if (!best_) return penalty_without_costs;
  const double scale = std::max(worst_cost_ - best_->cost, std::abs(worst_cost_));
  return worst_cost_ + 10.0 * (scale > 0.0 ? scale : 1.0);
}

}  // namespace nlcwfs
