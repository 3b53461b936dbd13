#include "objectives/design_problem.hpp"

#include <utility>

namespace nlcwfs {

DesignProblem::DesignProblem(const DesignSpace& space, const DesignTrial& trial)
    : space_(space), trial_(trial) {}

std::string DesignProblem::key(const SearchPoint& point) const {
  return design_key(space_.design(point));
}

Assessment DesignProblem::assess(const SearchPoint& point, const GoesOn& goes_on) {
  TriedDesign tried = trial_.run(space_.design(point), goes_on);
  return {.costs = tried.costs, .violation = tried.violation, .detail = std::move(tried)};
}

}  // namespace nlcwfs
