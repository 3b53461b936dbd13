#pragma once

#include "studies/command_line/commands.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

struct ConfigurationKey;

/// An option of the command line that is no configuration key.
struct ProgramOption {
  std::string name;                       ///< without its two dashes
  std::string value_name;                 ///< empty for a flag
  std::string description;                ///< what it does
  bool (*is_of)(const Command& command);  ///< whether a command takes it
  std::vector<std::string> choices = {};  ///< the words that it may have; empty where others may
};

/// Every such option, in the order of the help.
const std::vector<ProgramOption>& program_options();

/// What stands for a key's value in the help: "LENGTH", "NUMBERS", ...
std::string value_name(const ConfigurationKey& key);

}  // namespace nlcwfs
