// manual: The manual page nlcwfs(1).
#include "studies/command_line/manual_page.hpp"

#include "studies/command_line/help_text.hpp"
#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/run/command.hpp"
#include "studies/run/request.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/configuration.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// Of a line, whose escapes make it longer.
constexpr std::size_t columns = 64;

/// Text that roff shows as it stands: its escape character, the minus sign that would become a
/// hyphen, and the characters that make a request of a line that begins with them.
std::string escaped(std::string_view text) {
  std::string escaped;
  if (text.starts_with('.') || text.starts_with('\'')) escaped = "\\&";
  for (const char character : text) {
    switch (character) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      default:
        escaped += character;
    }
  }
  return escaped;
}

/// Lines as roff wants them: each sentence begins one, so that it decides on the space before, and
/// none is long.
std::string sentences(std::string_view text) {
  std::string lines;
  while (true) {
    const auto end = text.find(". ");
    const std::string_view sentence = text.substr(0, end == std::string_view::npos ? end : end + 1);
    for (const std::string& line : wrapped(sentence, columns)) lines += escaped(line) + '\n';
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 2);
  }
}

std::string section(std::string_view heading) { return fmt::format(".SH {}\n", heading); }

/// A bold word, names of values in italics, and below it its text.
std::string entry(std::string_view word, std::string_view values, std::string_view text) {
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}", escaped(word),
                     values.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(values)),
                     sentences(text));
}

std::string example(std::string_view request) {
  std::string lines;
  for (const std::string& line : example_lines(request, columns)) {
    lines += (lines.empty() ? "    " : " \\e\n        ") + escaped(line);
  }
  return fmt::format(".nf\n{}\n.fi\n", lines);
}

std::string commands_text() {
  std::string text = section("COMMANDS");
  std::string_view group;
  for (const Command& command : commands()) {
    if (command.group != group) text += fmt::format(".SS {}\n", escaped(command.group));
    group = command.group;
    std::vector<std::string> arguments;
    for (const CommandArgument& argument : command.arguments) arguments.push_back(argument.name);
    text += entry(command.name, fmt::format("{}", fmt::join(arguments, " ")),
                  fmt::format("{}. {}", with_capital(command.description), command.about));
  }
  return text;
}

std::string options_text() {
  std::string text = section("OPTIONS");
  for (const ProgramOption& option : program_options()) {
    text += entry("--" + option.name, option.value_name, with_takers(option));
  }
  return text;
}

/// What a key means, allows and is by default, and which commands read it.
std::string keys_text() {
  std::string text =
      section("KEYS") +
      sentences(
          "Every key stands on the command line as --section.key VALUE or in a file as key = VALUE "
          "below the line [section], where # starts a comment. The command line overrides files, "
          "of which the later overrides the earlier, and files override the preset.");
  std::string_view current;
  for (const ConfigurationKey& key : configuration_keys()) {
    const std::string_view name = std::string_view(key.name).substr(0, key.name.find('.'));
    if (name != current) text += fmt::format(".SS {}\n", name);
    current = name;
    std::string meaning = fmt::format("{} Allowed: {}.", key.description, key.allowed());
    meaning +=
        fmt::format(" Default: {}.", key.default_text.empty() ? "not set" : key.default_text);
    std::vector<std::string> readers;
    for (const Command& command : commands()) {
      if (command.reads(key.name)) readers.push_back(command.name);
    }
    meaning += fmt::format(" Read by {}.", fmt::join(readers, ", "));
    text += entry("--" + key.name, value_name(key), meaning);
  }
  return text;
}

std::string examples_text() {
  std::vector<std::string> examples;
  for (const Command& command : commands()) {
    for (const std::string& line : command.examples) examples.push_back(example(line));
  }
  return section("EXAMPLES") + fmt::format("{}", fmt::join(examples, ".PP\n"));
}

}  // namespace

std::string manual_page() {
  return fmt::format(".TH NLCWFS 1 \"{}\" \"nlcwfs {}\" \"User Commands\"\n", NLCWFS_VERSION_DATE,
                     version()) +
         section("NAME") + "nlcwfs \\- design nonlinear curvature wavefront sensors\n" +
         section("SYNOPSIS") +
         ".B nlcwfs\n.I command\n"
         ".RB [ \\-\\-preset\n.IR NAME ]\n.RB [ \\-\\-config\n.IR FILE ]...\n"
         ".RB [ \\-\\-section.key\n.IR VALUE ]...\n.RI [ option ]...\n" +
         section("DESCRIPTION") +
         sentences(
             "nlcwfs finds by simulation where the defocused planes of a telescope's nonlinear "
             "curvature wavefront sensor stand best, how many they are and in which order they are "
             "read, and proves the result on fresh phase screens. It follows Letchev, Crass, Crepp "
             "& Potier (2022). Lengths may be written in nm, um, mm, cm, m or km, times in us, ms, "
             "s, min or h; without a unit they are in m and s. Lists are separated by commas.") +
         commands_text() + options_text() + keys_text() + section("FILES") +
         sentences(
             "A run writes into a folder of its own, results/<command>-<n> or --output DIR, and "
             "never overwrites one. Every run leaves these, and the tables and pictures of its "
             "command.") +
         entry("summary.json", "", "The result.") +
         entry("config.cfg", "", "All keys, which repeat the run with --config.") +
         entry("archive.sqlite", "", "Every evaluated design.") + section("\"EXIT STATUS\"") +
         entry("0", "", "The run is done.") + entry("1", "", "The run failed.") +
         entry("2", "",
               "Bad input: one line on standard error names the key, the value, what is "
               "allowed and the fix.") +
         entry("3", "",
               "Interrupted with Ctrl-C or SIGTERM, or where the best design failed in the scan of "
               "how far its variables may move: what was done until then is in the folder.") +
         examples_text();
}

namespace {

void run_manual(const Request& /*request*/) { fmt::print("{}", manual_page()); }

}  // namespace

Command manual_command() {
  return {.name = "manual",
          .group = "The paper and this machine",
          .description = "print the manual page, nlcwfs(1)",
          .about =
              "It has every command, option and key on one page. An installed nlcwfs has it as "
              "man nlcwfs.",
          .keys = {},
          .examples = {"nlcwfs manual | man -l -"},
          .run = run_manual};
}

}  // namespace nlcwfs
