#pragma once

#include <string>

namespace nlcwfs {

struct Command;

/// What the program is, its commands and options, for a terminal of 100 columns.
std::string program_help();

/// What a command does, with examples, the options that it takes and the keys that it reads, for a
/// terminal of 100 columns.
std::string command_help(const Command& command);

}  // namespace nlcwfs
