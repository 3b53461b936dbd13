// A design space and its trial become a problem that an optimizer sees.
#pragma once

#include "objectives/design_metric.hpp"
#include "objectives/design_space.hpp"
#include "objectives/design_trial.hpp"
#include "optimizer/problem.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

/// The search for a sensor: each point of a design space is tried.
class DesignProblem final : public Problem {
 public:
  /// @param space, trial  used by reference
  /// @param objectives    whose means, as figures to be minimised, are a design's objectives; none
  ///                      where the cost alone counts
  /// @param watch         ends the search where it ends a trial; see Problem::assess
  DesignProblem(const DesignSpace& space, const DesignTrial& trial,
                std::vector<DesignMetric> objectives = {}, ScreenWatch watch = {});

  std::vector<SubSpace> sub_spaces() const override { return space_.sub_spaces(); }
  /// See design_key.
  std::string key(const SearchPoint& point) const override;
  /// The detail is the TriedDesign.
  Assessment assess(const SearchPoint& point, const GoesOn& goes_on) override;

  /// The space whose designs the points of the search stand for.
  const DesignSpace& space() const { return space_; }

 private:
  const DesignSpace& space_;
  const DesignTrial& trial_;
  std::vector<DesignMetric> objectives_;
  ScreenWatch watch_;
};

}  // namespace nlcwfs
