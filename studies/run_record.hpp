#pragma once

#include "results/archive.hpp"
#include "results/output_folder.hpp"
#include "studies/command_line.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nlcwfs {

/// What every run leaves in its output folder: config.cfg, archive.sqlite, summary.json.
class RunRecord {
 public:
  /// Makes the folder with the configuration and an empty archive; with --resume it takes those of
  /// the earlier run. Call it when nothing in the input can be wrong any more.
  explicit RunRecord(const CommandLine& command_line);

  /// Where the run writes to.
  const OutputFolder& folder() const { return folder_; }
  /// The run's evaluations.
  Archive& archive() { return archive_; }

  /// Writes summary.json: command, version, config (every key with its text, null where not set),
  /// then `results`. From it and the files that are there already it makes report.html, unless the
  /// run is a silent part of another: call it last.
  void write_summary(const nlohmann::ordered_json& results) const;

  /// Prints on standard output, unless the run is a silent part of another.
  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) const {
    if (!command_line_.silent) fmt::print(format, std::forward<Values>(values)...);
  }

  /// "Open results/optimize-1/report.html in a browser.", where it is there, and "Results are in
  /// results/optimize-1."
  std::string closing_line() const;

 private:
  const CommandLine& command_line_;
  OutputFolder folder_;
  Archive archive_;
};

}  // namespace nlcwfs
