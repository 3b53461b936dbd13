#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

struct CommandLine;

/// One of the program's commands: a row of the table that the command line, the help, the manual
/// page and the shells' completion are made from.
struct Command {
  std::string name;         ///< as it is typed
  std::string group;        ///< of commands that belong together; rows of a group are neighbours
  std::string description;  ///< one line
  std::string about;        ///< two or three sentences on what it does and leaves behind
  /// What it reads of the configuration: sections, such as "telescope", or single keys, such as
  /// "screens.seed".
  std::vector<std::string> keys;
  std::vector<std::string> examples;                       ///< whole command lines
  void (*run)(const CommandLine& command_line) = nullptr;  ///< does it; in studies/studies.hpp
  bool resumable = false;                                  ///< takes --resume
  /// Names of what must follow the command, such as folders; mostly none.
  std::vector<std::string> arguments = {};

  /// Whether the command reads a key of the configuration.
  bool reads(std::string_view key) const;
};

/// Every command, in the order of the help.
const std::vector<Command>& commands();

/// @pre there is such a command
const Command& command_of(std::string_view name);

/// The command line that goes on with a run: "nlcwfs sweep --resume results/sweep-1".
/// @param command  its name
/// @param folder   the run's
std::string resume_command(std::string_view command, const std::filesystem::path& folder);

/// Their names, in that order.
std::vector<std::string> command_names();

/// Prints a note of keys on the command line that mean nothing to the command, where a user surely
/// meant something. Files are silent: they serve several commands.
void print_ignored_keys(const CommandLine& command_line);

}  // namespace nlcwfs
