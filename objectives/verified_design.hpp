#pragma once

#include "model/simulation.hpp"
#include "objectives/design_cost.hpp"

#include <vector>

namespace nlcwfs {

/// A design with its performance on screens that no search has seen.
struct VerifiedDesign {
  SensorDesign design;
  Performance performance;
  std::vector<double> costs;  ///< of each screen
};

/// Simulates a design in a verification.
VerifiedDesign verify(const SensorDesign& design, const Simulation& verification,
                      const DesignCost& cost);

/// What a comparison of two designs says.
enum class Verdict { better, indistinguishable, worse };

/// How much cheaper one design is than another on the same screens.
struct Improvement {
  MeanAndError cost;  ///< reference - candidate, paired by screen: above 0 is better
  Verdict verdict;    ///< by Student's t test at 5 %, two-sided
};

/// Compares two designs that were verified on the same screens.
Improvement improvement(const VerifiedDesign& candidate, const VerifiedDesign& reference);

}  // namespace nlcwfs
