// The list of commands.
#pragma once

#include "studies/run/command.hpp"

namespace nlcwfs {

/// Every command, in the order of the help.
const std::vector<Command>& commands();

/// Null where there is none of this name.
const Command* find_command(std::string_view name);

/// @pre there is such a command
const Command& command_of(std::string_view name);

/// Their names, in the order of the help.
std::vector<std::string> command_names();

}  // namespace nlcwfs
