#pragma once

#include "model/simulation.hpp"
#include "objectives/design_cost.hpp"
#include "objectives/plane_layout.hpp"
#include "optimizer/problem.hpp"

#include <string>

namespace nlcwfs {

/// The search for the planes of a sensor whose other properties are fixed: each point of a layout
/// is simulated, and its performance costed.
class PlacementProblem final : public Problem {
 public:
  /// @param simulation, layout  used by reference
  /// @param design              everything but the planes
  PlacementProblem(const Simulation& simulation, const PlaneLayout& layout, SensorDesign design,
                   const DesignCost& cost);

  std::vector<Variable> variables() const override { return layout_.variables(); }
  int choice_count() const override { return layout_.choice_count(); }
  /// The planes to 7 digits, in visiting order.
  std::string key(const SearchPoint& point) const override;
  double cost(const SearchPoint& point) override;

  SensorDesign design(const SearchPoint& point) const;
  /// Of the design whose cost was asked for last.
  const Performance& last_performance() const { return last_performance_; }

 private:
  const Simulation& simulation_;
  const PlaneLayout& layout_;
  SensorDesign design_;
  DesignCost cost_;
  Performance last_performance_;
};

}  // namespace nlcwfs
