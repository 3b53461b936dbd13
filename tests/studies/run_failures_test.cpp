// What becomes of a run whose designs fail where they are verified, that another process works in,
// or whose trials another run takes over.

#include "objectives/design_space.hpp"
#include "results/archive/archive.hpp"
#include "results/archive/folder_lock.hpp"
#include "results/tables/design_summary.hpp"
#include "studies/settings/trials.hpp"
#include "tests/sqlite_query.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <iterator>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using OrderedJson = nlohmann::ordered_json;

/// Changes an archive as another program would.
void alter(const std::string& path, const char* sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

class RunFailures : public Program {
 protected:
  /// The runs here verify three designs.
  void SetUp() override {
    Program::SetUp();
    std::ofstream("tiny.cfg", std::ios::app) << "z_far = 100km,150km\n";
    std::ofstream("tiny.cfg", std::ios::app) << "[verify]\ncandidates = 3\n";
  }

  static OrderedJson summary() { return OrderedJson::parse(contents("run/summary.json")); }

  static Configuration configuration() {
    Configuration configuration;
    configuration.read_file("run/config.cfg");
    return configuration;
  }

  /// From now on the archive knows that the design failed in a trial, and the run has not ended.
  static void let_fail(
      const OrderedJson& design,
      const DesignTrial& trial = TrialSetup(configuration()).make_verification(false)) {
    Archive::reopened("run/archive.sqlite")
        .keep(trial.identity(), exact_text(design_from_json(design)),
              {.performances = {}, .failure = "the light went out"});
    std::filesystem::remove("run/summary.json");
  }

  static std::vector<std::string> failures() {
    std::vector<std::string> all;
    for (const ArchivedEvaluation& row : Archive::reopened("run/archive.sqlite").evaluations()) {
      if (row.stage == "verify" && !row.failure.empty()) all.push_back(row.failure);
    }
    return all;
  }

  /// Lets the best design of a finished run fail, then goes on with it.
  static void expect_the_next_is_the_best(const std::string& command) {
    done(command, "run");
    const OrderedJson before = summary()["ranking"];
    ASSERT_EQ(before.size(), 3u);
    let_fail(before[0]);
    const ProgramRun resumed = run({command, "--resume", "run"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_THAT(
        resumed.errors,
        AllOf(HasSubstr("the design of the planes "),
              HasSubstr(" km failed on the fresh screens: the light went out; it is left out\n")));
    const OrderedJson after = summary()["ranking"];
    ASSERT_EQ(after.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(after[i]["planes_m"], before[i + 1]["planes_m"]);
      EXPECT_EQ(after[i]["cost"], before[i + 1]["cost"]);
    }
    EXPECT_THAT(failures(), testing::ElementsAre("the light went out"));
    EXPECT_EQ(summary()["interrupted"], false);
  }
};

/// All trials of an archive, with what clocks measured: two simulations never have equal ones.
std::vector<Row> trials_of(const std::string& folder) {
  return query(folder + "/archive.sqlite",
               "SELECT trial, design, hex(performances), failure FROM trials ORDER BY 1, 2");
}

TEST_F(RunFailures, ASweepLeavesOutADesignThatFailsInTheVerification) {
  expect_the_next_is_the_best("sweep");
}

TEST_F(RunFailures, ASearchLeavesOutADesignThatFailsInTheVerification) {
  expect_the_next_is_the_best("optimize");
  // How far its variables may move, too, is that of the design that is the best now.
  const OrderedJson ranges = summary()["indistinguishable"];
  ASSERT_FALSE(ranges.empty());
  std::vector<double> planes = summary()["best"]["planes_m"];
  EXPECT_NEAR(ranges["z_far"]["best"].get<double>(), *std::ranges::max_element(planes), 1e-6);
}

TEST_F(RunFailures, ATradeLeavesOutADesignThatFailsInTheVerification) {
  const Arguments small{"--trade.budget", "16", "--trade.population", "8"};
  done("trade", "run", small);
  const OrderedJson before = summary()["front"];
  ASSERT_GE(before.size(), 2u);
  let_fail(before[0]);
  const ProgramRun resumed = run({"trade", "--resume", "run"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(summary()["front"].size(), before.size() - 1);
  EXPECT_EQ(summary()["interrupted"], false);
}

TEST_F(RunFailures, WithoutADesignThatIsVerifiedARunSaysHowToKeepWhatItHas) {
  done("sweep", "run");
  const OrderedJson ranking = summary()["ranking"];
  for (const OrderedJson& design : ranking) let_fail(design);
  const ProgramRun resumed = run({"sweep", "--resume", "run"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_THAT(resumed.errors,
              AllOf(HasSubstr("nlcwfs: failed: the design of the planes "),
                    EndsWith(" km failed on the fresh screens: the light went out; to try it "
                             "again: nlcwfs sweep --resume run\n")));
  // A new run tries these again, and takes over the others.
  done("sweep", "again", {"--reuse", "run"});
  const std::vector<Row> trials = trials_of("run");
  const std::vector<Row> again = trials_of("again");
  std::vector<Row> taken_over;
  std::ranges::set_intersection(trials, again, std::back_inserter(taken_over));
  EXPECT_EQ(taken_over.size(), 4u);
  EXPECT_EQ(again.size(), 4u + 3u);
  EXPECT_EQ(OrderedJson::parse(contents("again/summary.json"))["ranking"].size(), 3u);
}

TEST_F(RunFailures, ASearchWhoseScanFailsSaysHowToGoOn) {
  done("optimize", "run");
  let_fail(summary()["best"], TrialSetup(configuration()).make_scan(false));
  const ProgramRun resumed = run({"optimize", "--resume", "run"});
  EXPECT_EQ(resumed.exit_code, 3) << resumed.errors;
  EXPECT_THAT(resumed.output,
              AllOf(HasSubstr("Interrupted when the best design failed in the scan of how far its "
                              "variables may move: the light went out: "),
                    HasSubstr("Go on with: nlcwfs optimize --resume run\n")));
  EXPECT_EQ(summary()["interrupted"], true);
}

TEST_F(RunFailures, WhatIsNoStepOfASearchIsTriedAgain) {
  const ProgramRun failed = run(
      {"evaluate", "--config", "tiny.cfg", "--output", "run", "--simulation.time_limit", "1us"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.errors, HasSubstr("a wavefront took longer than simulation.time_limit"));
  Configuration patient = configuration();
  patient.set("simulation.time_limit", "1h", "here");
  std::ofstream("run/config.cfg") << patient.dump();
  const ProgramRun resumed = run({"evaluate", "--resume", "run"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
}

TEST_F(RunFailures, ASearchNeedsItsBaseline) {
  done("optimize", "run");
  let_fail(summary()["baseline"]);
  const ProgramRun resumed = run({"optimize", "--resume", "run"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_THAT(resumed.errors, HasSubstr("failed on the fresh screens"));
}

TEST_F(RunFailures, ARunIsOfOneProcess) {
  done("sweep", "run");
  std::filesystem::remove("run/summary.json");
  const std::vector<std::string> files = names_in("run");
  {
    const FolderLock another_run("run");
    const ProgramRun refused = run({"sweep", "--resume", "run"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.errors, HasSubstr("--resume = run: another run works in it"));
    EXPECT_EQ(names_in("run"), files);
  }
  EXPECT_EQ(run({"sweep", "--resume", "run"}).exit_code, 0);
}

TEST_F(RunFailures, AnotherRunsTrialsAreTakenOver) {
  done("sweep", "first");
  const std::vector<Row> trials = trials_of("first");
  ASSERT_EQ(trials.size(), 4u + 3u);
  // Another objective is another study of the same trials.
  done("sweep", "second", {"--objective.loop_weight", "0.3", "--reuse", "first"});
  EXPECT_EQ(trials_of("second"), trials);
  done("sweep", "alone");
  EXPECT_NE(trials_of("alone"), trials);
}

TEST_F(RunFailures, AResumedRunRemovesOnlyWhatItHasMade) {
  const std::vector<std::string> users{
      "law.json",  "figure-for-talk.png", "map-of-site.fits", "response-notes.csv", "front.csv",
      "report.md", "map-of-site.png",     "notes.txt.part",   "typical-values.fits"};
  for (const std::string command : {"evaluate", "sweep", "optimize"}) {
    std::filesystem::remove_all("run");
    done(command, "run");
    const std::vector<std::string> whole = names_in("run");
    OrderedJson stopped = summary();
    stopped["interrupted"] = true;
    std::ofstream("run/summary.json") << stopped;
    for (const std::string& name : users) std::ofstream("run/" + name) << "mine";
    const ProgramRun resumed = run({command, "--resume", "run"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    for (const std::string& name : users) {
      EXPECT_EQ(contents("run/" + name), "mine") << command << ' ' << name;
      std::filesystem::remove("run/" + name);
    }
    EXPECT_EQ(names_in("run"), whole);
  }
}

TEST_F(RunFailures, AResumedRunOverwritesNothingThatItHasNotMade) {
  done("sweep", "run");
  // As if it had been killed before it wrote its table, and the user had one of the name.
  std::filesystem::remove("run/summary.json");
  std::ofstream("run/sweep.csv") << "mine";
  alter("run/archive.sqlite", "DELETE FROM files WHERE name = 'sweep.csv'");
  const ProgramRun resumed = run({"sweep", "--resume", "run"});
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_THAT(resumed.errors, HasSubstr("--resume = run: has a file sweep.csv that the run has not "
                                        "made and would write; move it elsewhere\n"));
  EXPECT_EQ(contents("run/sweep.csv"), "mine");
}

TEST_F(RunFailures, ARunOfAnOlderVersionIsGoneOnWith) {
  done("evaluate", "run");
  const std::vector<std::string> whole = names_in("run");
  std::filesystem::remove("run/summary.json");
  alter("run/archive.sqlite", "DROP TABLE files");
  EXPECT_EQ(run({"evaluate", "--resume", "run"}).exit_code, 0);
  EXPECT_EQ(names_in("run"), whole);
}

}  // namespace
}  // namespace nlcwfs
