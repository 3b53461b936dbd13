#pragma once

#include <string>

namespace nlcwfs {

struct CommandLine;

/// The manual page nlcwfs(1), for man: every command, option and key from the tables that the
/// program itself follows.
std::string manual_page();

/// The command: prints it.
void run_manual(const CommandLine& command_line);

}  // namespace nlcwfs
