#include "optimizer/evaluator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Above this a cost, and with it the penalty, might overflow inside an optimizer.
constexpr double largest_cost = 1e100;
constexpr double penalty_without_costs = 1e6;
/// In fractions of a variable's range.
constexpr double distinct_design_distance = 0.02;

double seconds_between(std::chrono::steady_clock::time_point start,
                       std::chrono::steady_clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

}  // namespace

std::string_view to_string(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "converged";
    case Termination::budget_exhausted:
      return "budget_exhausted";
    case Termination::time_limit:
      return "time_limit";
    case Termination::stop_requested:
      return "stop_requested";
  }
  return "";
}

Evaluator::Evaluator(Problem& problem, EvaluatorOptions options)
    : problem_(problem),
      options_(std::move(options)),
      variables_(problem.variables()),
      lower_(variables_.size()),
      upper_(variables_.size()),
      best_of_choice_(static_cast<std::size_t>(problem.choice_count())) {
  assert(!variables_.empty() && !best_of_choice_.empty() && options_.budget >= 1);
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    assert(variables_[i].lower < variables_[i].upper);
    lower_[i] = variables_[i].lower;
    upper_[i] = variables_[i].upper;
  }
}

double Evaluator::operator()(const SearchPoint& requested) {
  assert(requested.choice >= 0 && requested.choice < choice_count());
  assert(requested.x.size() == lower_.size() && requested.x.allFinite());
  EvaluationRecord record;
  record.point = {requested.choice, requested.x.cwiseMax(lower_).cwiseMin(upper_)};
  record.key = problem_.key(record.point);

  if (const auto known = cache_.find(record.key); known != cache_.end()) {
    ++cache_hits_;
    const Answer answer = known->second;
    if (!answer.failed) keep_if_best({record.point, record.key, answer.value});
    return answer.value;
  }

  stop_at_limits();
  const auto start = std::chrono::steady_clock::now();
  try {
    record.cost = problem_.cost(record.point);
    // Written so that NaN is caught too.
    if (!(std::abs(record.cost) <= largest_cost)) {
      record.failure = fmt::format("the cost is {}", record.cost);
    }
  } catch (const std::exception& error) {
    record.failure = fmt::format("exception: {}", error.what());
  } catch (...) {
    record.failure = "exception of an unknown type";
  }
  record.seconds = seconds_between(start, std::chrono::steady_clock::now());
  record.index = ++evaluations_;

  Answer answer{record.cost, !record.failure.empty()};
  if (answer.failed) {
    record.cost = std::numeric_limits<double>::quiet_NaN();
    answer.value = penalty();
    last_failure_ = record.failure;
    ++failures_;
    ++failures_in_a_row_;
  } else {
    worst_cost_ = best_ ? std::max(worst_cost_, record.cost) : record.cost;
    designs_.push_back({record.point, record.key, record.cost});
    keep_if_best(designs_.back());
    failures_in_a_row_ = 0;
  }
  cache_.emplace(record.key, answer);
  record.best_cost = best_ ? best_->cost : std::numeric_limits<double>::infinity();
  if (options_.observer) options_.observer(record);

  if (failures_in_a_row_ >= failures_in_a_row_allowed && 2 * failures_in_a_row_ >= evaluations_) {
    throw SearchFailed(
        fmt::format("the search failed: {} evaluations in a row failed, the last with {}",
                    failures_in_a_row_, last_failure_));
  }
  return answer.value;
}

int Evaluator::evaluations_left() const {
  const int budget_left = options_.budget - evaluations_;
  if (!options_.time_limit || evaluations_ == 0) return budget_left;
  const double seconds = seconds_since_start();
  const double affordable = (*options_.time_limit - seconds) * evaluations_ / seconds;
  return affordable < budget_left ? std::max(0, static_cast<int>(affordable)) : budget_left;
}

std::vector<EvaluatedDesign> Evaluator::best_designs(int count) const {
  std::vector<EvaluatedDesign> sorted = designs_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
  std::vector<EvaluatedDesign> chosen;
  for (const EvaluatedDesign& design : sorted) {
    if (static_cast<int>(chosen.size()) == count) break;
    const bool differs = std::none_of(chosen.begin(), chosen.end(), [&](const auto& better) {
      const Eigen::ArrayXd distance = (design.point.x - better.point.x).array().abs();
      return design.point.choice == better.point.choice &&
             (distance <= distinct_design_distance * (upper_ - lower_).array()).all();
    });
    if (differs) chosen.push_back(design);
  }
  return chosen;
}

double Evaluator::seconds_since_start() const {
  return seconds_between(start_, std::chrono::steady_clock::now());
}

void Evaluator::stop_at_limits() const {
  if (options_.stop.stop_requested()) throw SearchStopped(Termination::stop_requested);
  if (evaluations_ >= options_.budget) throw SearchStopped(Termination::budget_exhausted);
  if (options_.time_limit && evaluations_ > 0 && seconds_since_start() >= *options_.time_limit) {
    throw SearchStopped(Termination::time_limit);
  }
}

double Evaluator::penalty() const {
  if (!best_) return penalty_without_costs;
  const double scale = std::max(worst_cost_ - best_->cost, std::abs(worst_cost_));
  return worst_cost_ + 10.0 * (scale > 0.0 ? scale : 1.0);
}

void Evaluator::keep_if_best(const EvaluatedDesign& design) {
  auto& best_here = best_of_choice_[static_cast<std::size_t>(design.point.choice)];
  if (!best_here || design.cost < best_here->cost) best_here = design;
  if (!best_ || design.cost < best_->cost) best_ = design;
}

}  // namespace nlcwfs
