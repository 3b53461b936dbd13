#include "objectives/placement_problem.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

PlacementProblem::PlacementProblem(const Simulation& simulation, const PlaneLayout& layout,
                                   SensorDesign design, const DesignCost& cost)
    : simulation_(simulation), layout_(layout), design_(std::move(design)), cost_(cost) {}

std::string PlacementProblem::key(const SearchPoint& point) const {
  return fmt::format("{:.7g}", fmt::join(layout_.planes(point), ","));
}

double PlacementProblem::cost(const SearchPoint& point) {
  const SensorDesign candidate = design(point);
  last_performance_ = {};
  last_performance_ = simulation_.evaluate(candidate);
  return mean_and_standard_error(cost_.per_screen(last_performance_, candidate)).mean;
}

SensorDesign PlacementProblem::design(const SearchPoint& point) const {
  SensorDesign design = design_;
  design.planes = layout_.planes(point);
  return design;
}

}  // namespace nlcwfs
