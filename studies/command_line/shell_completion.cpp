// completion: What lets a shell complete commands, keys and their words.
#include "studies/command_line/shell_completion.hpp"

#include "model/input_error.hpp"
#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/run/command.hpp"
#include "studies/run/request.hpp"
#include "studies/settings/configuration.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// An option or key with what may follow it.
struct Completed {
  std::string name;                  ///< without its two dashes
  std::string description;           ///< one line
  bool has_value;                    ///< otherwise a flag
  std::vector<std::string> choices;  ///< words that may follow; empty where others may
  bool is_file;                      ///< whether the name of a file follows
  bool is_folder;                    ///< whether the name of a folder follows
};

std::vector<Completed> completed_options() {
  std::vector<Completed> all;
  for (const ProgramOption& option : program_options()) {
    all.push_back({.name = option.name,
                   .description = option.description,
                   .has_value = !option.value_name.empty(),
                   .choices = option.choices,
                   .is_file = option.value_name == "FILE",
                   .is_folder = option.value_name == "DIR"});
  }
  for (const ConfigurationKey& key : configuration_keys()) {
    all.push_back({.name = key.name,
                   .description = key.description,
                   .has_value = true,
                   .choices = key.choices,
                   .is_file = key.is_file,
                   .is_folder = false});
  }
  return all;
}

/// The options and keys that a command takes; with nothing the options that all take.
std::vector<std::string> words_of(const Command* command) {
  std::vector<std::string> words;
  for (const ProgramOption& option : program_options()) {
    const auto is_of = [&](const Command& known) { return option.is_of(known); };
    if (command == nullptr ? std::ranges::all_of(commands(), is_of) : option.is_of(*command)) {
      words.push_back("--" + option.name);
    }
  }
  if (command == nullptr) return words;
  for (const ConfigurationKey& key : configuration_keys()) {
    if (command->reads(key.name)) words.push_back("--" + key.name);
  }
  return words;
}

std::string first_comment(std::string_view shell) {
  return fmt::format("# Completion of nlcwfs for {0}, made by nlcwfs completion {0}.\n", shell);
}

/// Patterns of a case for names that have the same candidates, or nothing where there are none.
template <class Filter>
std::string patterns(const Filter& filter) {
  std::vector<std::string> names;
  for (const Completed& option : completed_options()) {
    if (filter(option)) names.push_back("--" + option.name);
  }
  return fmt::format("{}", fmt::join(names, "|"));
}

/// Sets the candidates in the variable `candidates` and asks for names of files or folders by the
/// variable `names`: the same for bash and for zsh, whose syntax this is in both. It reads the
/// variables `command`, `before` (the word before) and `current`.
std::string candidates() {
  std::string text = "  case $before in\n";
  for (const Completed& option : completed_options()) {
    if (option.choices.empty()) continue;
    text += fmt::format("    --{}) candidates='{}'; return ;;\n", option.name,
                        fmt::join(option.choices, " "));
  }
  text += fmt::format("    {}) names=files; return ;;\n",
                      patterns([](const Completed& option) { return option.is_file; }));
  text += fmt::format("    {}) names=folders; return ;;\n",
                      patterns([](const Completed& option) { return option.is_folder; }));
  text += fmt::format("    {}) ;;\n",
                      patterns([](const Completed& option) { return !option.has_value; }));
  text += "    --*) return ;;\n  esac\n";
  text += "  case $command:$current in\n";
  for (const Command& command : commands()) {
    text += fmt::format("    {}:-*) candidates='{}' ;;\n", command.name,
                        fmt::join(words_of(&command), " "));
    // All arguments of a command are of one kind.
    if (command.arguments.empty()) continue;
    const std::vector<std::string>& choices = command.arguments.front().choices;
    text += choices.empty() ? fmt::format("    {}:*) names=folders ;;\n", command.name)
                            : fmt::format("    {}:*) candidates='{}' ;;\n", command.name,
                                          fmt::join(choices, " "));
  }
  text += fmt::format("    :-*) candidates='{}' ;;\n", fmt::join(words_of(nullptr), " "));
  text += fmt::format("    :*) candidates='{}' ;;\n  esac\n", fmt::join(command_names(), " "));
  return text;
}

std::string bash_completion() {
  return first_comment("bash") +
         // Bash breaks --key=value into three words.
         "_nlcwfs_candidates() {\n" + candidates() +
         "}\n\n_nlcwfs() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command= candidates= names= word\n"
         "  if [[ $current == = ]]; then\n    current=\n"
         "  elif [[ $before == = ]]; then\n    before=${COMP_WORDS[COMP_CWORD-2]}\n  fi\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case $word in\n      " +
         fmt::format("{}", fmt::join(command_names(), "|")) +
         ") command=$word; break ;;\n    esac\n  done\n"
         "  COMPREPLY=()\n"
         "  _nlcwfs_candidates\n"
         "  case $names in\n"
         "    files) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$current\") "
         ";;\n"
         "    folders) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$current\") "
         ";;\n"
         "    *) mapfile -t COMPREPLY < <(compgen -W \"$candidates\" -- \"$current\") ;;\n"
         "  esac\n"
         "}\n\ncomplete -F _nlcwfs nlcwfs\n";
}

std::string zsh_completion() {
  return "#compdef nlcwfs\n" + first_comment("zsh") + "_nlcwfs_candidates() {\n" + candidates() +
         "}\n\n_nlcwfs() {\n"
         "  local current=$words[CURRENT] before=$words[CURRENT-1] command= names= word\n"
         "  if [[ $current == --*=* ]]; then\n"
         "    before=${current%%=*} current=${current#*=}\n    compset -P '*='\n  fi\n"
         "  for word in ${words[2,CURRENT-1]}; do\n"
         "    case $word in\n      " +
         fmt::format("{}", fmt::join(command_names(), "|")) +
         ") command=$word; break ;;\n    esac\n  done\n"
         "  _nlcwfs_candidates\n"
         "  case $names in\n"
         "    files) _files ;;\n"
         "    folders) _files -/ ;;\n"
         "    *) compadd -- ${=candidates} ;;\n"
         "  esac\n"
         "}\n\n"
         "if [[ $funcstack[1] == _nlcwfs ]]; then _nlcwfs; else compdef _nlcwfs nlcwfs; fi\n";
}

/// Text in single quotes for fish.
std::string in_quotes(std::string_view text) {
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\'' || character == '\\') quoted += '\\';
    quoted += character;
  }
  return quoted + "'";
}

std::string fish_completion() {
  std::string text = first_comment("fish") + "complete -c nlcwfs -f\n";
  for (const Command& command : commands()) {
    text += fmt::format("complete -c nlcwfs -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        in_quotes(command.description));
    if (!command.arguments.empty()) {
      const std::vector<std::string>& choices = command.arguments.front().choices;
      text += fmt::format("complete -c nlcwfs -n '__fish_seen_subcommand_from {}' -a '{}'\n",
                          command.name,
                          choices.empty() ? "(__fish_complete_directories)"
                                          : fmt::format("{}", fmt::join(choices, " ")));
    }
  }
  for (const Completed& option : completed_options()) {
    std::vector<std::string> takers;
    for (const Command& command : commands()) {
      if (std::ranges::count(words_of(&command), "--" + option.name) > 0) {
        takers.push_back(command.name);
      }
    }
    const std::string condition =
        takers.empty() || takers.size() == commands().size()
            ? ""
            : fmt::format(" -n '__fish_seen_subcommand_from {}'", fmt::join(takers, " "));
    text += fmt::format("complete -c nlcwfs{} -l {} -d {}", condition, option.name,
                        in_quotes(option.description));
    if (!option.choices.empty()) {
      text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
    } else if (option.is_folder) {
      text += " -x -a '(__fish_complete_directories)'";
    } else if (option.has_value) {
      text += option.is_file ? " -r -F" : " -x";
    }
    text += '\n';
  }
  return text;
}

}  // namespace

const std::vector<std::string>& completed_shells() {
  static const std::vector<std::string> shells{"bash", "zsh", "fish"};
  return shells;
}

std::string shell_completion(std::string_view shell) {
  assert(std::ranges::count(completed_shells(), shell) == 1);
  if (shell == "bash") return bash_completion();
  if (shell == "zsh") return zsh_completion();
  return fish_completion();
}

namespace {

void run_completion(const Request& request) {
  const std::string& shell = request.arguments.front();
  if (std::ranges::count(completed_shells(), shell) == 0) {
    throw InputError("SHELL", one_line(shell),
                     fmt::format("one of {}", fmt::join(completed_shells(), ", ")));
  }
  fmt::print("{}", shell_completion(shell));
}

}  // namespace

Command completion_command() {
  return {
      .name = "completion",
      .group = "The paper and this machine",
      .description = "print what lets a shell complete commands, keys and their words",
      .about =
          "Knows bash, zsh and fish; source <(nlcwfs completion bash) turns it on in this bash. "
          "An installed nlcwfs has them in their usual places.",
      .keys = {},
      .examples = {"nlcwfs completion fish > ~/.config/fish/completions/nlcwfs.fish"},
      .run = run_completion,
      .arguments = {{"SHELL", completed_shells()}}};
}

}  // namespace nlcwfs
