// What the user asks for.
#pragma once

#include "studies/run/log.hpp"
#include "studies/settings/configuration.hpp"

#include <memory>

namespace nlcwfs {

struct Command;
class Progress;
class TrialRunner;

/// What the user asks for.
struct Request {
  const Command* command = nullptr;         ///< one of commands(); null only with help or version
  std::vector<std::string> arguments = {};  ///< what follows the command, as many as it takes
  std::set<std::string, std::less<>> flags = {};  ///< of the command's own options that are set
  Configuration configuration = {};  ///< what files, preset and command line say together
  std::optional<std::filesystem::path> output = {};  ///< directory for the results
  std::optional<std::filesystem::path> resume = {};  ///< folder of the run to go on with
  std::optional<std::filesystem::path> reuse = {};  ///< folder of a run whose trials are taken over
  int threads = 0;                                  ///< 0 = all cores
  std::shared_ptr<TrialRunner> runner = {};         ///< simulates the trials; null = this process
  LogLevel log_level = LogLevel::info;              ///< what goes to standard error
  bool silent = false;              ///< print no results either: for runs that are parts of another
  const Progress* whole = nullptr;  ///< of the run that this is a part of
  bool help = false;                ///< then the configuration holds the defaults
  bool version = false;             ///< then the configuration holds the defaults
  bool dump_config = false;         ///< print the configuration, and stop
};

}  // namespace nlcwfs
