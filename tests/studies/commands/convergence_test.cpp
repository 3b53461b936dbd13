// Tests of convergence: how one design's wavefront error falls from loop to loop.
#include "tests/studies/program.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

using Convergence = Program;

TEST_F(Convergence, LeavesItsFiles) {
  const ProgramRun finished = done("convergence", "run", {"--reconstruction.max_loops", "9"});
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "convergence.csv", "convergence.png",
                          "convergence.svg", "report.html", "screens.csv", "summary.json"));
  EXPECT_THAT(finished.output, AllOf(StartsWith("0.5 m telescope"), HasSubstr("After each loop"),
                                     EndsWith("Results are in run.\n")));
  const nlohmann::json residuals = summary("run").at("residual_after_loops_nm");
  for (const char* name : {"mean", "standard_error", "standard_deviation", "screens"}) {
    EXPECT_EQ(residuals.at(name).size(), 9u) << name;
  }
  for (std::size_t loop = 0; loop < 9; ++loop) {
    const nlohmann::json& screens = residuals["screens"][loop];
    ASSERT_EQ(screens.size(), 2u);
    const double first = screens[0];
    const double second = screens[1];
    EXPECT_NEAR(residuals["mean"][loop], 0.5 * (first + second), 1e-9);
    EXPECT_NEAR(residuals["standard_deviation"][loop], std::abs(first - second) / std::sqrt(2.0),
                1e-9);
    EXPECT_NEAR(residuals["standard_error"][loop], 0.5 * std::abs(first - second), 1e-9);
  }
  EXPECT_GT(residuals["mean"][0], residuals["mean"][8]);
  const nlohmann::json aberrations = summary("run").at("aberrations_nm");
  for (const double aberration : aberrations) {
    EXPECT_GT(aberration, residuals["mean"][8]);
  }
}

TEST_F(Convergence, GoesOnWhereTheReconstructionWouldHaveStopped) {
  // One that stops at its last loop ends with the residual of that loop.
  done("evaluate", "three", {"--reconstruction.max_loops", "3", "--reconstruction.tolerance", "0"});
  done("convergence", "run", {"--reconstruction.tolerance", "1um"});
  const nlohmann::json json = summary("run");
  EXPECT_EQ(json["residual_after_loops_nm"]["mean"].size(), 20u);
  EXPECT_EQ(json["design"]["performance"]["loops"]["mean"], 1.0);
  EXPECT_NEAR(json["residual_after_loops_nm"]["mean"][2],
              summary("three")["design"]["performance"]["residual_wfe_nm"]["mean"], 1e-9);
}

TEST_F(Convergence, BroadbandLightHasAFloor) {
  done("convergence", "one");
  done("convergence", "many", {"--source.bands", "400nm:664nm", "--source.wavelengths", "5"});
  const auto floor = [](const char* folder) {
    return double(summary(folder)["residual_after_loops_nm"]["mean"][19]);
  };
  EXPECT_GT(floor("many"), floor("one"));
}

}  // namespace
}  // namespace nlcwfs
