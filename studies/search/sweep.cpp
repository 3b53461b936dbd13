// Every design of a grid is tried, and the best are verified.
#include "studies/search/sweep.hpp"

#include "model/input_error.hpp"
#include "optimizer/all_at_once.hpp"
#include "optimizer/failure_count.hpp"
#include "results/tables/design_summary.hpp"
#include "studies/settings/sweep_grid.hpp"

#include <algorithm>
#include <cmath>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Designs that are tried together: enough for many cores, as each is parallel in itself, and few
/// enough that neighbours on the grid, which share planes, find each other's images.
constexpr std::size_t batch_size = 16;
/// The same for each thread of a runner: more, as all wait for the last of them.
constexpr std::size_t batch_size_of_thread = 64;

std::vector<DesignMetric> metrics_of(const Operation& operation) {
  std::vector<DesignMetric> metrics;
  for (const DesignMetric& metric : design_metrics()) {
    try {
      metric.validate(operation);
      metrics.push_back(metric);
    } catch (const InputError&) {
      // It needs what is not set.
    }
  }
  return metrics;
}

}  // namespace

SweepTask::SweepTask(const Configuration& configuration)
    : TrialSetup(configuration),
      grid(sweep_grid_of(configuration, telescope, simulated())),
      trial(make_trial(grid.space().varies("pupil_pixels"))),
      verification(make_verification(grid.space().varies("pupil_pixels"))),
      metrics(metrics_of(trial.cost().operation)),
      candidates(static_cast<std::size_t>(configuration.integer("verify.candidates"))) {
  require_verifiable(verification, {design}, fresh);
}

namespace {

/// A design that was tried: how it did, and the archive's row.
struct Tried {
  SweepOutcome outcome;
  ArchivedEvaluation evaluation;
  bool is_refused = false;  ///< it is none that can be simulated
};

/// Tries a design; one that cannot be tried has a failure. Nothing where an interrupt ended it.
std::optional<Tried> tried_design(const GridDesign& design, const SweepTask& task) {
  const Stopwatch stopwatch;
  Tried result;
  ArchivedEvaluation& evaluation = result.evaluation;
  evaluation = {
      .stage = "sweep",
      .design = to_json(design.design, task.telescope, task.seeing().fried_parameter).dump(),
      .cost = std::numeric_limits<double>::quiet_NaN(),
      .key = design.key};
  try {
    const TriedDesign tried =
        task.trial.run(design.design, {}, [] { return !InterruptWatch::interrupted(); });
    if (!is_whole(tried, task.trial)) return std::nullopt;
    result.outcome.cost = mean_and_standard_error(tried.costs);
    if (!std::isfinite(result.outcome.cost.mean)) {
      throw std::runtime_error(fmt::format("the cost is {}", result.outcome.cost.mean));
    }
    result.outcome.violation = tried.violation;
    evaluation.cost = result.outcome.cost.mean;
    Json performance = to_json(pooled(tried.performances));
    performance["cost"] = to_json(result.outcome.cost);
    performance["violation"] = tried.violation;
    for (const DesignMetric& metric : task.metrics) {
      result.outcome.metrics.push_back(task.trial.mean_of(tried, metric));
      performance["metrics"][std::string(metric.name)] = to_json(result.outcome.metrics.back());
    }
    evaluation.performance = performance.dump();
  } catch (const TrialMemoryFailed&) {
    throw;  // no design is to blame
  } catch (const std::exception& error) {
    result.is_refused = dynamic_cast<const InputError*>(&error) != nullptr;
    result.outcome = {.failure = error.what()};
    evaluation.failure = error.what();
  }
  evaluation.seconds = stopwatch.seconds();
  return result;
}

}  // namespace

void Sweep::run(const Request& request) {
  Progress progress("sweep", double(designs.size()), "designs", "then the verification",
                    request.whole);
  const Stopwatch stopwatch;
  FailureCount failures;
  const std::size_t together =
      request.runner ? batch_size_of_thread * static_cast<std::size_t>(request.runner->threads())
                     : batch_size;
  for (std::size_t first = 0; first < designs.size(); first += together) {
    const std::size_t count = std::min(together, designs.size() - first);
    std::vector<std::optional<Tried>> batch(count);
    std::size_t next = 0;
    std::mutex lock;
    // In the order of the designs, so that equal sweeps have equal archives.
    const auto take_next = [&] {
      const std::size_t i = next++;
      if (!batch[i]) return;
      record.add(batch[i]->evaluation);
      outcomes[first + i] = std::move(batch[i]->outcome);
      ++done;
      if (batch[i]->is_refused) return;
      failures.add(!outcomes[first + i]->failure.empty());
      if (failures.is_too_high()) {
        throw std::runtime_error(fmt::format(
            "{} of {} designs failed one after the other, the last with: {}; the archive has all "
            "of them: nlcwfs export {}",
            failures.in_a_row(), designs.size(), outcomes[first + i]->failure,
            record.folder().path().string()));
      }
    };
    all_at_once(count, [&](std::size_t i) {
      if (InterruptWatch::interrupted()) return;
      std::optional<Tried> tried = tried_design(designs[first + i], task);
      progress.advance();
      const std::scoped_lock guard(lock);
      batch[i] = std::move(tried);
      // Not only after the batch: where all fail, this begins no more of them.
      while (!failures.is_too_high() && next < count && batch[next]) take_next();
    });
    // Those behind one that an interrupt ended.
    while (next < count) take_next();
  }
  seconds = record.archive().seconds_before() + stopwatch.seconds();
}

std::vector<std::size_t> best_of(const Sweep& sweep, std::size_t most) {
  std::vector<std::size_t> designs;
  for (std::size_t i = 0; i < sweep.designs.size(); ++i) {
    if (sweep.outcomes[i]->failure.empty()) designs.push_back(i);
  }
  if (designs.empty()) {
    throw std::runtime_error(
        fmt::format("every design of the grid failed; the first: {}",
                    sweep.outcomes.empty() ? "" : sweep.outcomes.front()->failure));
  }
  const auto rank = [&](std::size_t design) {
    const SweepOutcome& outcome = *sweep.outcomes[design];
    return EvaluatedDesign{
        .point = {}, .key = {}, .cost = outcome.cost.mean, .violation = outcome.violation};
  };
  std::ranges::stable_sort(designs, is_better, rank);
  designs.resize(std::min(designs.size(), most));
  return designs;
}

std::vector<const SweepOutcome*> outcomes_of_points(const Sweep& sweep) {
  std::vector<const SweepOutcome*> points(sweep.task.grid.size(), nullptr);
  for (std::size_t i = 0; i < sweep.designs.size(); ++i) {
    for (const std::size_t point : sweep.designs[i].points) points[point] = &*sweep.outcomes[i];
  }
  return points;
}

std::vector<RankedDesign> ranking_of(const std::vector<std::size_t>& best, const Sweep& sweep,
                                     const Progress* whole) {
  const DesignTrial& verification = sweep.task.verification;
  std::vector<RankedDesign> verified;
  Progress progress = verification_progress(verification, best.size(), "", whole);
  for (std::size_t i = 0; i < best.size(); ++i) {
    const bool is_last = i + 1 == best.size();
    std::optional<TriedDesign> tried =
        verified_candidate(sweep.designs[best[i]].design, verification, sweep.record,
                           interruptible(progress), verified.empty() && is_last);
    const bool was_ended = tried && !is_whole(*tried, verification);
    if (was_ended || (InterruptWatch::interrupted() && !is_last)) {
      throw RunInterrupted(fmt::format("in the verification; {}", sweep.record.how_to_go_on()));
    }
    if (tried) verified.push_back({.candidate = i, .verified = std::move(*tried)});
  }
  return ranked(std::move(verified));
}

}  // namespace nlcwfs
