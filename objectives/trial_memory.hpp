// What is asked before a design is simulated again.
#pragma once

#include "model/performance.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nlcwfs {

/// What is known of a design in a trial.
struct RememberedTrial {
  std::vector<Performance> performances;  ///< one per condition: of its first screens, as many each
  std::string failure = {};               ///< why there are none; empty where there are
};

/// A memory that cannot be read or written: no design is to blame, and the study cannot go on.
struct TrialMemoryFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Keeps what designs did in trials, so that no screen is simulated twice: by a run that goes on
/// with an interrupted one, or by another run. May be used by many threads.
class TrialMemory {
 public:
  virtual ~TrialMemory() = default;

  /// @param trial   DesignTrial::identity()
  /// @param design  exact_text()
  /// @throws TrialMemoryFailed with the cause
  virtual std::optional<RememberedTrial> find(const std::string& trial,
                                              const std::string& design) = 0;

  /// Keeps it from now on, whatever happens to this process; replaces what was kept before.
  /// @throws TrialMemoryFailed with the cause
  virtual void keep(const std::string& trial, const std::string& design,
                    const RememberedTrial& remembered) = 0;
};

}  // namespace nlcwfs
