// The words of a command line become a request.
#include "studies/command_line/command_line.hpp"

#include "model/input_error.hpp"
#include "results/archive/archive.hpp"
#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
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
  for (const CommandArgument& argument : command.arguments) words.push_back(argument.name);
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
void parse_positional(const std::string& value, Request& result,
                      const po::options_description& options) {
  if (value == "-h" || (value == "help" && result.command == nullptr)) {
    result.help = true;
    return;
  }
  if (value.size() > 1 && value[0] == '-' && value[1] >= '0' && value[1] <= '9') {
    throw InputError("command line", one_line(value),
                     "values are one word, separated by commas, as in "
                     "--sensor.planes=-180km,180km");
  }
  if (value.starts_with('-')) refuse_unknown(value, options);
  if (result.command != nullptr) {
    const Command& command = *result.command;
    if (result.arguments.size() == command.arguments.size()) {
      throw InputError("command line", one_line(value),
                       fmt::format("nothing may follow the command {} but options; a value is one "
                                   "word, such as 0.5m or -47km,47km",
                                   fmt::join(usage_words(command), " ")));
    }
    if (value.empty()) {
      throw InputError(
          command.arguments[result.arguments.size()].name, one_line(""),
          fmt::format("must not be empty: nlcwfs {}", fmt::join(usage_words(command), " ")));
    }
    result.arguments.push_back(value);
    return;
  }
  result.command = find_command(value);
  if (result.command == nullptr) {
    const std::vector<std::string> names = command_names();
    const std::string shown = one_line(value);
    throw InputError("command line", shown,
                     fmt::format("no command of nlcwfs, which has {}{}", fmt::join(names, ", "),
                                 suggestion(shown, names, "; nlcwfs --help explains them")));
  }
}

/// @throws InputError where the command or its arguments are missing
void require_whole_command(const Request& request) {
  if (request.command == nullptr) {
    throw InputError("command line", one_line(""),
                     fmt::format("a command must stand there, one of {}; nlcwfs --help explains "
                                 "them",
                                 fmt::join(command_names(), ", ")));
  }
  const Command& command = *request.command;
  const std::size_t given = request.arguments.size();
  if (given == command.arguments.size() || request.dump_config) return;
  const std::vector<std::string> words = usage_words(command);
  throw InputError("command line", given == 0 ? one_line("") : one_line(request.arguments[0]),
                   fmt::format("{} must follow {}: nlcwfs {}",
                               fmt::join(words.begin() + 1, words.end(), " and "), command.name,
                               fmt::join(words, " ")));
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
  if (command.resumption != Resumption::by_trials) {
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
Configuration resumed_configuration(const Request& request,
                                    const std::vector<std::string>& configuring) {
  const std::filesystem::path& folder = *request.resume;
  const std::string shown = one_line(folder.string());
  const Command& command = *request.command;
  if (command.resumption == Resumption::none) {
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
  Request read(int argc, const char* const* argv);

 private:
  void take(const po::option& option);
  void take_value(const std::string& key, const std::string& value);
  /// Takes the options of the command alone: flags, and values for keys.
  void take_own_options();
  void configure();

  po::options_description known_ = known_options();
  Request result_;
  std::optional<std::string> preset_;
  std::vector<std::string> files_;
  std::map<std::string, std::vector<std::string>> own_values_;
  std::vector<std::pair<std::string, std::string>> values_;
  std::set<std::string> seen_;
};

void CommandLineReader::take(const po::option& option) {
  static const std::map<std::string, bool Request::*> flags{{"help", &Request::help},
                                                            {"version", &Request::version},
                                                            {"dump-config", &Request::dump_config}};
  const std::string& key = option.string_key;
  const std::string value = option.value.empty() ? "" : option.value.front();
  if (option.position_key >= 0) {
    parse_positional(value, result_, known_);
    return;
  }
  const ProgramOption* known = find_program_option(key);
  if (!seen_.insert(key).second && !(known != nullptr && known->repeats)) {
    throw InputError("command line",
                     one_line(fmt::format("{}", fmt::join(option.original_tokens, " "))),
                     "given twice; keep one of them");
  }
  const auto flag = flags.find(key);
  if (flag != flags.end()) {
    result_.*flag->second = true;
  } else if (key == "quiet") {
    result_.log_level = LogLevel::warning;
  } else if (known != nullptr && known->value_name.empty()) {
    own_values_[key];
  } else if (value.empty() || value.starts_with("--")) {
    refuse_missing_value("--" + key);
  } else {
    take_value(key, value);
  }
}

void CommandLineReader::take_value(const std::string& key, const std::string& value) {
  if (key == "config") {
    files_.push_back(value);
  } else if (const auto* known = find_program_option(key); known && known->command) {
    own_values_[key].push_back(value);
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

void CommandLineReader::take_own_options() {
  for (const auto& [name, values] : own_values_) {
    const ProgramOption& option = *find_program_option(name);
    const std::string list = fmt::format("{}", fmt::join(values, ","));
    const std::string shown =
        one_line(fmt::format("--{}{}{}", name, list.empty() ? "" : " ", list));
    if (option.command != result_.command) {
      throw InputError("command line", shown,
                       fmt::format("only {} takes it; leave it away with {}", option.command->name,
                                   result_.command->name));
    }
    if (option.key.empty()) {
      result_.flags.insert(name);
      continue;
    }
    if (seen_.contains(option.key)) {
      throw InputError("command line", shown,
                       fmt::format("{} is given too; keep one of them", option.key));
    }
    values_.emplace_back(option.key, list);
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

Request CommandLineReader::read(int argc, const char* const* argv) {
  for (const po::option& option : parse_options(argc, argv, known_)) take(option);
  if (seen_.contains("quiet") && seen_.contains("log-level")) {
    throw InputError("command line", "--quiet",
                     "is the same as --log-level warning; keep one of them");
  }
  if (result_.help || result_.version) return std::move(result_);
  require_whole_command(result_);
  take_own_options();
  if (result_.reuse) require_trials(*result_.command, *result_.reuse);
  configure();
  return std::move(result_);
}

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  return CommandLineReader().read(argc, argv);
}

}  // namespace nlcwfs
