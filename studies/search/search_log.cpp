// A search is watched: archive, table and progress.
#include "studies/search/search_log.hpp"

#include "results/tables/design_summary.hpp"
#include "results/text/axis_text.hpp"
#include "studies/run/evaluation_log.hpp"
#include "studies/run/interrupt.hpp"

#include <any>
#include <utility>

#include <fmt/format.h>
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

}  // namespace

SearchLog::SearchLog(std::string stage, const DesignSpace& space, const Telescope& telescope,
                     double fried_parameter, const EvaluatorOptions& limits, Archive& archive,
                     std::string then, const Progress* whole, std::vector<DesignMetric> objectives)
    : stage_(std::move(stage)),
      space_(space),
      telescope_(telescope),
      fried_parameter_(fried_parameter),
      objectives_(std::move(objectives)),
      archive_(archive),
      progress_(stage_, limits.budget, "designs", std::move(then), whole),
      table_(columns(objectives_)),
      budget_(limits.budget) {
  if (limits.time_limit) progress_.must_end_by(*limits.time_limit);
}

ScreenWatch SearchLog::interruptible() const {
  return [this] { return evaluations_ == 0 || !InterruptWatch::interrupted(); };
}

void SearchLog::add(const EvaluationRecord& evaluation) {
  const SensorDesign design = space_.design(evaluation.point);
  const bool failed = !evaluation.failure.empty();
  const auto* tried = std::any_cast<TriedDesign>(&evaluation.detail);
  archive_and_log(archive_,
                  {.stage = stage_,
                   .design = to_json(design, telescope_, fried_parameter_).dump(),
                   .cost = evaluation.cost,
                   .failure = evaluation.failure,
                   .seconds = evaluation.seconds,
                   .performance = failed ? "" : to_json(pooled(tried->performances)).dump()});

  table_.row().add(evaluation.index).add(fmt::format("{:.7g}", fmt::join(design.planes, ",")));
  for (const DesignField& property : design_properties()) table_.add(property.get(design));
  table_.add(evaluation.cost)
      .add(evaluation.violation)
      .add(static_cast<double>(evaluation.samples));
  table_.add(evaluation.given_up ? 1.0 : 0.0);
  for (const char* metric : {"residual_wfe_nm", "total_wfe_nm", "fractional_loops"}) {
    if (failed) {
      table_.add("");
    } else {
      table_.add(pooled(tried->performances).mean_of(performance_metric(metric)).mean);
    }
  }
  table_.add(evaluation.failure);
  for (std::size_t i = 0; i < objectives_.size(); ++i) {
    if (failed) {
      table_.add("");
    } else {
      table_.add(objectives_[i].minimised(evaluation.objectives[i]));
    }
  }
  if (!failed) {
    for (const Performance& performance : tried->performances) {
      reconstructions_ += static_cast<long>(performance.screens.size());
    }
  }
  given_up_ += evaluation.given_up ? 1 : 0;
  steps_.push_back({.evaluation = evaluation.index,
                    .cost = evaluation.cost,
                    .best_cost = evaluation.best_cost,
                    .given_up = evaluation.given_up});
  show_progress(evaluation);
}

void SearchLog::show_progress(const EvaluationRecord& evaluation) {
  evaluations_ = evaluation.index;
  if (objectives_.empty()) {
    progress_.describe(fmt::format("{} of {} designs, lowest cost {:.4g}", evaluation.index,
                                   budget_, evaluation.best_cost));
  }
  progress_.at(evaluation.index);
}

}  // namespace nlcwfs
