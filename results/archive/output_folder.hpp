// A run's folder is made, written to and cleared, and nothing is overwritten.
#pragma once

#include "results/archive/run_files.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace nlcwfs {

/// Where a run writes to: a folder of its own, which never existed before unless the run
/// goes on with an interrupted one.
class OutputFolder {
 public:
  /// Makes the folder.
  /// @param requested  the folder that the user named; nothing = `results/<command>-<n>`, the first
  ///                   that is free, below the current directory
  /// @throws InputError where the requested folder exists; std::runtime_error where it cannot be
  ///         made
  OutputFolder(const std::optional<std::filesystem::path>& requested, std::string_view command);

  /// Says whether a requested folder is free, before a run that may take long.
  /// @throws InputError where it exists
  static void require_free(const std::filesystem::path& requested);

  /// The folder of an earlier run, to go on in.
  /// @pre it exists
  static OutputFolder of_earlier_run(const std::filesystem::path& path);

  /// As the user sees it.
  const std::filesystem::path& path() const { return path_; }
  /// The path of a file in it that the run writes, or the stem of a picture's.
  std::filesystem::path file(std::string_view name) const {
    if (writes_) writes_(std::string(name));
    return path_ / name;
  }

  /// Has a function told the name of each file, or stem, before it is written.
  void tell_writes(std::function<void(const std::string&)> writes) { writes_ = std::move(writes); }

  /// Removes what an earlier run has left in it but its configuration and archive; files that have
  /// no names of results stay.
  /// @param files  that it has made
  /// @throws std::runtime_error with path and cause
  void remove_results(std::span<const RunFile> files) const;

  /// Waits until all files in it are on disk.
  /// @throws std::runtime_error with path and cause
  void sync() const;

  /// Writes a text file, under another name until it is complete. It is on disk when the function
  /// returns.
  /// @throws std::runtime_error with path and cause
  void write(std::string_view name, std::string_view text) const;

 private:
  OutputFolder() = default;

  std::filesystem::path path_;
  std::function<void(const std::string&)> writes_ = {};
};

}  // namespace nlcwfs
