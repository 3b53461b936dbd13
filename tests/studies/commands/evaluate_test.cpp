// Tests of evaluate: one design's performance on the configured screens.
#include "results/fits/fits_cube.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/setup.hpp"
#include "tests/studies/run_results.hpp"

#include <numbers>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;
using Json = nlohmann::json;

using Evaluate = Program;

TEST_F(Evaluate, LeavesItsFiles) {
  const ProgramRun finished = done("evaluate", "run");
  EXPECT_THAT(names_in("run"),
              UnorderedElementsAreArray(with_closer_look(
                  {"archive.sqlite", "config.cfg", "report.html", "screens.csv", "summary.json"})));
  EXPECT_THAT(finished.output, AllOf(StartsWith("0.5 m telescope at 532 nm, D/r0 = 4"),
                                     HasSubstr("residual WFE, nm"), HasSubstr("2 screens"),
                                     EndsWith("Results are in run.\n")));

  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "evaluate");
  EXPECT_EQ(json.at("version"), version());
  EXPECT_EQ(json.at("config").size(), configuration_keys().size());
  EXPECT_EQ(json["config"].at("detector.pupil_pixels"), "16");
  EXPECT_TRUE(json["config"].at("seeing.outer_scale").is_null());
  expect_design_of_the_contract(json.at("design"));
  EXPECT_EQ(json["design"]["planes_m"], (Json{-180e3, 180e3, -47e3, 47e3}));
  EXPECT_EQ(json["design"]["performance"]["screens"], 2);

  EXPECT_EQ(archived("run", "SELECT count(*) FROM evaluations"), 1.0);
  EXPECT_EQ(archived("run", "SELECT cost FROM evaluations"), json["design"]["cost"]["mean"]);
  EXPECT_EQ(archived("run",
                     "SELECT json_extract(performance, '$.total_wfe_nm.mean') "
                     "FROM evaluations"),
            json["design"]["performance"]["total_wfe_nm"]["mean"]);

  const auto table = read_table("run/screens.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_THAT(table[0], ElementsAre("screen", "residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm",
                                    "field_strehl", "loops", "fractional_loops", "seconds",
                                    "fft_count", "converged"));
  EXPECT_NEAR((std::stod(table[1][1]) + std::stod(table[2][1])) / 2.0,
              json["design"]["performance"]["residual_wfe_nm"]["mean"], 1e-9);
}

TEST_F(Evaluate, ADesignThatBreaksALimitIsWarnedOf) {
  for (const char* command : {"evaluate", "optimize", "sweep"}) {
    const std::string output =
        done(command, command, {"--objective.limits", "plane_count<2,loops>0,loops<1"}).output;
    EXPECT_THAT(output,
                AllOf(HasSubstr("warning: objective.limits asks for plane_count below 2, which is "
                                "4.00 +- 0.00\n"),
                      HasSubstr("asks for loops below 1"), Not(HasSubstr("loops above"))))
        << command;
  }
}

TEST_F(Evaluate, ScreensFromAFileAreTheSimulatedOnes) {
  done("evaluate", "simulated");
  done("screens", "screens");
  done("evaluate", "from_file", {"--screens.file", "screens/screens.fits"});
  const Json expected = summary("simulated")["design"]["performance"];
  // The file's have no piston, which changes the last bits of the fields.
  expect_same_performance(summary("from_file")["design"]["performance"], expected, 1e-6);

  FitsCube cube = read_fits_cube("screens/screens.fits", "screens.file");
  for (Image<double>& screen : cube.slices) screen *= 532e-9 / (2.0 * std::numbers::pi);
  cube.unit = "m";
  write_fits_cube("metres.fits", cube);
  done("evaluate", "from_metres", {"--screens.file", "metres.fits"});
  expect_same_performance(summary("from_metres")["design"]["performance"], expected, 1e-6);
}

TEST_F(Evaluate, AFileDecidesHowManyScreensThereAre) {
  done("screens", "screens", {"--screens.count", "3"});
  done("evaluate", "run", {"--screens.file", "screens/screens.fits", "--screens.count", "7"});
  EXPECT_EQ(summary("run")["design"]["performance"]["screens"], 3);
}

TEST_F(Evaluate, ScreensOfAnotherSamplingAreResampledWithANote) {
  done("screens", "fine", {"--simulation.pupil_samples", "64"});
  const ProgramRun finished = done("evaluate", "run", {"--screens.file", "fine/screens.fits"});
  EXPECT_THAT(finished.output, HasSubstr("note: fine/screens.fits: 64 x 64 samples were resampled "
                                         "to the truth's 32 x 32\n"));
  EXPECT_THAT(done("optimize", "best", {"--screens.file", "fine/screens.fits"}).output,
              AllOf(HasSubstr("note: fine/screens.fits: 64 x 64"),
                    HasSubstr("note: the verification is on simulated screens")));
  done("screens", "equal");
  EXPECT_THAT(done("evaluate", "unchanged", {"--screens.file", "equal/screens.fits"}).output,
              Not(HasSubstr("note:")));
}

TEST_F(Evaluate, ThePapersPresetRunsOnItsMatchedTruth) {
  // A file would override the preset's window.
  std::filesystem::remove("tiny.cfg");
  std::ofstream("tiny.cfg") << "[detector]\npupil_pixels = 16\n[screens]\ncount = 2\n";
  const ProgramRun finished = done("evaluate", "run", {"--preset", "paper"});
  EXPECT_THAT(finished.output, HasSubstr("matched truth"));
  const Json design = summary("run")["design"];
  EXPECT_EQ(design["detector_window"], 4.0);
  for (const double energy : design["performance"]["captured_energy"]) {
    EXPECT_NEAR(energy, 1.0, 1e-12) << "the whole periodic grid is measured";
  }
}

TEST_F(Evaluate, ScreensOfAnotherWavelengthAreTheSamePath) {
  done("screens", "at-1um", {"--telescope.wavelength", "1um"});
  const ProgramRun finished = done("evaluate", "run", {"--screens.file", "at-1um/screens.fits"});
  EXPECT_THAT(finished.output,
              HasSubstr("note: at-1um/screens.fits: its radians are at WAVELEN = 1 "
                        "um; the same optical path has 1.88 times as many at 532 "
                        "nm\n"));
  FitsCube cube = read_fits_cube("at-1um/screens.fits", "screens.file");
  for (Image<double>& screen : cube.slices) screen *= 1e-6 / (2.0 * std::numbers::pi);
  cube.unit = "m";
  write_fits_cube("metres.fits", cube);
  done("evaluate", "metres", {"--screens.file", "metres.fits"});
  EXPECT_NEAR(summary("run")["design"]["performance"]["residual_wfe_nm"]["mean"],
              summary("metres")["design"]["performance"]["residual_wfe_nm"]["mean"], 1e-6);
}

TEST_F(Evaluate, RefusesScreensOfAnotherDiameter) {
  done("screens", "of-2m", {"--telescope.diameter", "2m"});
  const ProgramRun refused = run({"evaluate", "--config", "tiny.cfg", "--output", "run",
                                  "--screens.file", "of-2m/screens.fits"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors,
              HasSubstr("screens.file = of-2m/screens.fits: its DIAMETER is 2 m, and "
                        "telescope.diameter 500 mm; set that"));
  EXPECT_FALSE(std::filesystem::exists("run"));
}

TEST_F(Evaluate, SaysWhereADesignDoesNotWorkAsASensor) {
  const std::string verdict = "This design does not work as a sensor: ";
  const auto expect_futile = [&](const std::string& folder, const Arguments& more,
                                 const std::string& why) {
    EXPECT_THAT(done("evaluate", folder, more).output, HasSubstr("warning: " + verdict + why));
    EXPECT_THAT(std::string(summary(folder)["design"]["futility"]), StartsWith(verdict + why));
    EXPECT_THAT(contents(folder + "/report.html"), HasSubstr(verdict + why));
  };
  expect_futile("dark", {"--detector.photons", "1e-3"}, "0.001 photons a frame");
  // Nothing is seen in the pupil itself.
  expect_futile("in-pupil", {"--sensor.planes", "-1nm,1nm,2nm,-2nm"}, "its wrapped error, ");
  expect_futile("strong", {"--seeing.d_over_r0", "40"}, "its wrapped error, ");
  EXPECT_THAT(done("evaluate", "good").output, Not(HasSubstr("does not work")));
  EXPECT_TRUE(summary("good")["design"]["futility"].is_null());
  EXPECT_THAT(done("evaluate", "short", {"--reconstruction.max_loops", "1"}).output,
              HasSubstr("warning: none of 2 wavefronts converged in reconstruction.max_loops = 1"));
}

TEST_F(Evaluate, SaysWhichSeeingItAssumesForATelescope) {
  const std::string note = "note: no seeing was given for this telescope: D/r0 = 4 is assumed, ";
  EXPECT_THAT(done("evaluate", "a", {"--telescope.diameter", "2m"}).output,
              HasSubstr(note + "r0 = 500 mm at 532 nm; give seeing.fried_parameter"));
  EXPECT_THAT(done("evaluate", "b", {"--telescope.wavelength", "850nm"}).output, HasSubstr(note));
  EXPECT_THAT(done("evaluate", "c").output, Not(HasSubstr("note: no seeing")));
  for (const char* seeing : {"d_over_r0=4", "fried_parameter=50cm", "fwhm=0.2"}) {
    EXPECT_THAT(done("evaluate", fmt::format("with-{}", seeing),
                     {"--telescope.diameter", "2m", fmt::format("--seeing.{}", seeing)})
                    .output,
                Not(HasSubstr("note: no seeing")));
  }
}

TEST_F(Evaluate, HasNumbersAtTheEndsOfWhatIsAllowed) {
  const std::vector<Arguments> ends{
      {"--telescope.diameter", "0.1mm"},  {"--telescope.diameter", "1km"},
      {"--telescope.wavelength", "1nm"},  {"--telescope.wavelength", "1mm"},
      {"--seeing.d_over_r0", "1e-3"},     {"--telescope.relay_beam_diameter", "1um"},

      {"--objective.wfe_scale", "1e-12"}, {"--sensor.planes", "1e-300,-1e-300"}};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::string folder = fmt::format("run-{}", i);
    EXPECT_THAT(done("evaluate", folder, ends[i]).output,
                Not(testing::ContainsRegex("[ +-](nan|inf)[ \n]")))
        << ends[i][0] << ' ' << ends[i][1];
    EXPECT_TRUE(summary(folder)["design"]["performance"]["residual_wfe_nm"]["mean"].is_number());
  }
}

}  // namespace
}  // namespace nlcwfs
