// The options of the command line that are no configuration keys.
#include "studies/command_line/program_options.hpp"

#include "studies/commands/commands.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

std::string preset_names() {
  std::vector<std::string> texts;
  for (const Preset& preset : presets()) {
    texts.push_back(fmt::format("{} ({})", preset.name, preset.description));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::vector<std::string> preset_choices() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return names;
}

/// Of what is configured and leaves results.
bool is_of_runs(const Command& command) { return !command.keys.empty(); }
bool is_of_all(const Command& /*command*/) { return true; }
bool is_of_resumable(const Command& command) { return command.resumption != Resumption::none; }
bool is_of_trials(const Command& command) { return command.resumption == Resumption::by_trials; }

std::vector<ProgramOption> all_options() {
  std::vector<ProgramOption> options{
      {{.name = "config",
        .value_name = "FILE",
        .description = "read a configuration file; of several, the later wins",
        .repeats = true},
       is_of_runs},
      {{"preset",
        "NAME",
        "start from a named set of values: " + preset_names(),
        {},
        preset_choices()},
       is_of_runs},
      {{"output", "DIR", "write the results there [results/<command>-<n>]"}, is_of_runs},
      {{"resume", "DIR", "go on with the interrupted run in this folder, as it is configured"},
       is_of_resumable},
      {{"reuse", "DIR", "simulate nothing again that the run in this folder has simulated alike"},
       is_of_trials}};
  for (const Command& command : commands()) {
    for (const CommandOption& option : command.options) {
      options.push_back({option, nullptr, &command});
    }
  }
  options.insert(
      options.end(),
      {{{"threads", "N", "use this many cores, 0 = all [0]; of several ranks each so many"},
        is_of_runs},
       {{"log-level",
         "LEVEL",
         "what goes to standard error while the command runs: error, warning, info (progress) or "
         "debug (each stage and design too) [info]",
         {},
         {"error", "warning", "info", "debug"}},
        is_of_runs},
       {{"quiet", "", "no progress: the same as --log-level warning"}, is_of_runs},
       {{"dump-config", "", "print every key with its value as a configuration file, and stop"},
        is_of_runs},
       {{"help", "", "print this text, and stop"}, is_of_all},
       {{"version", "", "print the version, and stop"}, is_of_all}});
  return options;
}

}  // namespace

const std::vector<ProgramOption>& program_options() {
  static const std::vector<ProgramOption> options = all_options();
  return options;
}

const ProgramOption* find_program_option(std::string_view name) {
  const auto option = std::ranges::find(program_options(), name, &ProgramOption::name);
  return option == program_options().end() ? nullptr : &*option;
}

std::string value_name(const ConfigurationKey& key) {
  switch (key.kind) {
    case Kind::number:
    case Kind::ramp:
      return "NUMBER";
    case Kind::number_list:
      return "NUMBERS";
    case Kind::integer:
      return "INTEGER";
    case Kind::seed:
      return "SEED";
    case Kind::length:
      return "LENGTH";
    case Kind::length_list:
      return "LENGTHS";
    case Kind::bands:
      return "BANDS";
    case Kind::domain:
      return key.element == Kind::choice ? "WORDS" : "RANGE";
    case Kind::axis:
      return key.element == Kind::choice ? "WORDS" : "GRID";
    case Kind::orders:
      return "ORDERS";
    case Kind::time:
      return "TIME";
    case Kind::choice:
      return "WORD";
    case Kind::text:
      return key.is_file ? "FILE" : "TEXT";
  }
  return "TEXT";
}

}  // namespace nlcwfs
