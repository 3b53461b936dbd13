// Who simulates the screens of trials elsewhere.
#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"
#include "model/simulation.hpp"

#include <vector>

namespace nlcwfs {

class DesignTrial;

/// Simulates the screens of trials elsewhere than in the thread that asks, such as on other
/// machines. May be used by many threads; a screen's result does not depend on who computes it.
class TrialRunner {
 public:
  virtual ~TrialRunner() = default;

  /// DesignTrial::simulate, done elsewhere. What it throws there is thrown here.
  /// @param watch  where it ends the trial, the first screens are returned, as many under each
  ///               condition and one at least
  virtual std::vector<Performance> run(const DesignTrial& trial, const SensorDesign& design,
                                       int first, int count, const ScreenWatch& watch) = 0;

  /// How many threads simulate.
  virtual int threads() const = 0;
};

}  // namespace nlcwfs
