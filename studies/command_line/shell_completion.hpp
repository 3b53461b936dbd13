#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

struct CommandLine;

/// The shells that there is a completion for.
const std::vector<std::string>& completed_shells();

/// A script that lets a shell complete commands, the options and keys that each takes, the words
/// that a key may have, and the names of files and folders.
/// @param shell  one of completed_shells()
std::string shell_completion(std::string_view shell);

/// The command: prints the script of the shell that it is given.
void run_completion(const CommandLine& command_line);

}  // namespace nlcwfs
