// Tests of the command reconstruct, run as a user does.
#include "model/detector.hpp"
#include "model/pupil.hpp"
#include "model/true_light.hpp"
#include "model/turbulence_screen.hpp"
#include "model/wavefront_metrics.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/tables/csv_table.hpp"
#include "tests/studies/program.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const Telescope telescope;
const std::string planes_text = "--sensor.planes=-180km,180km,-47km,47km";
constexpr int truth_samples = 64;

/// Frames such as a user has: 32 pixels across the pupil, four diameters wide, noisy, on a
/// background, each plane with a gain of its own.
class Reconstruct : public Program {
 protected:
  static constexpr double background = 20.0;
  static constexpr double photons = 1e6;

  void SetUp() override {
    Program::SetUp();
    std::ofstream("mine.cfg") << "[detector]\npupil_pixels = 32\nphotons = 1e6\n"
                                 "[reconstruction]\nmax_loops = 30\n"
                                 "[frames]\nbackground = 20\n";
    write_fits_cube("frames.fits", frames(2));
  }

  static SensorDesign design() {
    SensorDesign design;
    design.detector.pupil_pixels = 32;
    return design;
  }

  static PhaseScreen truth(int set) {
    return TurbulenceScreenGenerator({.fried_parameter = telescope.diameter / 4.0}, truth_samples,
                                     telescope.diameter, 8)
        .screen(set);
  }

  static FitsCube frames(int sets) {
    const TrueLight light(TruthModel::extended, telescope, design(), truth_samples);
    const std::vector<std::size_t> all{0, 1, 2, 3};
    const double photons_per_unit =
        photons / 4.0 * 4.0 / double(pupil_mask(truth_samples, 0.0).count());
    FitsCube cube{.unit = "adu", .slices = {}, .sets = std::size_t(sets)};
    for (int set = 0; set < sets; ++set) {
      std::vector<Image<double>> images = light.images(truth(set), all);
      for (std::size_t plane = 0; plane < images.size(); ++plane) {
        RandomStream stream = random_stream({4, std::uint64_t(set), plane});
        add_noise(images[plane], photons_per_unit, 0.0, stream);
        cube.slices.emplace_back(images[plane] * (1000.0 + 500.0 * double(plane)) + background);
      }
    }
    return cube;
  }

  static ProgramRun reconstruct(const std::string& folder, const Arguments& more = {}) {
    Arguments arguments{"reconstruct", "--frames",  "frames.fits", "--config",
                        "mine.cfg",    planes_text, "--output",    folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramRun finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    return finished;
  }

  /// RMS of a reconstructed phase less the truth, nm.
  static double residual_nm(const Image<double>& phase, int set) {
    const PupilMask mask = pupil_mask(32, 0.0);
    const Image<double> difference = mask.select(phase - block_average(truth(set), 2), 0.0);
    return piston_free_rms(difference, mask) * telescope.wavelength / (2.0 * std::numbers::pi) *
           1e9;
  }

  static void expect_refused(const Arguments& more, const std::string& key_and_value,
                             const std::string& allowed) {
    Arguments arguments{"reconstruct", "--config", "mine.cfg", "--output", "refused"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
    EXPECT_THAT(refused.errors,
                AllOf(StartsWith("nlcwfs: " + key_and_value + ": "), HasSubstr(allowed)));
    EXPECT_FALSE(std::filesystem::exists("refused"));
  }
};

TEST_F(Reconstruct, FindsThePhasesAsWellAsEvaluateSays) {
  const ProgramRun finished = reconstruct("run");
  EXPECT_THAT(finished.output, HasSubstr("Measured and predicted images agree"));
  EXPECT_THAT(finished.output, HasSubstr("2 sets: wavefront RMS"));
  EXPECT_THAT(finished.output, StartsWith("0.5 m telescope at 532 nm\n"));  // nobody gave a seeing

  // The same wavefronts and light, with other noise.
  write_fits_cube("truth.fits", {"rad", {truth(0), truth(1)}});
  ASSERT_EQ(run({"evaluate", "--config", "mine.cfg", planes_text, "--screens.file", "truth.fits",
                 "--simulation.pupil_samples", "64", "--output", "expected"})
                .exit_code,
            0);
  const nlohmann::json expected = summary("expected")["design"]["performance"]["residual_wfe_nm"];
  const FitsCube phases = read_fits_cube("run/phase.fits", "screens.file", FitsGaps::allowed);
  EXPECT_EQ(phases.unit, "rad");
  ASSERT_EQ(phases.slices.size(), 2u);
  const PupilMask mask = pupil_mask(32, 0.0);
  double mean = 0.0;
  for (int set : {0, 1}) {
    EXPECT_TRUE((phases.slices[set].isNaN() == !mask).all());
    EXPECT_NEAR(mask.select(phases.slices[set], 0.0).sum(), 0.0, 1e-9);
    mean += residual_nm(phases.slices[set], set) / 2.0;
  }
  EXPECT_NEAR(mean, expected["mean"], 1.0 + 3.0 * expected["standard_error"].get<double>());
  EXPECT_LT(mean, 20.0);
}

TEST_F(Reconstruct, WritesItsFiles) {
  reconstruct("run");
  const FitsCube measured =
      read_fits_cube("run/frames.fits", "frames.file", FitsGaps::allowed, FitsShape::frames);
  const FitsCube predicted =
      read_fits_cube("run/predicted.fits", "frames.file", FitsGaps::refused, FitsShape::frames);
  EXPECT_EQ(measured.sets, 2u);
  EXPECT_EQ(predicted.sets, 2u);
  const std::vector<CsvRow> table = read_csv("run/consistency.csv");
  ASSERT_EQ(table.size(), 8u);
  std::array<double, 2> residual_over_noise{};  // squares, summed over a set's planes
  for (std::size_t row = 0; row < table.size(); ++row) {
    CsvRow of = table[row];
    EXPECT_EQ(of["set"], row < 4 ? "1" : "2");
    EXPECT_EQ(of["bad_pixels"], "0");
    EXPECT_EQ(of["centre_x_pixels"], "64.5");
    // The table says what the images say.
    const Image<double>& image = measured.slices[row];
    const double rms = std::sqrt((image - predicted.slices[row]).square().sum() /
                                 predicted.slices[row].square().sum());
    EXPECT_NEAR(std::stod(of["relative_rms"]), rms, 1e-9);
    residual_over_noise[row / 4] += std::pow(rms / std::stod(of["noise_relative_rms"]), 2.0);
    // Calibrated: its light is that of a pupil of intensity 1, its background is gone.
    EXPECT_NEAR(image.sum() / 804.0, std::stod(of["captured_energy"]), 0.02);
  }
  // A fit by least squares of two numbers for each pupil sample to four images of as many lit
  // pixels would follow half of the noise's variance; a prediction that owes nothing to an image
  // adds as much noise of its own.
  for (const double squares : residual_over_noise) {
    EXPECT_GT(squares / 4.0, 0.5);
    EXPECT_LT(squares / 4.0, 2.0);
  }
  for (const std::string name : {"phase.svg", "phase.png", "frames.svg", "frames.png"}) {
    EXPECT_GT(std::filesystem::file_size("run/" + name), 2000u) << name;
  }
  const nlohmann::json json = summary("run");
  EXPECT_EQ(json["command"], "reconstruct");
  EXPECT_EQ(json["config"]["detector.window"], "4");
  EXPECT_EQ(json["consistency"]["verdict"], "agree");
  EXPECT_EQ(json["consistency"]["planes"].size(), 4u);
  EXPECT_EQ(json["sets"].size(), 2u);
  EXPECT_EQ(json["design"]["planes_m"], (std::vector<double>{-180e3, 180e3, -47e3, 47e3}));
  EXPECT_GT(json["wavefront_rms_nm"]["mean"], 50.0);
  // It is the gains that make the planes' light unequal here.
  const double total = 1000.0 + 1500.0 + 2000.0 + 2500.0;
  EXPECT_NEAR(json["consistency"]["planes"][3]["light_share"]["mean"], 2500.0 / total, 0.01);
}

TEST_F(Reconstruct, IsRepeatedByItsConfigurationOnAnyNumberOfThreads) {
  reconstruct("run", {"--threads", "1"});
  ASSERT_EQ(run({"reconstruct", "--config", "run/config.cfg", "--output", "again"}).exit_code, 0);
  for (const std::string name : {"phase.fits", "predicted.fits", "consistency.csv"}) {
    EXPECT_EQ(contents("run/" + name), contents("again/" + name)) << name;
  }
}

TEST_F(Reconstruct, MakesWavefrontsForTheOtherCommands) {
  reconstruct("run");
  const Arguments screens{"--screens.file", "run/phase.fits"};
  done("evaluate", "evaluated", screens);
  EXPECT_EQ(summary("evaluated")["design"]["performance"]["screens"], 2);
  done("optimize", "optimized", screens);
  // What is resampled at the pupil's edge comes from within. Twice as fine, every sample stands a
  // quarter between neighbours a and b, in each direction, and 3/4 a + 1/4 b has 3/16 (a - b)^2
  // less variance. The outermost half sample (6 % of the area) holds its value, which takes some
  // 0.2 % from the RMS of a tilt. No more roughness than that is lost.
  done("screens", "finer",
       {"--screens.file", "run/phase.fits", "--simulation.pupil_samples", "64",
        "--detector.pupil_pixels", "32"});
  const FitsCube coarse = read_fits_cube("run/phase.fits", "screens.file", FitsGaps::allowed);
  const FitsCube fine = read_fits_cube("finer/screens.fits", "screens.file");
  for (int set : {0, 1}) {
    const PupilMask mask = pupil_mask(32, 0.0);
    const Image<double>& phase = coarse.slices[set];
    const double variance = std::pow(piston_free_rms(mask.select(phase, 0.0), mask), 2.0);
    double lost = 0.0;
    for (const Image<double>& steps : {Image<double>(phase.leftCols(31) - phase.rightCols(31)),
                                       Image<double>(phase.topRows(31) - phase.bottomRows(31))}) {
      const auto inside = !steps.isNaN();
      lost += 3.0 / 16.0 * inside.select(steps.square(), 0.0).sum() / double(inside.count());
    }
    const double rms = piston_free_rms(fine.slices[set], pupil_mask(64, 0.0));
    EXPECT_NEAR(rms / std::sqrt(variance - lost), 1.0, 0.005);
  }
}

TEST_F(Reconstruct, SaysThatPlanesOutOfOrderDisagree) {
  Arguments arguments{
      "reconstruct", "--frames", "frames.fits", "--config",
      "mine.cfg",    "--output", "run",         "--sensor.planes=-180km,180km,47km,-47km"};
  const ProgramRun finished = run(arguments);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_THAT(finished.output, AllOf(HasSubstr("Measured and predicted images disagree"),
                                     HasSubstr("Check the signs and the order")));
  EXPECT_EQ(summary("run")["consistency"]["verdict"], "disagree");
}

TEST_F(Reconstruct, NeedsItsBackground) {
  EXPECT_THAT(reconstruct("run", {"--frames.background", "0"}).output,
              AllOf(Not(HasSubstr("images agree:")), HasSubstr("frames.background")));
}

TEST_F(Reconstruct, ABackgroundThatIsLeftIsNoAgreement) {
  // 1000 to 2500 counts are the pupil's intensity: half a percent of it doubles the error.
  for (const char* subtracted : {"15", "25", "0", "-80"}) {
    const std::string folder = fmt::format("run{}", subtracted);
    EXPECT_THAT(reconstruct(folder, {"--frames.background", subtracted}).output,
                AllOf(HasSubstr("Measured and predicted images disagree: plane "),
                      HasSubstr("adu in each pixel where no light falls")));
    const nlohmann::json consistency = summary(folder)["consistency"];
    EXPECT_EQ(consistency["verdict"], "disagree");
    for (const nlohmann::json& plane : consistency["planes"]) {
      const nlohmann::json& found = plane["background"];
      EXPECT_NEAR(found["mean"], background - std::stod(subtracted),
                  4.0 * found["standard_error"].get<double>());
    }
  }
}

TEST_F(Reconstruct, APlaneThatSaysNothingAgreesWithNothing) {
  FitsCube cube = frames(1);
  cube.slices[2].setConstant(background + 40.0);
  std::filesystem::remove("frames.fits");
  write_fits_cube("frames.fits", cube);
  EXPECT_THAT(reconstruct("flat").output,
              AllOf(Not(HasSubstr("images agree:")), Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  EXPECT_TRUE(summary("flat")["consistency"]["planes"][2]["correlation"].is_null());

  std::filesystem::remove("frames.fits");
  write_fits_cube("frames.fits", frames(1));
  for (const int good_pixels : {1, 2, 100}) {
    FitsCube bad{.unit = "",
                 .slices = std::vector(4, Image<double>(Image<double>::Zero(128, 128)))};
    bad.slices[1].setOnes();
    bad.slices[1].row(64).segment(14, good_pixels).setZero();
    const std::string folder = fmt::format("with-{}", good_pixels);
    write_fits_cube(folder + ".fits", bad);
    EXPECT_THAT(reconstruct(folder, {"--frames.bad_pixels", folder + ".fits"}).output,
                AllOf(HasSubstr("images tell too little: plane 2 was measured where"),
                      Not(HasSubstr("nan"))));
  }
}

TEST_F(Reconstruct, SetsThatHaveNotConvergedDoNotAgree) {
  EXPECT_THAT(reconstruct("run", {"--reconstruction.max_loops", "2"}).output,
              AllOf(Not(HasSubstr("images agree:")), HasSubstr("2 of 2 had not converged")));
}

TEST_F(Reconstruct, TakesCalibrationFiles) {
  // A hot and a saturated pixel in one plane; as a file for all planes, one for each, and as a
  // level.
  FitsCube cube = frames(1);
  for (Image<double>& slice : cube.slices) slice(64, 64) = 5e5;
  cube.slices[2](60, 70) = 9e5;
  std::filesystem::remove("frames.fits");
  write_fits_cube("frames.fits", cube);
  const Image<double> level = Image<double>::Constant(128, 128, background);
  write_fits_cube("dark.fits", {"adu", {level}});
  write_fits_cube("darks.fits", {"adu", {level, level, level, level}});
  Image<double> bad = Image<double>::Zero(128, 128);
  bad(64, 64) = 1.0;
  write_fits_cube("bad.fits", {"", {bad}});
  reconstruct("a", {"--frames.background", "dark.fits", "--frames.saturation", "4e5"});
  reconstruct("b", {"--frames.background", "darks.fits", "--frames.bad_pixels", "bad.fits",
                    "--frames.saturation", "8e5"});
  EXPECT_EQ(contents("a/phase.fits"), contents("b/phase.fits"));
  EXPECT_EQ(contents("a/consistency.csv"), contents("b/consistency.csv"));
  EXPECT_EQ(read_csv("a/consistency.csv")[2]["bad_pixels"], "2");
  EXPECT_LT(summary("a")["consistency"]["misfit"], 0.1);
}

TEST_F(Reconstruct, TakesFramesThatAreNoEvenSquare) {
  // Cut off to 127 x 120 pixels, with the axis where it was.
  FitsCube cube = frames(1);
  for (Image<double>& slice : cube.slices) slice = Image<double>(slice.block(3, 1, 120, 127));
  std::filesystem::remove("frames.fits");
  write_fits_cube("frames.fits", cube);
  reconstruct("run", {"--frames.centre", "63.5,61.5,63.5,61.5,63.5,61.5,63.5,61.5"});
  const FitsCube phases = read_fits_cube("run/phase.fits", "screens.file", FitsGaps::allowed);
  EXPECT_LT(residual_nm(phases.slices[0], 0), 20.0);
  EXPECT_EQ(read_csv("run/consistency.csv")[0]["bad_pixels"],
            std::to_string(128 * 128 - 120 * 127));
  EXPECT_EQ(summary("run")["consistency"]["verdict"], "agree");
}

TEST_F(Reconstruct, RefusesBadInput) {
  const Arguments good{"--frames", "frames.fits", planes_text};
  const auto with = [&](const Arguments& more) {
    Arguments all = good;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused({planes_text}, "frames.file = (nothing)", "--frames frames.fits");
  expect_refused({"--frames", "frames.fits"}, "sensor.planes = -180km,180km,-47km,47km",
                 "give those of your frames, such as --sensor.planes=-120km,120km,-30km,30km");
  expect_refused({}, "frames.file = (nothing)", "--frames frames.fits");
  expect_refused({"--frames", "missing.fits"}, "frames.file = missing.fits",
                 "there is no such file");
  expect_refused({"--frames", "missing.fits", planes_text}, "frames.file = missing.fits",
                 "there is no such file");
  expect_refused({"--frames", "mine.cfg", planes_text}, "frames.file = mine.cfg",
                 "it cannot be read");
  expect_refused({"--frames", "frames.fits", "--sensor.planes=-47km,47km"},
                 "frames.file = frames.fits", "the number of its planes is 4, of sensor.planes 2");
  expect_refused(
      with({"--detector.window", "3"}), "detector.window = 3",
      "the frames are 4 pupil diameters of detector.pupil_pixels = 32 wide; leave it away");
  expect_refused(with({"--reconstruction.window", "3"}), "frames.file = frames.fits",
                 "set reconstruction.window, which is 3, to 4 or more");
  expect_refused(with({"--detector.pupil_pixels", "200"}), "frames.file = frames.fits",
                 "the pupil must fit");
  expect_refused(with({"--frames.flux", "1,1,-1,1"}), "frames.flux = 1,1,-1,1", "above 0");
  expect_refused(with({"--frames.flux", "1,1"}), "frames.flux = 1,1", "each of 4 planes");
  expect_refused(with({"--frames.centre", "64,64"}), "frames.centre = 64,64", "8 numbers");
  expect_refused(with({"--frames.centre", "64,64,64,64,64,640,64,64"}), "frames.centre = 64,640",
                 "plane 3: in the frame");
  expect_refused(with({"--frames.saturation", "0"}), "frames.saturation = 0", "above 0");
  expect_refused(with({"--frames.saturation", "1"}), "frames.file = frames.fits",
                 "plane 1 of set 1 has no pixel that is not bad");
  expect_refused(with({"--frames.background", "1e6"}), "frames.file = frames.fits",
                 "plane 1 of set 1 has no light");
  expect_refused(with({"--frames.background", "missing.fits"}), "frames.background = missing.fits",
                 "there is no such file; allowed is a number, or a FITS file of one image, one for "
                 "each plane or one for each frame");
  expect_refused(with({"--frames.bad_pixels", "missing.fits"}), "frames.bad_pixels = missing.fits",
                 "allowed is a FITS file of one image, or one for each plane");
  write_fits_cube("small.fits", {"", {Image<double>::Zero(64, 64)}});
  expect_refused(with({"--frames.background", "small.fits"}), "frames.background = small.fits",
                 "as large as the frames, 128 x 128");
  const Image<double> one = Image<double>::Ones(128, 128);
  write_fits_cube("ones.fits", {"", {one}});
  expect_refused(with({"--frames.bad_pixels", "ones.fits"}), "frames.file = frames.fits",
                 "has no pixel that is not bad");
  write_fits_cube("three.fits", {"", {one, one, one}});
  expect_refused(with({"--frames.bad_pixels", "three.fits"}), "frames.bad_pixels = three.fits",
                 "it has 3 images; one for all planes or one for each");
  expect_refused(with({"--frames.file", "frames.fits"}), "command line = --frames frames.fits",
                 "frames.file is given too");
  const ProgramRun other = run({"evaluate", "--frames", "frames.fits"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("only reconstruct takes it"));
}

}  // namespace
}  // namespace nlcwfs
