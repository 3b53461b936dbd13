// A design space and its trial become a problem that an optimizer sees.
#include "objectives/design_problem.hpp"

#include "optimizer/evaluator.hpp"

#include <atomic>
#include <utility>

namespace nlcwfs {

DesignProblem::DesignProblem(const DesignSpace& space, const DesignTrial& trial,
                             std::vector<DesignMetric> objectives, ScreenWatch watch)
    : space_(space), trial_(trial), objectives_(std::move(objectives)), watch_(std::move(watch)) {}

std::string DesignProblem::key(const SearchPoint& point) const {
  return design_key(space_.design(point));
}

Assessment DesignProblem::assess(const SearchPoint& point, const GoesOn& goes_on) {
  std::atomic<bool> is_ended = false;
  const auto watch = [&] {
    if (watch_ && !watch_()) is_ended = true;
    return !is_ended;
  };
  TriedDesign tried;
  try {
    tried = trial_.run(space_.design(point), goes_on, watch);
  } catch (const TrialMemoryFailed& error) {
    throw SearchFailed(error.what());
  }
  if (is_ended && static_cast<int>(tried.costs.size()) < trial_.screen_count()) {
    throw SearchStopped(Termination::stop_requested);
  }
  Assessment assessment{.costs = tried.costs, .violation = tried.violation};
  for (const DesignMetric& objective : objectives_) {
    assessment.objectives.push_back(
        objective.minimised(mean_and_standard_error(trial_.objective_of(tried, objective)).mean));
  }
  assessment.detail = std::move(tried);
  return assessment;
}

}  // namespace nlcwfs
