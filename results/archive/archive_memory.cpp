// Trials are remembered in the run's archive, or found in another run's.
#include "results/archive/archive_memory.hpp"

#include "results/archive/performance_record.hpp"

#include <stdexcept>
#include <utility>

namespace nlcwfs {

ArchiveMemory::ArchiveMemory(Archive& archive, std::optional<Archive> other)
    : archive_(archive), other_(std::move(other)) {}

std::optional<RememberedTrial> ArchiveMemory::find(const std::string& trial,
                                                   const std::string& design) try {
  auto known = archive_.find(trial, design);
  if (!known && other_) {
    known = other_->find(trial, design);
    // Another run's failure may have been its machine's.
    if (known && !known->failure.empty()) known.reset();
    if (known) archive_.keep(trial, design, *known);
  }
  if (!known) return std::nullopt;
  if (!known->failure.empty()) return RememberedTrial{{}, known->failure};
  return RememberedTrial{performances_of(known->performances)};
} catch (const std::runtime_error& error) {
  throw TrialMemoryFailed(error.what());
}

void ArchiveMemory::keep(const std::string& trial, const std::string& design,
                         const RememberedTrial& remembered) try {
  ArchivedTrial known{{}, remembered.failure};
  if (known.failure.empty()) known.performances = performance_record(remembered.performances);
  archive_.keep(trial, design, known);
} catch (const std::runtime_error& error) {
  throw TrialMemoryFailed(error.what());
}

}  // namespace nlcwfs
