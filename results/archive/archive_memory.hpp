// Trials are remembered in the run's archive, or found in another run's.
#pragma once

#include "objectives/trial_memory.hpp"
#include "results/archive/archive.hpp"

#include <optional>
#include <string>

namespace nlcwfs {

/// Remembers trials in a run's archive, and asks that of another run where that does not know.
class ArchiveMemory : public TrialMemory {
 public:
  /// @param archive  used by reference
  /// @param other    is only read
  ArchiveMemory(Archive& archive, std::optional<Archive> other);

  std::optional<RememberedTrial> find(const std::string& trial, const std::string& design) override;
  void keep(const std::string& trial, const std::string& design,
            const RememberedTrial& remembered) override;

 private:
  Archive& archive_;
  std::optional<Archive> other_;
};

}  // namespace nlcwfs
