#include "studies/command_line/program_options.hpp"

#include "studies/settings/configuration.hpp"

#include <sstream>

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

/// What reproduce runs by default: all that it knows.
std::vector<std::string> figures() {
  std::vector<std::string> names;
  std::istringstream list(Configuration().text("reproduce.figures"));
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

/// Of what is configured and leaves results.
bool is_of_runs(const Command& command) { return !command.keys.empty(); }
bool is_of_all(const Command& /*command*/) { return true; }

}  // namespace

const std::vector<ProgramOption>& program_options() {
  static const std::vector<ProgramOption> options{
      {"config", "FILE", "read a configuration file; of several, the later wins", is_of_runs},
      {"preset", "NAME", "start from a named set of values: " + preset_names(), is_of_runs,
       preset_choices()},
      {"output", "DIR", "write the results there [results/<command>-<n>]", is_of_runs},
      {"resume", "DIR", "go on with the interrupted run in this folder, as it is configured",
       [](const Command& command) { return command.resumable; }},
      {"reuse", "DIR", "simulate nothing again that the run in this folder has simulated alike",
       [](const Command& command) { return command.resumable && command.name != "reproduce"; }},
      {"figure", "N",
       "run only this figure of the paper, or another part that reproduce.figures knows; may be "
       "given several times",
       [](const Command& command) { return command.name == "reproduce"; }, figures()},
      {"frames", "FILE", "read the measured frames of this FITS file, as frames.file",
       [](const Command& command) { return command.name == "reconstruct"; }},
      {"verify", "", "simulate the design on fresh screens, as the section verify says",
       [](const Command& command) { return command.name == "advise"; }},
      {"threads", "N", "use this many cores, 0 = all [0]; of several ranks each so many",
       is_of_runs},
      {"log-level",
       "LEVEL",
       "what goes to standard error while the command runs: error, warning, info (progress) or "
       "debug (each stage and design too) [info]",
       is_of_runs,
       {"error", "warning", "info", "debug"}},
      {"quiet", "", "no progress: the same as --log-level warning", is_of_runs},
      {"dump-config", "", "print every key with its value as a configuration file, and stop",
       is_of_runs},
      {"help", "", "print this text, and stop", is_of_all},
      {"version", "", "print the version, and stop", is_of_all}};
  return options;
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
