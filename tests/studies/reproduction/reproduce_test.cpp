// Tests: a reproduction runs, goes on, and says what came of the claims.
#include "studies/reproduction/figures.hpp"
#include "tests/message_of.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsSupersetOf;
using OrderedJson = nlohmann::ordered_json;

std::vector<PlannedRun> runs_of(const std::string& figures) {
  Configuration configuration;
  configuration.set("reproduce.figures", figures, "here");
  return planned_runs(configuration);
}

TEST(ReproductionPlan, EveryRunHasItsFolderAndItsSetUp) {
  const std::vector<PlannedRun> runs = runs_of("3,4,5,6,7,8,scaling,response,numerics");
  std::set<std::string> folders;
  for (const PlannedRun& run : runs) {
    EXPECT_TRUE(folders.insert(run.folder).second) << run.folder;
    if (run.folder.find("/paper") != std::string::npos) {
      EXPECT_EQ(run.configuration.choice("reconstruction.stopping"), "rms_change") << run.folder;
      EXPECT_EQ(run.configuration.choice("source.aberration"), "phase");
      EXPECT_NE(run.configuration.choice("simulation.truth"), "extended");
    }
    if (run.folder.find("/extended") != std::string::npos) {
      EXPECT_EQ(run.configuration.choice("reconstruction.stopping"), "difference") << run.folder;
      EXPECT_EQ(run.configuration.choice("source.aberration"), "path");
      EXPECT_EQ(run.configuration.choice("simulation.truth"), "extended");
    }
  }
}

TEST(ReproductionPlan, FiguresShareTheirRuns) {
  const auto count = [](const std::string& figures) { return runs_of(figures).size(); };
  EXPECT_EQ(count("3"), 6u + 4u);
  EXPECT_EQ(count("4"), 6u + 6u);
  EXPECT_EQ(count("3,4"), 10u + 8u);  // both have the map and the design of four planes, D/r0 = 4
  EXPECT_EQ(count("7"), 2u);
  EXPECT_EQ(count("7,8"), count("8"));
}

TEST(ReproductionPlan, HasThePapersNumbers) {
  const std::vector<PlannedRun> runs = runs_of("5,8");
  const auto find = [&](const std::string& folder) {
    return std::ranges::find(runs, folder, &PlannedRun::folder)->configuration;
  };
  const std::vector<double> fifth = find("figure-5/paper").axis("sweep.z5").value();
  EXPECT_EQ(fifth.size(), 66u);
  EXPECT_THAT(fifth, IsSupersetOf({-250e3, 0.0, 180e3, 250e3}));
  const Configuration wide = find("figure-8/paper-wide");
  EXPECT_EQ(wide.bands("source.bands")[1].centre(), 600e-9);
  EXPECT_EQ(wide.integer("source.wavelengths"), 40);
  EXPECT_EQ(wide.integer("detector.pupil_pixels"), 128);
  EXPECT_EQ(find("figure-8/paper-monochromatic").bands("source.bands").size(), 0u);
}

TEST(ReproductionPlan, IsThePapersWhateverIsGiven) {
  Configuration preset;
  preset.apply_preset("paper");
  for (const PlannedRun& run : planned_runs(preset)) {
    if (run.folder.find("/extended") == std::string::npos) continue;
    EXPECT_EQ(run.configuration.choice("reconstruction.stopping"), "difference");
  }
  for (const auto& [key, value] : {std::pair{"telescope.diameter", "8.2m"},
                                   {"seeing.d_over_r0", "8"},
                                   {"sensor.planes", "-20km,20km"},
                                   {"sweep.z_near", "30km,60km"}}) {
    Configuration other;
    other.set(key, value, "here");
    EXPECT_THAT(message_of([&] { (void)planned_runs(other); }),
                AllOf(HasSubstr(key), HasSubstr("reproduce takes the paper's own")));
  }
}

TEST(ReproductionPlan, TheFifthPlaneIsAtEachDistanceOnce) {
  for (const char* count : {"4", "25", "32", "50"}) {
    Configuration configuration;
    configuration.set("reproduce.grid", count, "here");
    for (const PlannedRun& run : planned_runs(configuration)) {
      if (run.folder != "figure-5/paper") continue;
      const std::vector<double> planes = *run.configuration.axis("sweep.z5");
      EXPECT_EQ(std::set<double>(planes.begin(), planes.end()).size(), planes.size()) << count;
    }
  }
}

TEST(ReproductionPlan, HasAllFiguresByDefault) {
  std::vector<std::string> names;
  for (const PaperFigure& figure : paper_figures()) names.emplace_back(figure.name);
  EXPECT_THAT(figures_of(Configuration()), testing::UnorderedElementsAreArray(names));
}

TEST(ReproductionPlan, RefusesFiguresThatThePaperDoesNotHave) {
  EXPECT_THAT(message_of([] { (void)runs_of("3,9"); }),
              AllOf(HasSubstr("reproduce.figures"), HasSubstr("3, 4, 5")));
}

using Claims = ScratchFolder;

/// The residual of the design moved to each telescope, in waves.
void write_scaling(double last) {
  for (const PlannedRun& run : runs_of("scaling")) {
    const double residual = (run.folder.ends_with("8.2m-1650nm") ? last : 0.01) *
                            run.configuration.length("telescope.wavelength");
    std::filesystem::create_directories(run.folder);
    std::ofstream(run.folder + "/summary.json") << OrderedJson{
        {"config",
         {{"telescope.wavelength", run.configuration.value_text("telescope.wavelength")}}},
        {"design",
         {{"performance",
           {{"residual_wfe_nm", {{"mean", residual}, {"standard_error", 0.0}}},
            {"loops", {{"mean", 5.0}, {"standard_error", 0.0}}}}}}}};
  }
}

ClaimVerdict scaling_verdict() {
  const std::vector<Claim> claims = checked_claims(ReproducedRuns("."), {"scaling"});
  EXPECT_EQ(claims.size(), 1u);
  return claims.front().findings.at(StudySetup::paper).verdict;
}

TEST_F(Claims, AreHeldAgainstTheNumbers) {
  write_scaling(0.01);
  EXPECT_EQ(scaling_verdict(), ClaimVerdict::reproduced);
  write_scaling(0.0103);
  EXPECT_EQ(scaling_verdict(), ClaimVerdict::in_trend);
  write_scaling(0.02);
  EXPECT_EQ(scaling_verdict(), ClaimVerdict::not_reproduced);
}

TEST_F(Claims, NameTheFileThatIsMissing) {
  try {
    (void)scaling_verdict();
    FAIL() << "there is nothing to read";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scaling/paper-0.5m-532nm/summary.json"));
  }
}

class Reproduce : public Program {
 protected:
  /// As of every program's test, but without axes of a sweep.
  void SetUp() override {
    Program::SetUp();
    std::string text = contents("tiny.cfg");
    text.erase(text.find("[sweep]"));
    std::ofstream("tiny.cfg") << text;
  }

  /// How many pictures the report in this folder shows; all of them must be there.
  static std::size_t pictures_in(const std::string& folder) {
    const std::string report = contents(folder + "/report.md");
    std::size_t pictures = 0;
    for (auto at = report.find("]("); at != std::string::npos; at = report.find("](", at + 1)) {
      const std::string file = report.substr(at + 2, report.find(')', at) - at - 2);
      EXPECT_TRUE(std::filesystem::exists(folder + "/" + file)) << file;
      ++pictures;
    }
    return pictures;
  }
};

const std::vector<std::string> small{"--figure",         "4", "--figure", "scaling",
                                     "--reproduce.grid", "4"};

TEST_F(Reproduce, LeavesItsRunsAndOneReport) {
  const ProgramRun finished = done("reproduce", "run", small);
  EXPECT_THAT(names_in("run"),
              IsSupersetOf({"archive.sqlite", "claims.csv", "config.cfg", "figure-3", "figure-4",
                            "report.html", "report.md", "scaling", "summary.json"}));
  for (const auto& entry : std::filesystem::recursive_directory_iterator("run")) {
    if (entry.path().filename() != "report.html") continue;
    EXPECT_EQ(entry.path(), "run/report.html") << "a part has a page of its own";
  }
  EXPECT_THAT(finished.output, AllOf(HasSubstr("Figure 4: Three planes take more loops."),
                                     EndsWith("Results are in run.\n")));
  const nlohmann::json json = summary("run");
  EXPECT_EQ(json["runs"].size(), 6u + 6u + 8u);
  EXPECT_EQ(json["claims"].size(), 5u);
  for (const auto& claim : json["claims"]) {
    if (claim["figure"] == "scaling") {
      EXPECT_EQ(claim["papers_number"], "found accurate");
      EXPECT_EQ(claim["paper"]["verdict"], "reproduced");
    }
  }
  EXPECT_EQ(pictures_in("run"), 2u * 3u * 3u);
}

TEST_F(Reproduce, RunsEveryStudyOfThePaper) {
  // The truth has as many samples as figures 6 and 8 have pixels.
  const ProgramRun finished =
      run({"reproduce", "--config", "tiny.cfg", "--output", "run", "--quiet", "--reproduce.grid",
           "4", "--response.frequencies", "2,6", "--simulation.pupil_samples", "128"});
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(pictures_in("run"), 12u + 18u + 4u + 2u + 2u + 2u + 5u);
  const nlohmann::json claims = summary("run")["claims"];
  std::set<std::string> figures;
  for (const auto& claim : claims) {
    figures.insert(claim["figure"]);
    // What two screens can tell, and holds in both set-ups.
    for (const char* setup : {"paper", "extended"}) {
      if (claim["figure"] != "scaling" && claim["claim"] != "The floor rises with the bandwidth.") {
        continue;
      }
      EXPECT_NE(claim[setup]["verdict"], "not reproduced") << claim;
    }
  }
  EXPECT_EQ(figures, (std::set<std::string>{"3", "4", "5", "6", "7", "8", "scaling"}));
  for (const std::string& figure : figures) {
    const std::filesystem::path alone = "alone/" + figure;
    for (const PlannedRun& part : runs_of(figure)) {
      std::filesystem::create_directories((alone / part.folder).parent_path());
      std::filesystem::create_directory_symlink(std::filesystem::absolute("run/" + part.folder),
                                                alone / part.folder);
    }
    EXPECT_NO_THROW((void)checked_claims(ReproducedRuns(alone), {figure})) << figure;
  }
}

TEST_F(Reproduce, ItsConfigurationReproducesItOnAnyNumberOfThreads) {
  done("reproduce", "first", {"--figure", "scaling", "--screens.seed", "7", "--threads", "2"});
  const ProgramRun again =
      run({"reproduce", "--config", "first/config.cfg", "--output", "again", "--threads", "1"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(repeatable_summary("first"), repeatable_summary("again"));
  EXPECT_EQ(names_in("first"), names_in("again"));
}

TEST_F(Reproduce, RefusesOneWavefront) {
  const ProgramRun refused = run({"reproduce", "--screens.count", "1", "--output", "run"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, AllOf(HasSubstr("screens.count"), HasSubstr("at least 2")));
  EXPECT_FALSE(std::filesystem::exists("run"));
}

TEST_F(Reproduce, GoesOnWhereItWasKilled) {
  done("reproduce", "whole", small);
  // As a killed run leaves it: some parts whole, one begun, the others not there.
  std::filesystem::copy("whole", "run", std::filesystem::copy_options::recursive);
  std::filesystem::remove("run/summary.json");
  std::filesystem::remove("run/report.md");
  std::filesystem::remove("run/figure-4/paper-without-p3/summary.json");
  std::filesystem::remove("run/scaling/paper-0.5m-850nm/summary.json");
  std::filesystem::remove_all("run/figure-4/extended-without-p1");
  const auto kept = std::filesystem::last_write_time("run/figure-4/paper-without-p1/summary.json");
  const ProgramRun resumed = run({"reproduce", "--resume", "run"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(std::filesystem::last_write_time("run/figure-4/paper-without-p1/summary.json"), kept);
  nlohmann::json ours = repeatable_summary("run")["claims"];
  nlohmann::json theirs = repeatable_summary("whole")["claims"];
  for (nlohmann::json* claims : {&ours, &theirs}) {
    for (auto& claim : *claims) {
      if (claim["papers_number"] == "88 %") claim = nullptr;  // of the clock
    }
  }
  EXPECT_EQ(ours, theirs);
}

}  // namespace
}  // namespace nlcwfs
