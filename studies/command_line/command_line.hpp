#pragma once

#include "studies/run/log.hpp"
#include "studies/settings/configuration.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

class Progress;
class TrialRunner;

/// What the user asked for.
struct CommandLine {
  std::string command;                 ///< one of commands(); empty only with help or version
  std::vector<std::string> arguments;  ///< what follows the command, as many as it takes
  Configuration configuration;         ///< what files, preset and command line say together
  std::optional<std::filesystem::path> output;  ///< directory for the results
  std::optional<std::filesystem::path> resume;  ///< folder of the run to go on with
  std::optional<std::filesystem::path> reuse;   ///< folder of a run whose trials are taken over
  int threads = 0;                              ///< 0 = all cores
  std::shared_ptr<TrialRunner> runner;          ///< simulates the trials; null = this process
  LogLevel log_level = LogLevel::info;          ///< what goes to standard error
  bool silent = false;              ///< print no results either: for runs that are parts of another
  const Progress* whole = nullptr;  ///< of the run that this is a part of
  bool verify = false;              ///< simulate what advise predicts; only for advise
  bool help = false;                ///< then the configuration holds the defaults
  bool version = false;             ///< then the configuration holds the defaults
  bool dump_config = false;         ///< print the configuration, and stop
};

/// Reads the command line and the files and the preset that it names; the command line's values
/// override the files', later files earlier ones, files the preset, the preset the defaults.
/// @throws InputError for what it cannot follow
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace nlcwfs
