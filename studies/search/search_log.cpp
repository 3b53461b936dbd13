// A search is watched: archive, table and progress.
#include "studies/search/search_log.hpp"

#include "results/tables/design_summary.hpp"
#include "results/text/axis_text.hpp"
#include "results/text/quantity_text.hpp"

#include <any>

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// Of every search, whatever it varies: what differs from the configuration is easily seen.
std::vector<std::string> columns(const std::vector<DesignMetric>& objectives) {
  std::vector<std::string> names{"evaluation", "planes_m"};
  for (const DesignField& property : design_properties()) {
    names.push_back(column_of_variable(property.variable));
  }
  for (const char* name : {"cost", "violation", "screens", "given_up", "residual_wfe_nm",
                           "total_wfe_nm", "fractional_loops", "failure"}) {
    names.emplace_back(name);
  }
  for (const DesignMetric& objective : objectives) {
    names.push_back(fmt::format("objective_{}", objective.name));
  }
  return names;
}

/// How a search ended.
std::string ending_text(Termination termination, std::string_view budget,
                        std::string_view converged) {
  switch (termination) {
    case Termination::converged:
      return std::string(converged);
    case Termination::target_reached:
      return "until search.target was reached";
    case Termination::stagnated:
      return "until search.stagnation designs in a row were no better";
    case Termination::budget_exhausted:
      return fmt::format("all that {} allows", budget);
    case Termination::time_limit:
      return "until search.time_limit";
    case Termination::stop_requested:
      break;
  }
  return "until it was interrupted";
}

}  // namespace

std::string tried_text(const std::string& designs, const DesignTrial& trial, Precision precision,
                       double seconds, Termination termination, std::string_view budget,
                       std::string_view converged) {
  const std::size_t conditions = trial.conditions().size();
  return fmt::format(
      "Tried {} on {} screens{} in {} precision in {}, {}", designs, trial.screen_count(),
      conditions > 1 ? fmt::format(" under each of {} conditions", conditions) : "",
      word_of(precision), duration_text(seconds), ending_text(termination, budget, converged));
}

SearchLog::SearchLog(std::string stage, const DesignSpace& space, const Setup& setup,
                     EvaluatorOptions& options, RunRecord& record, std::string then,
                     const Progress* whole, std::vector<DesignMetric> objectives)
    : stage_(std::move(stage)),
      space_(space),
      setup_(setup),
      objectives_(std::move(objectives)),
      record_(record),
      progress_(stage_, options.budget, "designs", std::move(then), whole),
      table_(columns(objectives_)),
      budget_(options.budget) {
  if (options.time_limit) progress_.must_end_by(*options.time_limit);
  if (InterruptWatch::interrupted()) stop_.request_stop();
  options.stop = stop_.get_token();
  options.observer = [this](const EvaluationRecord& evaluation) {
    add(evaluation);
    if (InterruptWatch::interrupted()) stop_.request_stop();
  };
}

ScreenWatch SearchLog::interruptible() const {
  return [this] { return evaluations_ == 0 || !InterruptWatch::interrupted(); };
}

void SearchLog::add(const EvaluationRecord& evaluation) {
  const SensorDesign design = space_.design(evaluation.point);
  const bool failed = !evaluation.failure.empty();
  const Performance performance =
      failed ? Performance{} : pooled(std::any_cast<TriedDesign>(&evaluation.detail)->performances);
  const auto mean_of = [&](std::string_view metric) -> std::optional<double> {
    if (failed) return std::nullopt;
    return performance.mean_of(performance_metric(metric)).mean;
  };
  record_.add({.stage = stage_,
               .design = to_json(design, setup_.telescope, setup_.seeing().fried_parameter).dump(),
               .cost = evaluation.cost,
               .failure = evaluation.failure,
               .seconds = evaluation.seconds,
               .performance = failed ? "" : to_json(performance).dump()});

  table_.row().add(evaluation.index).add(fmt::format("{:.7g}", fmt::join(design.planes, ",")));
  for (const DesignField& property : design_properties()) table_.add(property.get(design));
  table_.add(evaluation.cost)
      .add(evaluation.violation)
      .add(static_cast<double>(evaluation.samples));
  table_.add(evaluation.given_up ? 1.0 : 0.0);
  for (const char* metric : {"residual_wfe_nm", "total_wfe_nm", "fractional_loops"}) {
    table_.add(mean_of(metric));
  }
  table_.add(evaluation.failure);
  for (std::size_t i = 0; i < objectives_.size(); ++i) {
    table_.add(failed ? std::nullopt
                      : std::optional(objectives_[i].minimised(evaluation.objectives[i])));
  }
  reconstructions_ += static_cast<long>(performance.screens.size());
  given_up_ += evaluation.given_up ? 1 : 0;
  steps_.push_back({.evaluation = evaluation.index,
                    .cost = evaluation.cost,
                    .best_cost = evaluation.best_cost,
                    .given_up = evaluation.given_up});
  evaluations_ = evaluation.index;
  if (objectives_.empty()) {
    progress_.describe(fmt::format("{} of {} designs, lowest cost {:.4g}", evaluation.index,
                                   budget_, evaluation.best_cost));
  }
  progress_.at(evaluation.index);
}

}  // namespace nlcwfs
