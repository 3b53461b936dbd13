// The help of the program and of each command.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

struct Command;
struct ProgramOption;

/// What the program is, its commands and options, for a terminal of 100 columns.
std::string program_help();

/// What a command does, with examples, the options that it takes and the keys that it reads, for a
/// terminal of 100 columns.
std::string command_help(const Command& command);

/// A command line in lines of at most `width` characters, as far as its options are not longer:
/// each option stands with its value.
std::vector<std::string> example_lines(std::string_view example, std::size_t width);

/// What an option does, after the names of the commands that take it where most do not.
std::string with_takers(const ProgramOption& option);

/// A sentence, with a capital letter.
std::string with_capital(std::string text);

}  // namespace nlcwfs
