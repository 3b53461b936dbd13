// Tests: what all commands promise.
#include "studies/commands/commands.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/setup.hpp"
#include "tests/studies/run_results.hpp"

#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

using EveryCommand = Program;

/// Not those that need more than a configuration (a folder, frames), print no results, or take no
/// other telescope or sweep than the paper's.
bool runs_on_the_tiny_configuration(const Command& command) {
  const std::set<std::string> others{"manual", "reconstruct", "reproduce"};
  return command.arguments.empty() && !others.contains(command.name);
}

TEST_F(EveryCommand, TheConfigurationOfARunReproducesIt) {
  const Arguments settings{"--detector.photons",
                           "1e5",
                           "--detector.read_noise",
                           "1.5",
                           "--screens.seed",
                           "7",
                           "--seeing.fwhm",
                           "0.8",
                           "--seeing.outer_scale",
                           "25m",
                           "--telescope.diameter",
                           "60cm",
                           "--reconstruction.relaxation",
                           "-0.3:0.2",
                           "--simulation.precision",
                           "single",
                           "--search.z_far",
                           "100km:200km",
                           "--scale.wavelength",
                           "850nm"};
  for (const Command& command : commands()) {
    if (!runs_on_the_tiny_configuration(command)) continue;
    const std::string first = command.name + "-first";
    const std::string again = command.name + "-again";
    done(command.name, first, settings);
    const ProgramRun repeated =
        run({command.name, "--config", first + "/config.cfg", "--output", again});
    ASSERT_EQ(repeated.exit_code, 0) << repeated.errors;
    EXPECT_EQ(repeatable_summary(first), repeatable_summary(again)) << command.name;
    EXPECT_EQ(names_in(first), names_in(again));
    for (const char* file : {"config.cfg", "best.cfg", "scaled.cfg", "search.csv", "screens.fits",
                             "structure_function.csv", "typical-images.fits", "worst-phases.fits",
                             "loops.csv", "sensitivity.csv"}) {
      EXPECT_EQ(contents(first + '/' + file), contents(again + '/' + file)) << file;
    }
  }
}

TEST_F(EveryCommand, TheSeedDecidesTheResult) {
  done("evaluate", "one");
  done("evaluate", "two", {"--screens.seed", "2"});
  EXPECT_NE(summary("one")["design"]["performance"]["residual_wfe_nm"],
            summary("two")["design"]["performance"]["residual_wfe_nm"]);
}

TEST_F(EveryCommand, TheNumberOfThreadsDoesNotMatter) {
  for (const Command& command : commands()) {
    if (!runs_on_the_tiny_configuration(command)) continue;
    const Arguments more{"--screens.count",  "5",  "--detector.photons", "1e5",
                         "--scale.diameter", "2m", "--verify.screens",   "3"};
    for (const std::string threads : {"1", "2"}) {
      Arguments arguments = more;
      arguments.insert(arguments.end(), {"--threads", threads});
      done(command.name, command.name + threads, arguments);
    }
    EXPECT_EQ(repeatable_summary(command.name + "1"), repeatable_summary(command.name + "2"));
  }
}

TEST_F(EveryCommand, WithoutAFolderOfTheUsersRunsAreNumbered) {
  for (const std::string folder : {"results/evaluate-1", "results/evaluate-2"}) {
    const ProgramRun finished = run({"evaluate", "--config", "tiny.cfg", "--quiet"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.errors, "");
    EXPECT_THAT(finished.output, EndsWith("Results are in " + folder + ".\n"));
    EXPECT_TRUE(std::filesystem::exists(folder + "/summary.json"));
  }
}

TEST_F(EveryCommand, FoldersMayHaveAnyName) {
  for (const std::string folder :
       {"two words/and parents", "it's", "\xC3\xBC", "slash/", "file:a?b"}) {
    const ProgramRun finished = run({"evaluate", "--config", "tiny.cfg", "--output", folder});
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_TRUE(std::filesystem::exists(folder + "/summary.json")) << folder;
    EXPECT_TRUE(std::filesystem::exists(folder + "/archive.sqlite")) << folder;
  }
}

TEST_F(EveryCommand, HelpVersionAndDumpWorkOnEveryCommandAndLeaveNothing) {
  const ProgramRun bare = run({"--version"});
  EXPECT_EQ(bare.output, "nlcwfs " + std::string(version()) + "\n");
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  for (const Command& command : commands()) {
    const ProgramRun help = run({command.name, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.output, HasSubstr("nlcwfs " + command.name));
    EXPECT_EQ(run({command.name, "--version"}).output, bare.output);

    const ProgramRun dump = run({command.name, "--dump-config", "--telescope.diameter", "1.8m"});
    EXPECT_EQ(dump.exit_code, 0);
    EXPECT_THAT(dump.output, HasSubstr("diameter = 1.8m\n"));
    std::ofstream("dump.cfg") << dump.output;
    EXPECT_EQ(run({command.name, "--dump-config", "--config", "dump.cfg"}).output, dump.output);
    EXPECT_EQ(help.errors + dump.errors, "");
  }
  EXPECT_THAT(names_in("."), ElementsAre("dump.cfg", "errors.txt", "output.txt", "tiny.cfg"));
}

}  // namespace
}  // namespace nlcwfs
