#pragma once

#include "objectives/design_trial.hpp"
#include "objectives/plane_layout.hpp"
#include "optimizer/problem.hpp"

#include <string>

namespace nlcwfs {

/// The search for the planes of a sensor whose other properties are fixed: each point of a layout
/// is tried.
class PlacementProblem final : public Problem {
 public:
  /// @param trial, layout  used by reference
  /// @param design         everything but the planes
  PlacementProblem(const DesignTrial& trial, const PlaneLayout& layout, SensorDesign design);

  std::vector<Variable> variables() const override { return layout_.variables(); }
  int choice_count() const override { return layout_.choice_count(); }
  /// The planes to 7 digits, in visiting order.
  std::string key(const SearchPoint& point) const override;
  double cost(const SearchPoint& point) override;

  SensorDesign design(const SearchPoint& point) const;
  /// The design whose cost was asked for last; without performances where it failed.
  const TriedDesign& last_tried() const { return last_tried_; }

 private:
  const DesignTrial& trial_;
  const PlaneLayout& layout_;
  SensorDesign design_;
  TriedDesign last_tried_;
};

}  // namespace nlcwfs
