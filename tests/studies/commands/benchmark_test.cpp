// Tests of benchmark: how fast this machine is at the configuration.
#include "tests/studies/program.hpp"

#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

class BenchmarkStudy : public Program {
 protected:
  /// `benchmark --config tiny.cfg more...`, which must succeed and leave nothing behind.
  static std::string printed(const Arguments& more = {}) {
    // Where runs put what they print.
    const auto without_texts = [] {
      for (const char* text : {"output.txt", "errors.txt"}) std::filesystem::remove(text);
      return names_in(".");
    };
    const std::vector<std::string> before = without_texts();
    Arguments arguments{"benchmark", "--config", "tiny.cfg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_EQ(finished.errors, "");
    EXPECT_EQ(without_texts(), before);
    return finished.output;
  }

  static Json timing(const std::string& folder) { return summary(folder).at("timing"); }
};

TEST_F(BenchmarkStudy, SaysWhatItTimedAndLeavesNothing) {
  const std::string output = printed({"--threads", "2"});
  EXPECT_THAT(output,
              AllOf(StartsWith("0.5 m telescope at 532 nm, D/r0 = 4"),
                    HasSubstr("\n4 planes of 32 x 32 pixels, reconstruction grid 64 x 64\n"),
                    HasSubstr("\n2 screens of 32 x 32 samples, extended truth, "),
                    HasSubstr(" of this design; peak memory of this run ")));
  EXPECT_THAT(output, Not(HasSubstr("Timed on"))) << "all screens were timed";
}

TEST_F(BenchmarkStudy, HasTwoFiguresAboveZeroInEveryRow) {
  std::istringstream lines(printed({"--threads", "1"}));
  std::vector<std::string> headings;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    if (!line.starts_with("  ")) continue;
    ASSERT_EQ(line.size(), 80u) << line;
    const std::string heading = line.substr(0, 50);
    headings.push_back(heading.substr(0, heading.find_last_not_of(' ') + 1));
    if (headings.size() == 1 || headings.back().ends_with("6 designs")) continue;
    for (const auto column : {50u, 65u}) {
      EXPECT_GT(std::stod(line.substr(column, 15)), 0.0) << line;
    }
  }
  EXPECT_THAT(
      headings,
      ElementsAre("  precision of the reconstruction", "  loops per second, 1 thread alone",
                  "    ms per loop", "  ms to make one screen's images, always in double",
                  "  ms to reconstruct from them", "    in loops",
                  "  seconds per design on 2 screens", "    designs per minute",
                  "    search of 6 designs", "  objective.fft_rate of one thread alone, 1/s"));
}

TEST_F(BenchmarkStudy, WritesOnlyIntoAFolderOfTheUsers) {
  const ProgramRun finished = done("benchmark", "run");
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "report.html", "summary.json"));
  EXPECT_THAT(finished.output, EndsWith("Results are in run.\n"));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "benchmark");
  EXPECT_EQ(json.at("grid_samples"), 64);
  EXPECT_EQ(json.at("detector_pixels"), 32);
  EXPECT_EQ(json.at("truth_samples"), 32);
  EXPECT_EQ(json.at("plane_count"), 4);
  EXPECT_EQ(json.at("screens"), 2);
}

TEST_F(BenchmarkStudy, HasFiguresThatFitTogether) {
  done("benchmark", "run", {"--threads", "1"});
  const Json timing = BenchmarkStudy::timing("run");
  EXPECT_EQ(timing.at("threads"), 1);
  EXPECT_GE(timing.at("repetitions"), 1);
  EXPECT_GE(timing.at("timed_screens"), 1);
  EXPECT_GT(timing.at("peak_memory_mib"), 1.0);
  for (const char* precision : {"double", "single"}) {
    const Json& speed = timing.at(precision);
    const auto value = [&](const char* name) { return speed.at(name).get<double>(); };
    EXPECT_GT(value("data_seconds"), 0.0);
    EXPECT_GT(value("design_seconds"), 0.0);
    EXPECT_GE(value("loops"), 1.0);
    EXPECT_NEAR(value("loops_per_second_one_thread") * value("loop_seconds_one_thread"), 1.0, 1e-9);
    EXPECT_NEAR(value("loops_per_second") * value("loop_seconds"), 1.0, 1e-9);
    EXPECT_NEAR(value("loop_seconds") * value("loops") / value("reconstruction_seconds"), 1.0,
                1e-9);
    EXPECT_NEAR(value("designs_per_minute") * value("design_seconds"), 60.0, 1e-6);
    EXPECT_NEAR(value("search_seconds") / value("design_seconds"), 6.0, 1e-9);
    // A loop of four planes on 64 x 64 samples: five hops of two transforms.
    const double operations = 10.0 * 5.0 * 64 * 64 * 12;
    EXPECT_NEAR(value("fft_rate") * value("loop_seconds_one_thread") / operations, 1.0, 0.5)
        << "medians of the same evaluations, but not of the same one";
  }
}

TEST_F(BenchmarkStudy, TakesAShareOfManyScreens) {
  const ProgramRun finished =
      done("benchmark", "run", {"--screens.count", "100000", "--threads", "1"});
  EXPECT_THAT(finished.output, AllOf(HasSubstr("\n100000 screens of 32 x 32 samples"),
                                     HasSubstr("seconds per design on 100000 screens"),
                                     HasSubstr(" of the screens and scaled to all of them.\n")));
  const Json timing = BenchmarkStudy::timing("run");
  EXPECT_LE(timing.at("timed_screens"), 16);
  // Of every screen, making its images is a part.
  EXPECT_GT(timing["single"]["design_seconds"], 1e5 * double(timing["single"]["data_seconds"]));
}

TEST_F(BenchmarkStudy, EndsASearchAtItsTimeLimit) {
  EXPECT_THAT(done("benchmark", "run", {"--search.time_limit", "1us"}).output,
              HasSubstr("search of at most 6 designs"));
  EXPECT_EQ(timing("run")["double"]["search_seconds"], 1e-6);
}

TEST_F(BenchmarkStudy, TakesTheScreensOfAFile) {
  done("screens", "screens", {"--screens.count", "3", "--simulation.pupil_samples", "64"});
  EXPECT_THAT(printed({"--screens.file", "screens/screens.fits", "--screens.count", "7"}),
              AllOf(StartsWith("note: screens/screens.fits: 64 x 64 samples were resampled"),
                    HasSubstr("\n3 screens of 32 x 32 samples")));
}

TEST_F(BenchmarkStudy, TakesThePapersPreset) {
  EXPECT_THAT(printed({"--preset", "paper"}),
              HasSubstr("\n2 screens of 16 x 16 samples, matched truth, "));
}

}  // namespace
}  // namespace nlcwfs
