// Tests: Ctrl-C is noted, so that work can come to a clean end.
#include "tests/studies/program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr int interrupted = 3;
constexpr const char* notice =
    "nlcwfs: ending with what is done so far; interrupt again to end at once\n";

class Interrupt : public Program {
 protected:
  /// Screens that take a tenth of a second each, so that a run of many lasts until its signal.
  void SetUp() override {
    Program::SetUp();
    std::ofstream("slow.cfg") << contents("tiny.cfg")
                              << "[reconstruction]\nmax_loops = 500\ntolerance = 0\n";
    // Sends signals when the program's log has their texts: SIGNAL TEXT SIGNAL TEXT ... -- PROGRAM
    std::ofstream("signalled.sh") << "signals=\nwhile [ \"$1\" != -- ]; do\n"
                                     "  signals=\"$signals$1 $2\n\"; shift 2\ndone\nshift\n"
                                     "\"$@\" & pid=$!\n"
                                     "printf %s \"$signals\" | while read -r signal text; do\n"
                                     "  until grep -q \"$text\" errors.txt; do\n"
                                     "    kill -0 $pid 2> /dev/null || exit; sleep 0.01\n"
                                     "  done\n  kill -s $signal $pid\ndone\nwait $pid\n";
  }

  /// `command --config slow.cfg --output run more...` with signals at texts of its log.
  static ProgramRun signalled(const std::string& signals, const std::string& command,
                              const Arguments& more = {},
                              const Arguments& log = {"--log-level", "debug"}) {
    Arguments arguments{command, "--config", "slow.cfg", "--output", "run"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), log.begin(), log.end());
    return run(arguments, "sh signalled.sh " + signals + " -- ");
  }

  /// Ended by one signal with a usable result.
  static Json usable(const ProgramRun& finished) {
    EXPECT_EQ(finished.exit_code, interrupted) << finished.errors;
    EXPECT_THAT(finished.errors, HasSubstr(notice));
    EXPECT_THAT(finished.output,
                AllOf(HasSubstr("\nInterrupted when "), EndsWith("\nResults are in run.\n")));
    Json json = summary("run");
    EXPECT_EQ(json.at("interrupted"), true);
    return json;
  }
};

TEST_F(Interrupt, EvaluateReportsOnTheScreensThatAreDone) {
  const ProgramRun finished =
      signalled("INT 'evaluate: begun'", "evaluate", {"--screens.count", "500"});
  const Json json = usable(finished);
  const int screens = json["design"]["performance"]["screens"];
  ASSERT_GE(screens, 2);
  ASSERT_LT(screens, 500);
  EXPECT_THAT(finished.output, AllOf(HasSubstr(fmt::format("On {} screens", screens)),
                                     HasSubstr(fmt::format("{} of 500 screens", screens))));
  const std::string table = contents("run/screens.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), screens + 1);
  // They are the first ones.
  done("evaluate", "again",
       {"--config", "slow.cfg", "--screens.count", fmt::format("{}", screens)});
  EXPECT_EQ(repeatable_summary("run")["design"], repeatable_summary("again")["design"]);
  EXPECT_EQ(summary("again")["interrupted"], false);
}

TEST_F(Interrupt, ATerminationIsOneToo) {
  usable(signalled("TERM 'evaluate: begun'", "evaluate", {"--screens.count", "500"}));
}

TEST_F(Interrupt, ConvergenceReportsOnTheScreensThatAreDone) {
  const Json json =
      usable(signalled("INT 'convergence: begun'", "convergence", {"--screens.count", "500"}));
  const std::size_t followed = json["residual_after_loops_nm"]["screens"][0].size();
  EXPECT_GE(followed, 2u);
  EXPECT_LT(followed, 500u);
  EXPECT_EQ(json["aberrations_nm"].size(), followed);
  EXPECT_GE(json["design"]["performance"]["screens"], 2);
}

TEST_F(Interrupt, ResponseReportsOnTheFrequenciesThatAreDone) {
  const Arguments frequencies{"--response.frequencies", "1,2,3,4,5,6,7", "--screens.count", "4"};
  const Json first = usable(signalled("INT 'response: begun'", "response", frequencies));
  EXPECT_EQ(first["cycles_per_pupil"], (Json{1.0}));
  EXPECT_GE(first["wavefronts"], 2);
  EXPECT_EQ(first["design"]["response"]["recovered_share"].size(), 1u);
  EXPECT_EQ(std::ranges::count(contents("run/response.csv"), '\n'), 2);
}

TEST_F(Interrupt, ScreensKeepsThoseThatAreDrawn) {
  const ProgramRun finished =
      signalled("INT 'screens: begun'", "screens",
                {"--screens.count", "800", "--simulation.pupil_samples", "256"});
  const Json json = usable(finished);
  EXPECT_GE(json["screens"], 2);
  EXPECT_LT(json["screens"], 800);
}

TEST_F(Interrupt, OptimizeEndsItsVerificationWithTheSameScreensForBoth) {
  const ProgramRun finished =
      signalled("INT 'verification: begun'", "optimize",
                {"--search.budget", "1", "--screens.count", "1", "--verify.screens", "300"});
  const Json json = usable(finished);
  const int screens = json["best"]["performance"]["screens"];
  EXPECT_GE(screens, 2);
  EXPECT_LT(screens, 300);
  EXPECT_EQ(json["baseline"]["performance"]["screens"], screens);
  EXPECT_EQ(json["ranking"].size(), 1u);
  EXPECT_THAT(finished.output,
              HasSubstr(fmt::format("Both on the same {} fresh screens", screens)));
  EXPECT_TRUE(std::filesystem::exists("run/best.cfg"));
}

TEST_F(Interrupt, OptimizeEndsTheScanOfItsVariables) {
  const ProgramRun finished =
      signalled("INT 'how far each variable may move: begun'", "optimize",
                {"--search.budget", "1", "--screens.count", "8", "--verify.screens", "2"});
  const Json json = usable(finished);
  EXPECT_EQ(json["indistinguishable"].size(), 0u);
  EXPECT_EQ(json["best"]["performance"]["screens"], 2);
  EXPECT_NE(json["termination"], "stop_requested");
}

TEST_F(Interrupt, ASearchEndsWithinADesign) {
  const ProgramRun finished =
      signalled("INT 'search: a design'", "optimize",
                {"--search.budget", "50", "--screens.count", "20", "--verify.screens", "2"});
  const Json json = usable(finished);
  EXPECT_EQ(json["termination"], "stop_requested");
  EXPECT_LT(json["evaluations"], 50);
  EXPECT_EQ(json["best"]["performance"]["screens"], 2) << "the verification is whole";
}

TEST_F(Interrupt, TradeEndsItsVerificationWithADesignAtLeast) {
  const ProgramRun finished = signalled(
      "INT 'verification: begun'", "trade",
      {"--trade.budget", "8", "--trade.population", "8", "--screens.count", "1",
       "--search.plane_count", "2,3", "--search.pupil_pixels", "16", "--verify.screens", "100"});
  const Json json = usable(finished);
  ASSERT_EQ(json["front"].size(), 1u);
  EXPECT_EQ(json["verification_interrupted"], true);
  EXPECT_GE(json["front"][0]["performance"]["screens"], 2);
}

TEST_F(Interrupt, AdviseEndsItsVerification) {
  const Json json = usable(
      signalled("INT 'verification: begun'", "advise", {"--verify", "--verify.screens", "300"}));
  EXPECT_GE(json["design"]["performance"]["screens"], 2);
  EXPECT_LT(json["design"]["performance"]["screens"], 300);
}

TEST_F(Interrupt, CompareEndsWithTheSameScreensForBoth) {
  done("sweep", "sweep", {"--config", "slow.cfg"});
  done("optimize", "optimize", {"--config", "slow.cfg", "--search.budget", "2"});
  const ProgramRun finished = run({"compare", "sweep", "optimize", "--output", "run",
                                   "--verify.screens", "300", "--log-level", "debug"},
                                  "sh signalled.sh INT 'verification: begun' -- ");
  const Json json = usable(finished);
  const int screens = json["sweep"]["performance"]["screens"];
  EXPECT_GE(screens, 2);
  EXPECT_LT(screens, 300);
  EXPECT_EQ(json["optimize"]["performance"]["screens"], screens);
}

TEST_F(Interrupt, BenchmarkSaysThatItTimedNothing) {
  const ProgramRun finished = signalled("INT 'benchmark: begun'", "benchmark");
  EXPECT_EQ(finished.exit_code, interrupted);
  EXPECT_THAT(finished.errors, HasSubstr("nlcwfs: interrupted: before anything was timed\n"));
  EXPECT_FALSE(std::filesystem::exists("run/summary.json"));
}

TEST_F(Interrupt, ASweepGoesOnFromItsVerification) {
  const Arguments more{"--screens.count", "1", "--verify.screens", "50"};
  const ProgramRun finished = signalled("INT 'verification: begun'", "sweep", more);
  EXPECT_EQ(finished.exit_code, interrupted);
  EXPECT_THAT(finished.errors, EndsWith("nlcwfs: interrupted: in the verification; go on with: "
                                        "nlcwfs sweep --resume run\n"));
  EXPECT_THAT(names_in("run"), ElementsAre("archive.sqlite", "config.cfg", "sweep.csv"));
  const ProgramRun resumed = run({"sweep", "--resume", "run"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(summary("run")["best"]["performance"]["screens"], 50);
  EXPECT_EQ(summary("run")["interrupted"], false);
}

TEST_F(Interrupt, AReproductionGoesOnWithThePartsThatAreMissing) {
  std::ofstream("slow.cfg") << contents("tiny.cfg").substr(0, contents("tiny.cfg").find("[sweep]"))
                            << "[reproduce]\nfigures = scaling\n";
  const ProgramRun finished =
      signalled("INT 'evaluate: begun'", "reproduce", {"--screens.count", "400"});
  EXPECT_EQ(finished.exit_code, interrupted);
  EXPECT_THAT(finished.errors, AllOf(HasSubstr("nlcwfs: interrupted: in part "),
                                     EndsWith("; go on with: nlcwfs reproduce --resume run\n")));
  EXPECT_FALSE(std::filesystem::exists("run/summary.json"));
  for (const auto& part : std::filesystem::recursive_directory_iterator("run")) {
    if (part.path().filename() != "summary.json") continue;
    EXPECT_EQ(Json::parse(contents(part.path().string()))["design"]["performance"]["screens"], 400);
  }
  const ProgramRun resumed = run({"reproduce", "--resume", "run"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(summary("run")["runs"].size(), 8u);
}

TEST_F(Interrupt, TheSecondOneEndsEveryCommandAtOnce) {
  const std::string twice = "INT 'search: a design' INT 'interrupt again'";
  const ProgramRun finished =
      signalled(twice, "optimize", {"--screens.count", "2", "--verify.screens", "1000"});
  EXPECT_EQ(finished.exit_code, 128 + SIGINT);
  EXPECT_EQ(finished.output, "");
  EXPECT_THAT(names_in("run"), ElementsAre("archive.sqlite", "config.cfg"));
}

TEST_F(Interrupt, BeforeThereIsAnythingItLeavesNothing) {
  // While the screens are drawn, the folder is not there yet.
  std::ofstream("killed.sh") << "\"$@\" & pid=$!; kill -s TERM $pid; wait $pid\n";
  const ProgramRun finished =
      run({"evaluate", "--output", "run", "--screens.count", "5000"}, "sh killed.sh ");
  EXPECT_EQ(finished.exit_code, 128 + SIGTERM);
  EXPECT_THAT(finished.errors, Not(HasSubstr("nlcwfs"))) << "the shell may say something";
  EXPECT_FALSE(std::filesystem::exists("run"));
}

}  // namespace
}  // namespace nlcwfs
