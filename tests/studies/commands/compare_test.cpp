// Tests of the command compare, run as a user does.
#include "results/archive/archive.hpp"
#include "studies/settings/configuration.hpp"
#include "tests/studies/program.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;
using Json = nlohmann::json;

/// A sweep and a search to compare, in the folders `sweep` and `optimize`.
class CompareStudy : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    done("sweep", "sweep");
    done("optimize", "optimize");
  }

  static ProgramRun compared(const Arguments& more) {
    Arguments arguments{"compare", "sweep", "optimize"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(CompareStudy, LeavesItsFiles) {
  const ProgramRun finished = compared({"--output", "run"});
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_THAT(
      finished.output,
      AllOf(StartsWith("0.5 m telescope"), HasSubstr("seed 1000004, which neither has seen"),
            HasSubstr("what finding it took"), EndsWith("Results are in run.\n")));
  EXPECT_THAT(names_in("run"), ElementsAre("archive.sqlite", "config.cfg", "path.png", "path.svg",
                                           "report.html", "summary.json"));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "compare");
  EXPECT_EQ(json.at("config").at("verify.seed"), "1000004");
  for (const char* name : {"sweep", "optimize"}) {
    EXPECT_EQ(json.at(name).at("planes_m"), summary(name).at("best").at("planes_m"));
    EXPECT_EQ(json[name].at("performance").at("screens"), 2);
    EXPECT_NE(json[name]["cost"], summary(name)["best"]["cost"]) << "on other screens";
    const Json& effort = json.at("cost").at(name);
    EXPECT_EQ(effort.at("designs"), summary(name).at("evaluations"));
    EXPECT_EQ(effort.at("reconstructions"), summary(name).at("search_reconstructions"));
    EXPECT_EQ(effort.at("seconds"), summary(name).at("search_seconds"));
  }
  EXPECT_NEAR(json.at("difference").at("mean"),
              double(json["optimize"]["cost"]["mean"]) - double(json["sweep"]["cost"]["mean"]),
              1e-12);
  EXPECT_GT(json["difference"].at("standard_error"), 0.0);
  EXPECT_EQ(json["cost"]["sweep_per_optimize"]["designs"], 2.0 / 6.0);
  EXPECT_THAT(Archive::reopened("run/archive.sqlite").evaluations(), SizeIs(2));
}

TEST_F(CompareStudy, ADesignIsIndistinguishableFromItself) {
  // A search that tries the one design that the sweep tries.
  done("sweep", "one", {"--sweep.z_near", "47km"});
  done("optimize", "same", {"--search.budget", "1"});
  const ProgramRun finished = run({"compare", "one", "same", "--output", "run"});
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  const Json json = summary("run");
  EXPECT_EQ(json["difference"], (Json{{"mean", 0.0}, {"standard_error", 0.0}}));
  EXPECT_EQ(json["verdict"], "indistinguishable");
}

TEST_F(CompareStudy, ItsFiguresAreThoseOfEvaluate) {
  ASSERT_EQ(compared({"--output", "run", "--verify.seed", "77", "--verify.screens", "3"}).exit_code,
            0);
  const Json json = repeatable_summary("run");
  EXPECT_EQ(json["config"]["verify.seed"], "77");
  for (const std::string name : {"sweep", "optimize"}) {
    const ProgramRun again =
        run({"evaluate", "--config", name + "/best.cfg", "--output", name + "-again",
             "--screens.seed", "77", "--screens.count", "3", "--simulation.pupil_samples", "64"});
    ASSERT_EQ(again.exit_code, 0) << again.errors;
    EXPECT_EQ(json[name], repeatable_summary(name + "-again")["design"]);
  }
}

TEST_F(CompareStudy, TheConfigurationOfARunReproducesItWithAnyThreads) {
  ASSERT_EQ(compared({"--output", "first", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(
      compared({"--output", "again", "--config", "first/config.cfg", "--threads", "2"}).exit_code,
      0);
  EXPECT_EQ(contents("first/config.cfg"), contents("again/config.cfg"));
  EXPECT_EQ(repeatable_summary("first"), repeatable_summary("again"));
}

TEST_F(CompareStudy, RefusesWhatIsNotASweepAndASearchOfOneTask) {
  done("optimize", "other", {"--detector.photons", "1e5", "--telescope.diameter", "1m"});
  done("optimize", "same seeing", {"--seeing.fried_parameter", "12.5cm"});
  done("optimize", "centroid",
       {"--reconstruction.initial_guess", "centroid", "--search.seed", "3", "--screens.seed", "9"});
  done("optimize", "varied", {"--search.initial_guess", "flat,centroid"});
  std::filesystem::create_directory("empty");
  std::filesystem::create_directory("unfinished");
  std::filesystem::copy("sweep/config.cfg", "unfinished");
  std::filesystem::copy("sweep", "broken");
  std::ofstream("broken/summary.json") << R"({"command": "sweep", "best": {}})";
  struct Case {
    Arguments arguments;
    int exit_code;
    std::string message;
  };
  for (const auto& [arguments, exit_code, message] : std::vector<Case>{
           {{"optimize", "sweep"}, 2, "SWEEP = optimize: is a run of optimize; give first"},
           {{"sweep", "sweep"}, 2, "OPTIMIZE = sweep: is a run of sweep; "},
           {{"none", "optimize"},
            2,
            "SWEEP = none: there is no such folder; name that of a finished sweep"},
           {{"sweep", "empty"},
            2,
            "OPTIMIZE = empty: has no config.cfg; name the folder of a finished optimize"},
           {{"unfinished", "optimize"}, 2, "SWEEP = unfinished: has no summary.json: the run is"},
           {{"broken", "optimize"}, 1, "failed: cannot read broken/summary.json: "},
           {{"sweep", "other"},
            2,
            "OPTIMIZE = other: was not configured as the sweep sweep; they differ in "
            "telescope.diameter (0.5m and 1m), "},
           {{"sweep", "other"}, 2, "detector.photons (0 and 1e5)\n"},
           {{"sweep", "centroid"},
            2,
            "differ in reconstruction.initial_guess (flat and centroid)\n"},
           {{"sweep", "optimize", "--telescope.diameter", "1m"},
            2,
            "telescope.diameter = 1m: compare takes it from the sweep, where it is 0.5m"},
           {{"sweep", "optimize", "--verify.seed", "1000003"}, 2, "verify.seed = 1000003: another"},
           {{"sweep", "optimize", "--verify.seed", "1"}, 2, "verify.seed = 1: another seed"},
           {{"sweep", "same seeing", "--output", "good1"}, 0, ""},
           {{"sweep", "varied", "--output", "good2"}, 0, ""}}) {
    Arguments all{"compare"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramRun finished = run(all);
    EXPECT_EQ(finished.exit_code, exit_code) << message << finished.errors;
    EXPECT_THAT(finished.errors, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(finished.errors, '\n'), exit_code == 0 ? 0 : 1);
  }
  EXPECT_FALSE(std::filesystem::exists("results")) << "refused before a folder is made";
}

}  // namespace
}  // namespace nlcwfs
