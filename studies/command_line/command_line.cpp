#include "studies/command_line/command_line.hpp"

#include "model/input_error.hpp"
#include "results/archive/archive.hpp"
#include "studies/command_line/commands.hpp"
#include "studies/command_line/program_options.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include <boost/program_options/cmdline.hpp>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/options_description.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

namespace po = boost::program_options;

/// A value that Boost hands over as it stands.
po::value_semantic* text_value(const std::string& name) {
  return po::value<std::string>()->value_name(name);
}

/// Everything that may stand on a command line besides the command and its arguments.
po::options_description known_options() {
  po::options_description options;
  for (const ProgramOption& option : program_options()) {
    if (option.value_name.empty()) {
      options.add_options()(option.name.c_str(), "");
    } else {
      options.add_options()(option.name.c_str(), text_value(option.value_name));
    }
  }
  for (const ConfigurationKey& key : configuration_keys()) {
    options.add_options()(key.name.c_str(), text_value(value_name(key)));
  }
  return options;
}

/// The command and the names of its arguments.
std::vector<std::string> usage_words(const Command& command) {
  std::vector<std::string> words{command.name};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  return words;
}

/// @param option  with its two dashes
[[noreturn]] void refuse_missing_value(const std::string& option) {
  const auto& keys = configuration_keys();
  const auto key = std::ranges::find(keys, option.substr(2), &ConfigurationKey::name);
  if (key != keys.end()) throw InputError(key->name, one_line(""), key->allowed());
  throw InputError(option, one_line(""), "a value must follow");
}

[[noreturn]] void refuse_unknown(const std::string& option,
                                 const po::options_description& options) {
  std::vector<std::string> names;
  for (const auto& known : options.options()) names.push_back(known->long_name());
  const std::string shown = one_line(option);
  std::string_view word = std::string_view(shown).substr(0, shown.find('='));
  while (word.starts_with('-')) word.remove_prefix(1);
  throw InputError(
      "command line", shown,
      fmt::format("unknown option{}", suggestion(word, names, "; nlcwfs manual lists all", "--")));
}

std::vector<po::option> parse_options(int argc, const char* const* argv,
                                      const po::options_description& options) {
  try {
    using namespace po::command_line_style;
    return po::command_line_parser(argc, argv)
        .options(options)
        .style(allow_long | long_allow_next | long_allow_adjacent)
        .run()
        .options;
  } catch (const po::unknown_option& error) {
    refuse_unknown(error.get_option_name(), options);
  } catch (const po::invalid_command_line_syntax& error) {
    if (error.kind() == po::invalid_syntax::extra_parameter) {
      throw InputError("command line", error.get_option_name(), "takes no value");
    }
    refuse_missing_value(error.get_option_name());
  }
}

/// Reads what is no option: the command, then its arguments.
void parse_positional(const std::string& value, CommandLine& result,
                      const po::options_description& options) {
  if (value == "-h" || (value == "help" && result.command.empty())) {
    result.help = true;
    return;
  }
  if (value.size() > 1 && value[0] == '-' && value[1] >= '0' && value[1] <= '9') {
    throw InputError("command line", one_line(value),
                     "values are one word, separated by commas, as in "
                     "--sensor.planes=-180km,180km");
  }
  if (value.starts_with('-')) refuse_unknown(value, options);
  if (!result.command.empty()) {
    const Command& command = command_of(result.command);
    if (result.arguments.size() == command.arguments.size()) {
      throw InputError("command line", one_line(value),
                       fmt::format("nothing may follow the command {} but options; a value is one "
                                   "word, such as 0.5m or -47km,47km",
                                   fmt::join(usage_words(command), " ")));
    }
    if (value.empty()) {
      throw InputError(
          command.arguments[result.arguments.size()], one_line(""),
          fmt::format("must not be empty: nlcwfs {}", fmt::join(usage_words(command), " ")));
    }
    result.arguments.push_back(value);
    return;
  }
  const auto names = command_names();
  if (std::ranges::count(names, value) == 0) {
    const std::string shown = one_line(value);
    throw InputError("command line", shown,
                     fmt::format("no command of nlcwfs, which has {}{}", fmt::join(names, ", "),
                                 suggestion(shown, names, "; nlcwfs --help explains them")));
  }
  result.command = value;
}

/// @throws InputError where the command or its arguments are missing, or it has no such flag
void require_whole_command(const CommandLine& command_line) {
  if (command_line.command.empty()) {
    throw InputError("command line", one_line(""),
                     fmt::format("a command must stand there, one of {}; nlcwfs --help explains "
                                 "them",
                                 fmt::join(command_names(), ", ")));
  }
  const Command& command = command_of(command_line.command);
  if (command_line.verify && command.name != "advise") {
    throw InputError("command line", "--verify",
                     fmt::format("only advise takes it; leave it away with {}", command.name));
  }
  const std::size_t given = command_line.arguments.size();
  if (given == command.arguments.size() || command_line.dump_config) return;
  throw InputError(
      "command line", given == 0 ? one_line("") : one_line(command_line.arguments[0]),
      fmt::format("{} must follow {}: nlcwfs {}", fmt::join(command.arguments, " and "),
                  command.name, fmt::join(usage_words(command), " ")));
}

/// Refuses a folder whose archive a command cannot go on with.
void require_archive_of(const Command& command, const std::filesystem::path& folder) {
  const std::string shown = one_line(folder.string());
  std::string begun_by;
  try {
    const Archive archive = Archive::reopened(folder / "archive.sqlite");
    if (archive.has_trials()) begun_by = archive.command();
  } catch (const std::runtime_error& error) {
    throw InputError("--resume", shown,
                     fmt::format("its archive cannot be gone on with: {}", one_line(error.what())));
  }
  if (begun_by == command.name) return;
  throw InputError("--resume", shown,
                   begun_by.empty()
                       ? fmt::format("an older version of nlcwfs has begun it; begin it anew with "
                                     "--config {}",
                                     one_line((folder / "config.cfg").string()))
                       : fmt::format("is a run of {}; name the folder of an interrupted {}",
                                     begun_by, command.name));
}

/// Refuses a folder that has no trials to take over.
void require_trials(const Command& command, const std::filesystem::path& folder) {
  const std::string shown = one_line(folder.string());
  if (!command.resumable || command.name == "reproduce") {
    throw InputError("--reuse", shown,
                     fmt::format("{} keeps no trials; leave it away", command.name));
  }
  if (!std::filesystem::is_regular_file(folder / "archive.sqlite")) {
    throw InputError("--reuse", shown, "has no archive.sqlite; name the folder of a run");
  }
  try {
    if (Archive::reopened(folder / "archive.sqlite").has_trials()) return;
  } catch (const std::runtime_error& error) {
    throw InputError("--reuse", shown,
                     fmt::format("its archive cannot be used: {}", one_line(error.what())));
  }
  throw InputError("--reuse", shown, "its archive is of an older version, which kept no trials");
}

/// The configuration of the run to go on with.
/// @param configuring  the options that the command line has besides and must not have
Configuration resumed_configuration(const CommandLine& command_line,
                                    const std::vector<std::string>& configuring) {
  const std::filesystem::path& folder = *command_line.resume;
  const std::string shown = one_line(folder.string());
  const Command& command = command_of(command_line.command);
  if (!command.resumable) {
    throw InputError("--resume", shown,
                     fmt::format("{} cannot go on with a run; begin it anew with --config {}",
                                 command.name, one_line((folder / "config.cfg").string())));
  }
  if (!std::filesystem::is_directory(folder)) {
    throw InputError("--resume", shown, "there is no such folder; name that of an interrupted run");
  }
  if (!std::filesystem::is_regular_file(folder / "config.cfg") ||
      !std::filesystem::is_regular_file(folder / "archive.sqlite")) {
    throw InputError("--resume", shown,
                     "has no config.cfg and archive.sqlite; name the folder of an interrupted run, "
                     "or remove one that was ended before it had them");
  }
  if (!configuring.empty()) {
    throw InputError(
        "--resume", shown,
        fmt::format("goes on in that folder as its config.cfg says; leave away {}, "
                    "nothing may be with it but --reuse, --threads, --quiet and --log-level",
                    fmt::join(configuring, ", ")));
  }
  require_archive_of(command, folder);
  Configuration configuration;
  configuration.read_file(folder / "config.cfg");
  return configuration;
}

LogLevel parse_log_level(const std::string& value) {
  static const std::map<std::string, LogLevel> levels{{"error", LogLevel::error},
                                                      {"warning", LogLevel::warning},
                                                      {"info", LogLevel::info},
                                                      {"debug", LogLevel::debug}};
  const auto level = levels.find(value);
  if (level == levels.end()) {
    throw InputError("--log-level", one_line(value), "one of error, warning, info, debug");
  }
  return level->second;
}

/// An option of one command that stands for a key of the configuration.
struct ShortForm {
  std::string option;
  std::string command;
  std::string key;
};

const std::vector<ShortForm> short_forms{{"figure", "reproduce", "reproduce.figures"},
                                         {"frames", "reconstruct", "frames.file"}};

int parse_threads(const std::string& value) {
  const auto threads = parse_integer(value);
  if (!threads || *threads < 0 || *threads > 4096) {
    throw InputError("--threads", one_line(value), "a whole number from 0 (all cores) to 4096");
  }
  return *threads;
}

/// What the words of a command line say, one after the other, and then together.
class CommandLineReader {
 public:
  CommandLine read(int argc, const char* const* argv);

 private:
  void take(const po::option& option);
  void take_value(const std::string& key, const std::string& value);
  /// Makes values of the options that stand for keys.
  void resolve_short_forms();
  void configure();

  po::options_description known_ = known_options();
  CommandLine result_;
  std::optional<std::string> preset_;
  std::vector<std::string> files_;
  std::map<std::string, std::vector<std::string>> short_values_;
  std::vector<std::pair<std::string, std::string>> values_;
  std::set<std::string> seen_;
};

void CommandLineReader::take(const po::option& option) {
  static const std::map<std::string, bool CommandLine::*> flags{
      {"verify", &CommandLine::verify},
      {"help", &CommandLine::help},
      {"version", &CommandLine::version},
      {"dump-config", &CommandLine::dump_config}};
  const std::string& key = option.string_key;
  const std::string value = option.value.empty() ? "" : option.value.front();
  if (option.position_key >= 0) {
    parse_positional(value, result_, known_);
    return;
  }
  if (!seen_.insert(key).second && key != "config" && key != "figure") {
    throw InputError("command line",
                     one_line(fmt::format("{}", fmt::join(option.original_tokens, " "))),
                     "given twice; keep one of them");
  }
  const auto flag = flags.find(key);
  if (flag != flags.end()) {
    result_.*flag->second = true;
  } else if (key == "quiet") {
    result_.log_level = LogLevel::warning;
  } else if (value.empty() || value.starts_with("--")) {
    refuse_missing_value("--" + key);
  } else {
    take_value(key, value);
  }
}

void CommandLineReader::take_value(const std::string& key, const std::string& value) {
  if (key == "config") {
    files_.push_back(value);
  } else if (std::ranges::count(short_forms, key, &ShortForm::option) > 0) {
    short_values_[key].push_back(value);
  } else if (key == "preset") {
    preset_ = value;
  } else if (key == "output") {
    if (std::ranges::any_of(value, is_control)) {
      throw InputError("--output", one_line(value), "a path of printable characters");
    }
    result_.output = value;
  } else if (key == "resume") {
    result_.resume = value;
  } else if (key == "reuse") {
    result_.reuse = value;
  } else if (key == "log-level") {
    result_.log_level = parse_log_level(value);
  } else if (key == "threads") {
    result_.threads = parse_threads(value);
  } else {
    values_.emplace_back(key, value);
  }
}

void CommandLineReader::resolve_short_forms() {
  for (const ShortForm& form : short_forms) {
    if (!short_values_.contains(form.option)) continue;
    const std::string list = fmt::format("{}", fmt::join(short_values_[form.option], ","));
    const std::string shown = one_line(fmt::format("--{} {}", form.option, list));
    if (result_.command != form.command) {
      throw InputError(
          "command line", shown,
          fmt::format("only {} takes it; leave it away with {}", form.command, result_.command));
    }
    if (seen_.contains(form.key)) {
      throw InputError("command line", shown,
                       fmt::format("{} is given too; keep one of them", form.key));
    }
    values_.emplace_back(form.key, list);
  }
}

void CommandLineReader::configure() {
  if (result_.resume) {
    std::vector<std::string> configuring;
    if (preset_) configuring.emplace_back("--preset");
    if (!files_.empty()) configuring.emplace_back("--config");
    if (result_.output) configuring.emplace_back("--output");
    for (const auto& [key, value] : values_) configuring.push_back("--" + key);
    result_.configuration = resumed_configuration(result_, configuring);
    return;
  }
  if (preset_) result_.configuration.apply_preset(*preset_);
  for (const std::string& file : files_) result_.configuration.read_file(file);
  for (const auto& [key, value] : values_) {
    result_.configuration.set(key, value, "on the command line");
  }
}

CommandLine CommandLineReader::read(int argc, const char* const* argv) {
  for (const po::option& option : parse_options(argc, argv, known_)) take(option);
  if (seen_.contains("quiet") && seen_.contains("log-level")) {
    throw InputError("command line", "--quiet",
                     "is the same as --log-level warning; keep one of them");
  }
  if (result_.help || result_.version) return std::move(result_);
  require_whole_command(result_);
  resolve_short_forms();
  if (result_.reuse) require_trials(command_of(result_.command), *result_.reuse);
  configure();
  return std::move(result_);
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  return CommandLineReader().read(argc, argv);
}

}  // namespace nlcwfs
