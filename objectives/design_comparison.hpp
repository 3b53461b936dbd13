#pragma once

#include "model/statistics.hpp"
#include "objectives/design_trial.hpp"

namespace nlcwfs {

/// What a comparison of two designs says.
enum class Verdict { better, indistinguishable, worse };

/// How much cheaper one design is than another on the same screens.
struct Improvement {
  MeanAndError cost;  ///< reference - candidate, paired by screen: above 0 is better
  Verdict verdict;    ///< by Student's t test at 5 %, two-sided
};

/// Compares two designs that were tried on the same screens.
Improvement improvement(const TriedDesign& candidate, const TriedDesign& reference);

}  // namespace nlcwfs
