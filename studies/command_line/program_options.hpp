// The options of the command line that are no configuration keys.
#pragma once

#include "studies/run/command.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

struct ConfigurationKey;

/// An option of the command line that is no configuration key.
struct ProgramOption : CommandOption {
  bool (*is_of_kind)(const Command& command) = nullptr;  ///< of commands that take it
  const Command* command = nullptr;                      ///< where it is of one alone

  /// Whether a command takes it.
  bool is_of(const Command& other) const {
    return command == nullptr ? is_of_kind(other) : command == &other;
  }
};

/// Every such option, in the order of the help.
const std::vector<ProgramOption>& program_options();

/// Null where there is none of this name.
const ProgramOption* find_program_option(std::string_view name);

/// What stands for a key's value in the help: "LENGTH", "NUMBERS", ...
std::string value_name(const ConfigurationKey& key);

}  // namespace nlcwfs
