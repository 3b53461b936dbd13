// What a command is.
#pragma once

#include "results/archive/run_files.hpp"
#include "studies/run/request.hpp"

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// How a run of a command that was interrupted is gone on with.
enum class Resumption {
  none,       ///< it is begun anew
  by_trials,  ///< what its archive has is not simulated again; other runs may take that over too
  by_parts    ///< it is of runs, which are kept or gone on with
};

/// What must follow a command.
struct CommandArgument {
  std::string name;                       ///< for people, such as SWEEP
  std::vector<std::string> choices = {};  ///< the words that it may be; empty where it is a folder
};

/// An option that one command alone takes.
struct CommandOption {
  std::string name;                       ///< without its two dashes
  std::string value_name = {};            ///< empty for a flag, which Request::flags then has
  std::string description = {};           ///< what it does
  std::string key = {};                   ///< the key of the configuration that its value is for
  std::vector<std::string> choices = {};  ///< the words that it may have; empty where others may
  bool repeats = false;                   ///< whether it may be given several times, as a list
};

/// One of the program's commands: what the command line, the help, the manual page, the shells'
/// completion and the page of its runs are made from. Each is a file with its function
/// evaluate_command(), ...
struct Command {
  std::string name;         ///< as it is typed
  std::string group;        ///< of commands that belong together, which are neighbours
  std::string description;  ///< one line
  std::string about;        ///< two or three sentences on what it does and leaves behind
  /// What it reads of the configuration: sections, such as "telescope", or single keys, such as
  /// "screens.seed".
  std::vector<std::string> keys;
  std::vector<std::string> examples;  ///< whole command lines
  /// Does it. It checks all of its input before it makes the output folder, writes its results
  /// there and prints a short summary on standard output; it throws InputError for bad input and
  /// other exceptions for a run that failed.
  void (*run)(const Request& request) = nullptr;
  Resumption resumption = Resumption::none;        ///< whether it takes --resume and --reuse
  std::vector<CommandArgument> arguments = {};     ///< mostly none
  std::vector<CommandOption> options = {};         ///< beside those that all commands take
  void (*set_defaults)(Configuration&) = nullptr;  ///< its own, of keys that the user did not set
  std::vector<RunFile> files = {};                 ///< beside common_files()
  /// What a run has come to, in a sentence or two for the head of its page. It throws
  /// nlohmann::json::exception where a member of summary.json is missing or of another type.
  std::string (*verdict)(const nlohmann::ordered_json& summary) = nullptr;
  bool is_for_a_start = false;   ///< whether the program's help shows its first example
  bool is_of_one_seeing = true;  ///< whether the head of its page names the seeing

  /// Whether it reads a key of the configuration.
  bool reads(std::string_view key) const;
};

/// The command line that goes on with a run: "nlcwfs sweep --resume results/sweep-1".
std::string resume_command(const Command& command, const std::filesystem::path& folder);

/// Prints notes: of keys on the command line that mean nothing to the command, where a user surely
/// meant something (files are silent: they serve several commands); and of the seeing, where a
/// telescope was given and none for it.
void print_notes_on_keys(const Request& request);

}  // namespace nlcwfs
