// What every run leaves in its folder.
#pragma once

#include "objectives/design_trial.hpp"
#include "results/archive/archive.hpp"
#include "results/archive/folder_lock.hpp"
#include "results/archive/output_folder.hpp"
#include "studies/run/interrupt.hpp"
#include "studies/run/request.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nlcwfs {

/// Whether a run has all of its results: not where it was interrupted, or is still going on.
bool is_complete(const std::filesystem::path& folder);

/// What every run leaves in its output folder: config.cfg, archive.sqlite, summary.json. While it
/// lives, an interrupt is noted: there is something to come to a clean end with.
class RunRecord {
 public:
  /// Makes the folder with the configuration and an empty archive; with --resume it takes those of
  /// the earlier run, and whatever else that has left is made anew. No other process may have its
  /// run there meanwhile. Notes keys that the command ignores. Call it when nothing in the input
  /// can be wrong any more.
  explicit RunRecord(const Request& request);

  /// Where the run writes to.
  const OutputFolder& folder() const { return folder_; }
  /// The run's evaluations.
  Archive& archive() { return archive_; }
  /// "go on with: nlcwfs sweep --resume results/sweep-1"
  std::string how_to_go_on() const;
  /// "; to try it again: nlcwfs sweep --resume results/sweep-1"; empty where it is begun anew.
  std::string how_to_try_again() const;
  /// From now on the trial remembers in the archive, and simulates on the ranks of the run.
  void adopt(DesignTrial& trial) const;

  /// Notes that an interrupt, or a failure that --resume tries again, has left the run's results
  /// with less than was asked for.
  /// @param what  for people: "5 of 16 screens are done"
  /// @throws RunInterrupted at once in a silent part of another run, which does such a part anew
  void note_interrupted(const std::string& what);

  /// The same where a design was not tried on all screens of the trial.
  void note_missing_screens(const TriedDesign& tried, const DesignTrial& trial);

  /// Archives an evaluation, and logs it: its stage, cost or failure, and how long it took.
  void add(const ArchivedEvaluation& evaluation);

  /// Writes the run's configuration with what a space decides on as a design has it.
  void write_design(std::string_view file, const SensorDesign& design, const DesignSpace& space,
                    std::string_view source) const;

  /// Writes summary.json: command, version, whether the run was interrupted, config (every key with
  /// its text, null where not set), then `results`. From it and the files that are there already it
  /// makes report.html, unless the run is a silent part of another: call it last.
  void write_summary(const nlohmann::ordered_json& results);

  /// Prints on standard output, unless the run is a silent part of another.
  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) const {
    if (!request_.silent) fmt::print(format, std::forward<Values>(values)...);
  }

  /// Prints where the results are: "Open results/optimize-1/report.html in a browser.", where it is
  /// there, and "Results are in results/optimize-1."
  /// @throws RunInterrupted where an interrupt was noted
  void close() const;

 private:
  const Request& request_;
  InterruptWatch watch_;
  std::string interruption_;  // empty without one
  OutputFolder folder_;
  std::unique_ptr<FolderLock> lock_;
  Archive archive_;
  std::shared_ptr<TrialMemory> memory_;
};

}  // namespace nlcwfs
