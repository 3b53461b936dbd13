#include "objectives/placement_problem.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

PlacementProblem::PlacementProblem(const DesignTrial& trial, const PlaneLayout& layout,
                                   SensorDesign design)
    : trial_(trial), layout_(layout), design_(std::move(design)) {}

std::string PlacementProblem::key(const SearchPoint& point) const {
  return fmt::format("{:.7g}", fmt::join(layout_.planes(point), ","));
}

double PlacementProblem::cost(const SearchPoint& point) {
  last_tried_ = {};
  last_tried_ = trial_.run(design(point));
  return mean_and_standard_error(last_tried_.costs).mean;
}

SensorDesign PlacementProblem::design(const SearchPoint& point) const {
  SensorDesign design = design_;
  design.planes = layout_.planes(point);
  return design;
}

}  // namespace nlcwfs
