#include "objectives/design_problem.hpp"

#include <utility>

namespace nlcwfs {

DesignProblem::DesignProblem(const DesignSpace& space, const DesignTrial& trial,
                             std::vector<DesignMetric> objectives)
    : space_(space), trial_(trial), objectives_(std::move(objectives)) {}

std::string DesignProblem::key(const SearchPoint& point) const {
  return design_key(space_.design(point));
}

Assessment DesignProblem::assess(const SearchPoint& point, const GoesOn& goes_on) {
  TriedDesign tried = trial_.run(space_.design(point), goes_on);
  Assessment assessment{.costs = tried.costs, .violation = tried.violation};
  for (const DesignMetric& objective : objectives_) {
    assessment.objectives.push_back(
        objective.minimised(mean_and_standard_error(trial_.objective_of(tried, objective)).mean));
  }
  assessment.detail = std::move(tried);
  return assessment;
}

}  // namespace nlcwfs
