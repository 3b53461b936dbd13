// Tests: The help of the program and of each command.
#include "studies/command_line/help_text.hpp"

#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/settings/configuration.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

void expect_100_columns(const std::string& help) {
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
}

/// A long default may be broken over two lines.
std::string without_spaces(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

TEST(HelpText, OfTheProgramNamesCommandsAndOptions) {
  const std::string help = program_help();
  expect_100_columns(help);
  EXPECT_THAT(help, StartsWith("Usage: nlcwfs <command> "));
  for (const Command& command : commands()) {
    EXPECT_THAT(help, AllOf(HasSubstr("\n  " + command.name), HasSubstr(command.description),
                            HasSubstr("\n" + command.group + ":\n")));
  }
  for (const ProgramOption& option : program_options()) {
    EXPECT_THAT(help, HasSubstr("\n  --" + option.name + " "));
  }
  EXPECT_THAT(help, HasSubstr("--resume DIR          evaluate, sweep, "));
}

TEST(HelpText, OfTheProgramFitsTwoScreens) {
  const std::string help = program_help();
  EXPECT_LE(std::ranges::count(help, '\n'), 64);
}

TEST(HelpText, OfACommandHasItsOptionsAndKeysAlone) {
  for (const Command& command : commands()) {
    const std::string help = command_help(command);
    expect_100_columns(help);
    EXPECT_THAT(help, StartsWith("Usage: nlcwfs " + command.name + " "));
    EXPECT_THAT(help, HasSubstr(command.description.substr(1))) << "it begins with a capital there";
    for (const ProgramOption& option : program_options()) {
      const auto mentions = HasSubstr("\n  --" + option.name + " ");
      if (option.is_of(command)) {
        EXPECT_THAT(help, mentions);
      } else {
        EXPECT_THAT(help, Not(mentions));
      }
    }
    const std::string run_together = without_spaces(help);
    for (const ConfigurationKey& key : configuration_keys()) {
      const auto mentions = HasSubstr("\n  --" + key.name + " ");
      if (!command.reads(key.name)) {
        EXPECT_THAT(help, Not(mentions)) << command.name;
        continue;
      }
      EXPECT_THAT(help, mentions) << command.name;
      if (key.default_text.empty()) continue;
      EXPECT_THAT(run_together, HasSubstr(fmt::format("[{}]", without_spaces(key.default_text))))
          << key.name;
    }
  }
}

TEST(HelpText, ExplainsTheNamesOfValues) {
  const std::string trade = without_spaces(command_help(command_of("trade")));
  EXPECT_THAT(trade,
              AllOf(HasSubstr("--search.z_nearRANGE"), HasSubstr("search.initial_guessWORDS"),
                    HasSubstr("RANGEisMIN:MAX,MIN:MAX:logoralist"), Not(HasSubstr("GRID"))));
  const std::string sweep = without_spaces(command_help(command_of("sweep")));
  EXPECT_THAT(sweep, AllOf(HasSubstr("--sweep.z_nearGRID"), HasSubstr("GRIDisMIN:MAX:N,"),
                           Not(HasSubstr("RANGE"))));
}

TEST(HelpText, BreaksLongDefaultsAfterCommas) {
  EXPECT_THAT(command_help(command_of("trade")),
              AllOf(HasSubstr("detector_pixels,\n"), HasSubstr(" plane_count]\n")));
}

TEST(HelpText, BreaksExamplesBeforeOptions) {
  using testing::ElementsAre;
  EXPECT_THAT(example_lines("nlcwfs sweep --a.b 5km --c 2 --d", 20),
              ElementsAre("nlcwfs sweep", "--a.b 5km --c 2 --d"));
  EXPECT_THAT(example_lines("nlcwfs manual | man -l -", 5),
              ElementsAre("nlcwfs manual | man -l -"));
}

TEST(Commands, HaveWhatTheHelpNeeds) {
  std::set<std::string> names;
  std::set<std::string> groups;
  std::string group;
  for (const Command& command : commands()) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    if (command.group != group) {
      EXPECT_TRUE(groups.insert(command.group).second) << group << " is in two pieces";
    }
    group = command.group;
    EXPECT_NE(command.about, "") << command.name;
    ASSERT_FALSE(command.examples.empty()) << command.name;
    for (const std::string& example : command.examples) {
      EXPECT_THAT(example, StartsWith("nlcwfs " + command.name));
    }
    for (const std::string& part : command.keys) {
      const auto& keys = configuration_keys();
      EXPECT_TRUE(std::ranges::any_of(keys,
                                      [&](const ConfigurationKey& key) {
                                        return Command{.name = "",
                                                       .group = "",
                                                       .description = "",
                                                       .about = "",
                                                       .keys = {part},
                                                       .examples = {}}
                                            .reads(key.name);
                                      }))
          << command.name << " " << part;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
