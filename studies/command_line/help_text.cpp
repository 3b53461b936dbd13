// The help of the program and of each command.
#include "studies/command_line/help_text.hpp"

#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/settings/configuration.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr std::size_t columns = 100;
/// Where the texts beside options and keys begin.
constexpr std::size_t option_column = 24;
constexpr std::size_t key_column = 49;

/// "--output DIR", "--quiet".
std::string option_words(const ProgramOption& option) {
  return option.value_name.empty() ? fmt::format("--{}", option.name)
                                   : fmt::format("--{} {}", option.name, option.value_name);
}

/// A word and its text beside it, from `column` on; below it where the word is too long.
std::string entry(const std::string& word, const std::string& text, std::size_t column) {
  std::string entry = fmt::format("  {:<{}}", word, column - 2);
  if (word.size() + 3 > column) entry = fmt::format("  {}\n{:{}}", word, "", column);
  bool is_first = true;
  for (const std::string& line : wrapped(text, columns - column)) {
    if (!is_first) entry += std::string(column, ' ');
    entry += line + '\n';
    is_first = false;
  }
  return entry;
}

std::string option_entry(const ProgramOption& option, const std::string& text) {
  return entry(option_words(option), text, option_column);
}

std::string all_options_text() {
  std::string text = "Options:\n";
  for (const ProgramOption& option : program_options()) {
    text += option_entry(option, with_takers(option));
  }
  return text;
}

std::string options_text(const Command& command) {
  std::string text = "Options:\n";
  for (const ProgramOption& option : program_options()) {
    if (option.is_of(command)) text += option_entry(option, option.description);
  }
  return text;
}

/// What a key means, its unit, its words and its default.
std::string key_text(const ConfigurationKey& key) {
  std::string text = key.description;
  if (!key.unit.empty()) text += fmt::format(" In {}.", key.unit);
  if (key.kind == Kind::choice || key.element == Kind::choice)
    text += fmt::format(" {}.", fmt::join(key.choices, " | "));
  const std::string bounds = key.bounds_text();
  if (!bounds.empty()) text += fmt::format(" Allowed: {}.", bounds);
  if (!key.default_text.empty()) text += fmt::format(" [{}]", key.default_text);
  return text;
}

/// A heading for each section, then its keys that the command reads.
std::string keys_text(const Command& command) {
  std::string text;
  std::string_view current_section;
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!command.reads(key.name)) continue;
    const std::string_view section = std::string_view(key.name).substr(0, key.name.find('.'));
    if (section != current_section) text += fmt::format("\n{}:\n", section);
    current_section = section;
    text += entry(fmt::format("--{} {}", key.name, value_name(key)), key_text(key), key_column);
  }
  return text;
}

std::string paragraph(const std::string& text) {
  return fmt::format("{}\n", fmt::join(wrapped(text, columns), "\n"));
}

/// What the names of values stand for that do not tell it themselves.
std::string values_text(const Command& command) {
  const auto reads = [&](std::string_view name) {
    return std::ranges::any_of(configuration_keys(), [&](const ConfigurationKey& key) {
      return command.reads(key.name) && value_name(key) == name;
    });
  };
  std::string text;
  if (reads("RANGE")) text += " RANGE is MIN:MAX, MIN:MAX:log or a list a,b,c.";
  if (reads("GRID")) text += " GRID is MIN:MAX:N, MIN:MAX:N:log or a list a,b,c.";
  if (reads("WORDS")) text += " WORDS are one or more words, separated by commas.";
  return text;
}

/// "nlcwfs compare SWEEP OPTIMIZE".
std::string usage_line(const Command& command) {
  std::string words = "nlcwfs " + command.name;
  for (const CommandArgument& argument : command.arguments) words += ' ' + argument.name;
  return words;
}

}  // namespace

std::string program_help() {
  std::string text =
      "Usage: nlcwfs <command> [--preset NAME] [--config FILE]... [--section.key VALUE]...\n"
      "              [--output DIR] [--threads N] [--quiet]\n\n";
  text += paragraph(
      "Designs nonlinear curvature wavefront sensors: finds by simulation where the defocused "
      "planes of a telescope's sensor stand best, and proves it on fresh phase screens.");
  std::string_view current_group;
  for (const Command& command : commands()) {
    if (command.group != current_group) text += fmt::format("\n{}:\n", command.group);
    current_group = command.group;
    text += entry(command.name, command.description, 15);
  }
  text += '\n' + all_options_text() + '\n';
  text += paragraph(
      "nlcwfs <command> --help explains a command and the keys that it reads. Every key can stand "
      "on the command line or in a file of [section] and key = value lines; --dump-config writes "
      "such a file with all keys. The command line overrides files, files override the preset.");
  text += "\nFor a start:\n";
  for (const Command& command : commands()) {
    if (command.is_for_a_start) text += fmt::format("  {}\n", command.examples.front());
  }
  return text;
}

std::string command_help(const Command& command) {
  std::string text = fmt::format("Usage: {} [OPTION]...\n\n{}.\n\n", usage_line(command),
                                 with_capital(command.description));
  text += paragraph(command.about) + "\nExamples:\n";
  for (const std::string& example : command.examples) {
    text += fmt::format("  {}\n", fmt::join(example_lines(example, columns - 6), " \\\n      "));
  }
  text += '\n' + options_text(command);
  if (command.keys.empty()) return text;
  text +=
      '\n' + paragraph(
                 "Keys that it reads [default], here or in a file of [section] and key = value "
                 "lines, where # starts a comment. The command line overrides files, files "
                 "override the preset. Lengths may be written in nm, um, mm, cm, m or km, times "
                 "in us, ms, s, min or h; without a unit they are in m and s." +
                 values_text(command));
  return text + keys_text(command);
}

std::vector<std::string> example_lines(std::string_view example, std::size_t width) {
  constexpr std::string_view option = " --";
  std::vector<std::string> lines(1);
  while (!example.empty()) {
    const std::string_view part = example.substr(0, example.find(option, 1));
    if (lines.back().empty() || lines.back().size() + part.size() <= width) {
      lines.back() += part;
    } else {
      lines.emplace_back(part.substr(1));
    }
    example.remove_prefix(part.size());
  }
  return lines;
}

std::string with_takers(const ProgramOption& option) {
  std::vector<std::string> takers;
  for (const Command& command : commands()) {
    if (option.is_of(command)) takers.push_back(command.name);
  }
  if (takers.size() > commands().size() / 2) return option.description;
  return fmt::format("{}: {}", fmt::join(takers, ", "), option.description);
}

std::string with_capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() += 'A' - 'a';
  return text;
}

}  // namespace nlcwfs
