#include "studies/search_log.hpp"

#include "results/design_summary.hpp"
#include "studies/axis_text.hpp"

#include <algorithm>
#include <any>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// Of every search, whatever it varies: what differs from the configuration is easily seen.
std::vector<std::string> columns(const std::vector<DesignMetric>& objectives) {
  std::vector<std::string> names{"evaluation", "planes_m"};
  for (const DesignProperty& property : design_properties()) {
    names.push_back(column_of_variable(property.name));
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
                     bool quiet, std::vector<DesignMetric> objectives)
    : stage_(std::move(stage)),
      space_(space),
      telescope_(telescope),
      fried_parameter_(fried_parameter),
      limits_(limits),
      objectives_(std::move(objectives)),
      archive_(archive),
      progress_(quiet),
      table_(columns(objectives_)) {}

void SearchLog::add(const EvaluationRecord& evaluation) {
  const SensorDesign design = space_.design(evaluation.point);
  const bool failed = !evaluation.failure.empty();
  const auto* tried = std::any_cast<TriedDesign>(&evaluation.detail);
  archive_.add({.stage = stage_,
                .design = to_json(design, telescope_, fried_parameter_).dump(),
                .cost = evaluation.cost,
                .failure = evaluation.failure,
                .seconds = evaluation.seconds,
                .performance = failed ? "" : to_json(pooled(tried->performances)).dump()});

  table_.row().add(evaluation.index).add(fmt::format("{:.7g}", fmt::join(design.planes, ",")));
  for (const DesignProperty& property : design_properties()) table_.add(property.get(design));
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
  const std::chrono::duration<double> since_start = std::chrono::steady_clock::now() - start_;
  const double elapsed = since_start.count();
  double left = elapsed / evaluation.index * (limits_.budget - evaluation.index);
  if (limits_.time_limit) left = std::min(left, std::max(0.0, *limits_.time_limit - elapsed));
  const std::string lowest =
      objectives_.empty() ? fmt::format(", lowest cost {:.4g}", evaluation.best_cost) : "";
  progress_.show(fmt::format("{}: design {} of {}{}, {} left, then the verification", stage_,
                             evaluation.index, limits_.budget, lowest, duration_text(left)));
}

}  // namespace nlcwfs
