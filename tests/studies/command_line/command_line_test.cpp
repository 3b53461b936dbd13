// Tests: The words of a command line become a request.
#include "studies/command_line/command_line.hpp"

#include "results/archive/archive.hpp"
#include "studies/commands/commands.hpp"
#include "tests/message_of.hpp"
#include "tests/scratch_folder.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;
using testing::StartsWith;

Request parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "nlcwfs");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

std::string parse_message(const std::vector<const char*>& arguments) {
  return message_of([&] { parse(arguments); });
}

using CommandLineTest = ScratchFolder;

TEST_F(CommandLineTest, ReadsTheCommandAndItsOptions) {
  const Request plain = parse({"evaluate"});
  EXPECT_EQ(plain.command->name, "evaluate");
  EXPECT_EQ(plain.output, std::nullopt);
  EXPECT_EQ(plain.threads, 0);
  EXPECT_EQ(plain.log_level, LogLevel::info);
  EXPECT_FALSE(plain.help || plain.version || plain.dump_config);
  EXPECT_EQ(plain.configuration, Configuration());

  const Request full = parse({"--quiet", "optimize", "--output", "my results", "--threads=3",
                              "--dump-config", "--screens.count", "8"});
  EXPECT_EQ(full.command->name, "optimize");
  EXPECT_THAT(full.output, Optional(std::filesystem::path("my results")));
  EXPECT_EQ(full.threads, 3);
  EXPECT_EQ(full.log_level, LogLevel::warning);
  EXPECT_TRUE(full.dump_config);
  EXPECT_EQ(full.configuration.integer("screens.count"), 8);
  EXPECT_EQ(full.configuration.source("screens.count"), "on the command line");
}

TEST_F(CommandLineTest, ValuesMayBeginWithAMinus) {
  for (const auto& arguments :
       std::vector<std::vector<const char*>>{{"evaluate", "--sensor.planes", "-47km,47km"},
                                             {"evaluate", "--sensor.planes=-47km,47km"}}) {
    EXPECT_THAT(parse(arguments).configuration.lengths("sensor.planes"), ElementsAre(-47e3, 47e3));
  }
}

TEST_F(CommandLineTest, TheStrongerLayerWinsWhateverTheOrderOfTheArguments) {
  std::ofstream("first.cfg") << "[telescope]\ndiameter = 1m\nwavelength = 600nm\n"
                                "[reconstruction]\nwindow = 5\n[screens]\ncount = 3\n";
  std::ofstream("second.cfg") << "[telescope]\ndiameter = 2m\nwavelength = 700nm\n";
  const Configuration configuration =
      parse({"--telescope.diameter", "3m", "evaluate", "--config", "first.cfg", "--config",
             "second.cfg", "--preset", "paper"})
          .configuration;
  EXPECT_EQ(configuration.length("telescope.diameter"), 3.0);
  EXPECT_EQ(configuration.length("telescope.wavelength"), 700e-9);
  EXPECT_EQ(configuration.integer("screens.count"), 3);
  EXPECT_EQ(configuration.number("reconstruction.window"), 5.0);
  EXPECT_EQ(configuration.choice("simulation.truth"), "matched");
  EXPECT_EQ(configuration.integer("detector.pupil_pixels"), 64);
}

TEST_F(CommandLineTest, ADumpedConfigurationReproducesTheCommandLine) {
  const Configuration configuration = parse({"evaluate", "--preset", "paper", "--seeing.fwhm",
                                             "0.8", "--sensor.planes", "-1km,2km"})
                                          .configuration;
  std::ofstream("my config.cfg") << configuration.dump();
  EXPECT_EQ(parse({"evaluate", "--config", "my config.cfg"}).configuration, configuration);
}

TEST_F(CommandLineTest, HelpAndVersionWorkWithAndWithoutACommand) {
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  for (const Command& command : commands()) {
    const char* name = command.name.c_str();
    EXPECT_TRUE(parse({name, "--help"}).help);
    EXPECT_TRUE(parse({name, "--version"}).version);
    EXPECT_TRUE(parse({name, "--dump-config"}).dump_config);
  }
  EXPECT_TRUE(parse({"evaluate", "--help", "--config", "/no/such.cfg"}).help);
}

TEST_F(CommandLineTest, AsksForACommand) {
  const std::string names = fmt::format("{}", fmt::join(command_names(), ", "));
  const std::string message = "command line = (nothing): a command must stand there, one of " +
                              names + "; nlcwfs --help explains them";
  EXPECT_EQ(parse_message({}), message);
  EXPECT_EQ(parse_message({"--quiet"}), message);
  EXPECT_EQ(message_of([] { parse_command_line(0, std::vector<const char*>{nullptr}.data()); }),
            message);
  EXPECT_EQ(parse_message({"optimise"}),
            "command line = optimise: no command of nlcwfs, which has " + names +
                "; did you mean optimize?");
  EXPECT_THAT(parse_message({""}), StartsWith("command line = (nothing): no command"));
}

TEST_F(CommandLineTest, NamesAStrayArgument) {
  EXPECT_EQ(parse_message({"evaluate", "--telescope.diameter", "5", "m"}),
            "command line = m: nothing may follow the command evaluate but options; a value is one "
            "word, such as 0.5m or -47km,47km");
  EXPECT_THAT(parse_message({"evaluate", "optimize"}), StartsWith("command line = optimize: "));
}

TEST_F(CommandLineTest, TakesTheArgumentsOfACommand) {
  EXPECT_THAT(parse({"compare", "a", "--quiet", "b c"}).arguments, ElementsAre("a", "b c"));
  for (const auto& arguments :
       std::vector<std::vector<const char*>>{{"compare"}, {"compare", "a"}}) {
    EXPECT_THAT(parse_message(arguments),
                EndsWith("SWEEP and OPTIMIZE must follow compare: nlcwfs compare SWEEP OPTIMIZE"));
  }
  EXPECT_THAT(
      parse_message({"compare", "a", "b", "c"}),
      StartsWith("command line = c: nothing may follow the command compare SWEEP OPTIMIZE "));
  EXPECT_THAT(parse_message({"compare", "a", ""}), StartsWith("OPTIMIZE = (nothing): "));
  EXPECT_TRUE(parse({"evaluate"}).arguments.empty());
}

TEST_F(CommandLineTest, SuggestsTheNearestOption) {
  EXPECT_EQ(
      parse_message({"evaluate", "--telescope.diametr", "5"}),
      "command line = --telescope.diametr: unknown option; did you mean --telescope.diameter?");
  EXPECT_THAT(parse_message({"evaluate", "--telescope.diametr=5"}),
              EndsWith("did you mean --telescope.diameter?"));
  EXPECT_THAT(parse_message({"evaluate", "--diameter", "5"}),
              EndsWith("did you mean --telescope.diameter?"));
  EXPECT_THAT(parse_message({"evaluate", "--outptu", "x"}), EndsWith("did you mean --output?"));
}

TEST_F(CommandLineTest, SuggestsNothingThatIsFar) {
  EXPECT_EQ(parse_message({"evaluate", "--bogus"}),
            "command line = --bogus: unknown option; nlcwfs manual lists all");
  for (const char* word : {"bogus", "design"}) {
    EXPECT_THAT(parse_message({word}), EndsWith("; nlcwfs --help explains them"));
  }
}

TEST_F(CommandLineTest, TakesAWordOfHelp) {
  EXPECT_TRUE(parse({"help"}).help);
  EXPECT_TRUE(parse({"-h"}).help);
  for (const std::vector<const char*>& words :
       {std::vector{"help", "sweep"}, std::vector{"sweep", "-h"}}) {
    const Request help = parse(words);
    EXPECT_TRUE(help.help);
    EXPECT_EQ(help.command->name, "sweep");
  }
  EXPECT_THAT(parse_message({"help", "bogus"}), StartsWith("command line = bogus: no command"));
}

TEST_F(CommandLineTest, SaysThatAListIsOneWord) {
  EXPECT_EQ(parse_message({"evaluate", "--sensor.planes", "180km", "-180km"}),
            "command line = -180km: values are one word, separated by commas, as in "
            "--sensor.planes=-180km,180km");
}

TEST_F(CommandLineTest, KnowsNeitherAbbreviationsNorShortOptions) {
  EXPECT_THAT(parse_message({"evaluate", "--telescope.diam", "5"}),
              EndsWith("--telescope.diam: unknown option; did you mean --telescope.diameter?"));
  EXPECT_THAT(parse_message({"evaluate", "--qui"}), EndsWith("did you mean --quiet?"));
  EXPECT_EQ(parse_message({"evaluate", "-q"}),
            "command line = -q: unknown option; did you mean --quiet?");
}

TEST_F(CommandLineTest, SaysWhatIsMissing) {
  const std::string message =
      "screens.seed = (nothing): a whole number from 0 to 18446744073709551615";
  for (const auto& arguments : std::vector<std::vector<const char*>>{
           {"evaluate", "--screens.seed"},
           {"evaluate", "--screens.seed="},
           {"evaluate", "--screens.seed", ""},
           {"evaluate", "--screens.seed", "--quiet"},
           {"evaluate", "--screens.seed", "--nonsense"},
           {"evaluate", "--screens.seed", "--screens.count", "3"}}) {
    EXPECT_EQ(parse_message(arguments), message);
  }
  for (const char* option : {"--config", "--preset", "--output", "--resume", "--threads"}) {
    EXPECT_EQ(parse_message({"evaluate", option}),
              std::string(option) + " = (nothing): a value must follow");
  }
}

TEST_F(CommandLineTest, RefusesWhatIsGivenTwice) {
  EXPECT_EQ(parse_message({"evaluate", "--screens.seed", "1", "--screens.seed", "2"}),
            "command line = --screens.seed 2: given twice; keep one of them");
  EXPECT_EQ(parse_message({"evaluate", "--output=a", "--output=b"}),
            "command line = --output=b: given twice; keep one of them");
  EXPECT_EQ(parse_message({"evaluate", "--quiet", "--quiet"}),
            "command line = --quiet: given twice; keep one of them");
}

TEST_F(CommandLineTest, OnlyAdviseVerifiesOnDemand) {
  EXPECT_THAT(parse({"advise", "--verify"}).flags, ElementsAre("verify"));
  EXPECT_TRUE(parse({"advise"}).flags.empty());
  for (const Command& command : commands()) {
    if (command.name == "advise") continue;
    std::vector<const char*> arguments{"--verify", command.name.c_str()};
    arguments.resize(2 + command.arguments.size(), "folder");
    EXPECT_EQ(parse_message(arguments),
              "command line = --verify: only advise takes it; leave it away with " + command.name);
  }
}

TEST_F(CommandLineTest, FiguresOfAReproductionAddUp) {
  EXPECT_EQ(parse({"reproduce", "--figure", "3", "--figure", "response"})
                .configuration.text("reproduce.figures"),
            "3,response");
  EXPECT_EQ(parse_message({"evaluate", "--figure", "3"}),
            "command line = --figure 3: only reproduce takes it; leave it away with evaluate");
  EXPECT_EQ(parse_message({"reproduce", "--figure", "3", "--reproduce.figures", "4"}),
            "command line = --figure 3: reproduce.figures is given too; keep one of them");
  EXPECT_THAT(parse_message({"reproduce", "--figure"}), HasSubstr("a value must follow"));
  EXPECT_EQ(parse({"reconstruct", "--frames", "a.fits"}).configuration.text("frames.file"),
            "a.fits");
}

TEST_F(CommandLineTest, ResumesWithTheConfigurationOfTheFolder) {
  Configuration earlier;
  earlier.set("screens.count", "3", "in a test");
  const std::filesystem::path folder = std::filesystem::absolute("run");
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "config.cfg") << earlier.dump();
  (void)Archive(folder / "archive.sqlite", "sweep");
  const std::string name = folder.string();
  EXPECT_THAT(parse_message({"trade", "--resume", name.c_str()}),
              HasSubstr(": is a run of sweep; name the folder of an interrupted trade"));
  EXPECT_THAT(parse({"trade", "--reuse", name.c_str()}).reuse, Optional(folder));
  EXPECT_THAT(parse_message({"trade", "--reuse", "no/such/folder"}),
              StartsWith("--reuse = no/such/folder: has no archive.sqlite; "));
  EXPECT_THAT(parse_message({"screens", "--reuse", name.c_str()}),
              HasSubstr(": screens keeps no trials; leave it away"));
  const Request resumed = parse({"sweep", "--resume", name.c_str(), "--threads", "2", "--quiet"});
  EXPECT_THAT(resumed.resume, Optional(folder));
  EXPECT_EQ(resumed.configuration, earlier);
  EXPECT_EQ(resumed.threads, 2);
  EXPECT_EQ(resumed.log_level, LogLevel::warning);

  for (const auto& more : std::vector<std::vector<const char*>>{{"--screens.count", "3"},
                                                                {"--config", "any.cfg"},
                                                                {"--preset", "paper"},
                                                                {"--output", "elsewhere"}}) {
    std::vector<const char*> arguments{"sweep", "--resume", name.c_str()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(parse_message(arguments),
                AllOf(StartsWith("--resume = "), HasSubstr("goes on in that folder"),
                      HasSubstr(fmt::format("leave away {},", more.front()))))
        << more.front();
  }
  EXPECT_THAT(parse_message({"sweep", "--resume", "no/such/folder", "--screens.count", "3"}),
              StartsWith("--resume = no/such/folder: there is no such folder; "));
}

TEST_F(CommandLineTest, OnlySomeCommandsResume) {
  for (const Command& command : commands()) {
    if (command.resumption != Resumption::none) continue;
    std::vector<const char*> arguments{"--resume", "run", command.name.c_str()};
    arguments.resize(3 + command.arguments.size(), "folder");
    EXPECT_EQ(parse_message(arguments),
              "--resume = run: " + command.name +
                  " cannot go on with a run; begin it anew with --config run/config.cfg");
  }
}

TEST_F(CommandLineTest, ThreadsAreAWholeNumber) {
  for (const char* threads : {"-1", "1.5", "two", "4097", "99999999999"}) {
    EXPECT_EQ(
        parse_message({"evaluate", "--threads", threads}),
        std::string("--threads = ") + threads + ": a whole number from 0 (all cores) to 4096");
  }
}

TEST_F(CommandLineTest, PassesOnWhatTheConfigurationRefuses) {
  EXPECT_THAT(parse_message({"evaluate", "--telescope.diameter", "5parsec"}),
              AllOf(StartsWith("telescope.diameter = 5parsec: a length from 0.0001 m"),
                    EndsWith("(on the command line)")));
  EXPECT_EQ(parse_message({"evaluate", "--preset", "nature"}),
            "--preset = nature: the only one is paper");
  EXPECT_THAT(parse_message({"evaluate", "--config", "/no/such.cfg"}),
              StartsWith("--config = /no/such.cfg: cannot be read"));
  EXPECT_THAT(parse_message({"evaluate", "--seeing.fwhm", "1", "--seeing.d_over_r0", "4"}),
              EndsWith("(seeing.fwhm is set to 1 on the command line)"));
  EXPECT_EQ(parse_message({"evaluate", "--quiet=yes"}), "command line = --quiet: takes no value");
}

TEST_F(CommandLineTest, EveryMessageIsOneLine) {
  for (const auto& arguments :
       std::vector<std::vector<const char*>>{{"a\nb"},
                                             {"evaluate", "a\nb"},
                                             {"evaluate", "--a\nb"},
                                             {"evaluate", "-a\nb"},
                                             {"evaluate", "--threads=a\nb"},
                                             {"evaluate", "--preset=a\nb"},
                                             {"evaluate", "--config=a\nb"},
                                             {"evaluate", "--screens.file=a\nb"},
                                             {"evaluate", "--quiet=a\nb"}}) {
    EXPECT_THAT(parse_message(arguments), AllOf(Not(""), Not(HasSubstr("\n"))));
  }
}

TEST_F(CommandLineTest, HasFourLogLevels) {
  EXPECT_EQ(parse({"evaluate", "--log-level", "error"}).log_level, LogLevel::error);
  EXPECT_EQ(parse({"evaluate", "--log-level", "warning"}).log_level, LogLevel::warning);
  EXPECT_EQ(parse({"evaluate", "--log-level=info"}).log_level, LogLevel::info);
  EXPECT_EQ(parse({"evaluate", "--log-level", "debug"}).log_level, LogLevel::debug);
  EXPECT_EQ(parse_message({"evaluate", "--log-level", "trace"}),
            "--log-level = trace: one of error, warning, info, debug");
  EXPECT_EQ(parse_message({"evaluate", "--log-level"}),
            "--log-level = (nothing): a value must follow");
  EXPECT_EQ(parse_message({"evaluate", "--log-level", "info", "--quiet"}),
            "command line = --quiet: is the same as --log-level warning; keep one of them");
}

}  // namespace
}  // namespace nlcwfs
