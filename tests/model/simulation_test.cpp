// Tests: One design on one set of wavefronts, from the pupil to its performance.
#include "model/simulation.hpp"

#include "model/gerchberg_saxton.hpp"
#include "model/turbulence_screen.hpp"
#include "model/wavefront_metrics.hpp"
#include "tests/message_of.hpp"

#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int screen_samples = 32;

/// Turbulence of D/r0 = 3; the phase in rad does not depend on the telescope.
std::vector<PhaseScreen> turbulence(int count, int samples = screen_samples) {
  const Seeing seeing{.fried_parameter = 1.0 / 3.0};
  return generate_screens(TurbulenceScreenGenerator(seeing, samples, 1.0, 21), count);
}

SensorDesign small_design() {
  SensorDesign design;
  design.planes = {-100e3, 100e3, -35e3, 35e3};
  design.detector = {.pupil_pixels = 16, .window = 4.0};
  design.reconstruction.window = 6.0;
  return design;
}

/// The design on the truth's own grid.
SensorDesign matched_design() {
  SensorDesign design = small_design();
  design.detector.pupil_pixels = screen_samples;
  design.reconstruction.window = 4.0;
  return design;
}

Performance evaluate(const SensorDesign& design, const std::vector<PhaseScreen>& screens,
                     const SimulationOptions& options = {}, const Telescope& telescope = {}) {
  return Simulation(telescope, screens, options).evaluate(design);
}

std::vector<PhaseScreen> changed(const std::vector<PhaseScreen>& screens,
                                 PhaseScreen (*change)(const PhaseScreen&)) {
  std::vector<PhaseScreen> result;
  result.reserve(screens.size());
  for (const PhaseScreen& screen : screens) result.push_back(change(screen));
  return result;
}

/// Equal metrics in waves, up to rounding.
void expect_equal(const Performance& result, const Performance& expected,
                  double wavelength_ratio = 1.0) {
  ASSERT_EQ(result.screens.size(), expected.screens.size());
  for (std::size_t i = 0; i < expected.screens.size(); ++i) {
    const ScreenPerformance& screen = result.screens[i];
    const ScreenPerformance& other = expected.screens[i];
    const double tolerance = 1e-9 * 532e-9;
    EXPECT_NEAR(screen.wavefront.residual_wfe / wavelength_ratio, other.wavefront.residual_wfe,
                tolerance);
    EXPECT_NEAR(screen.wavefront.wrapped_wfe / wavelength_ratio, other.wavefront.wrapped_wfe,
                tolerance);
    EXPECT_NEAR(screen.wavefront.total_wfe / wavelength_ratio, other.wavefront.total_wfe,
                tolerance);
    EXPECT_NEAR(screen.wavefront.field_strehl, other.wavefront.field_strehl, 1e-9);
    EXPECT_EQ(screen.converged, other.converged);
    EXPECT_EQ(screen.loops, other.loops);
    EXPECT_NEAR(screen.fractional_loops, other.fractional_loops, 1e-6);
    EXPECT_EQ(screen.fft_count, other.fft_count);
    ASSERT_EQ(screen.captured_energy.size(), other.captured_energy.size());
    for (std::size_t plane = 0; plane < other.captured_energy.size(); ++plane) {
      EXPECT_NEAR(screen.captured_energy[plane], other.captured_energy[plane], 1e-9);
    }
  }
}

/// Equal to the last bit, but for the time it took.
void expect_identical(const Performance& result, const Performance& expected) {
  ASSERT_EQ(result.screens.size(), expected.screens.size());
  for (std::size_t i = 0; i < expected.screens.size(); ++i) {
    const ScreenPerformance& screen = result.screens[i];
    const ScreenPerformance& other = expected.screens[i];
    EXPECT_EQ(screen.captured_energy, other.captured_energy);
    for (const PerformanceMetric& metric : performance_metrics()) {
      if (metric.name == "seconds") continue;
      EXPECT_EQ(metric(screen), metric(other)) << metric.name;
    }
  }
}

/// Both truths, each with a design that is possible with it.
class SimulationTruth : public testing::TestWithParam<TruthModel> {
 protected:
  static bool matched() { return GetParam() == TruthModel::matched; }

  SensorDesign design_ = matched() ? matched_design() : small_design();
  SimulationOptions options_{.truth = GetParam()};
  std::vector<PhaseScreen> screens_ = turbulence(3);
};

INSTANTIATE_TEST_SUITE_P(Truths, SimulationTruth,
                         testing::Values(TruthModel::extended, TruthModel::matched),
                         [](const auto& truth) {
                           return truth.param == TruthModel::matched ? "matched" : "extended";
                         });

TEST_P(SimulationTruth, DependsOnFresnelNumbersAlone) {
  design_.reconstruction.initial_guess = InitialGuess::centroid;
  design_.reconstruction.relaxation_start = 0.3;
  const Telescope telescope;
  const Performance expected = evaluate(design_, screens_, options_);
  for (const Telescope& other : {Telescope{.diameter = 8.2, .wavelength = 532e-9},
                                 Telescope{.diameter = 0.5, .wavelength = 1.65e-6},
                                 Telescope{.diameter = 0.01, .wavelength = 400e-9}}) {
    SensorDesign scaled = design_;
    for (double& plane : scaled.planes) plane = scaled_distance(plane, telescope, other);
    const double wavelength_ratio = other.wavelength / telescope.wavelength;
    scaled.reconstruction.tolerance *= wavelength_ratio;
    expect_equal(evaluate(scaled, screens_, options_, other), expected, wavelength_ratio);
  }
}

TEST_P(SimulationTruth, IsTheSameToTheLastBitForAnyNumberOfThreads) {
  design_.detector.photons = 1e5;
  design_.detector.read_noise = 1.0;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return evaluate(design_, turbulence(6), options_);
  };
  const Performance expected = with_threads(1);
  expect_identical(with_threads(2), expected);
  expect_identical(with_threads(4), expected);
}

TEST_P(SimulationTruth, AScreensResultDoesNotDependOnTheOthers) {
  design_.detector.photons = 1e5;
  const Performance all = evaluate(design_, screens_, options_);
  Performance first = all;
  first.screens.resize(1);
  expect_identical(evaluate(design_, {screens_[0]}, options_), first);
}

TEST_P(SimulationTruth, LightPerSecondIsLightPerFrameInItsExposure) {
  design_.detector.photons = 1e5;
  const Performance per_frame = evaluate(design_, screens_, options_);
  design_.detector.photons = 0.0;
  design_.detector.photon_rate = 1e8;
  design_.detector.exposure = 1e-3;
  expect_identical(evaluate(design_, screens_, options_), per_frame);
}

TEST_P(SimulationTruth, AScreensResultIsTheSameInABlock) {
  design_.detector.photons = 1e5;
  const Performance all = evaluate(design_, screens_, options_);
  const Simulation simulation({}, screens_, options_);
  for (int first = 0; first < simulation.screen_count(); ++first) {
    for (int count = 1; first + count <= simulation.screen_count(); ++count) {
      const auto begin = all.screens.begin() + first;
      expect_identical(simulation.evaluate(design_, first, count), {{begin, begin + count}});
    }
  }
}

TEST_P(SimulationTruth, ImagesKeptFromOtherDesignsChangeNothing) {
  // One plane or more in common, in another order, seen by another detector, with noise or none.
  std::vector<SensorDesign> designs(5, design_);
  designs[1].planes = {design_.planes[2], design_.planes[1], -70e3, 70e3};
  designs[2].detector.window = designs[2].reconstruction.window = 2.0;
  designs[3].detector.photons = 1e5;
  designs[4].detector.pupil_pixels = matched() ? screen_samples : 32;
  const Simulation simulation({}, screens_, options_);
  for (const SensorDesign& design : designs) {
    expect_identical(simulation.evaluate(design), evaluate(design, screens_, options_));
    expect_identical(simulation.evaluate(design), evaluate(design, screens_, options_));
  }
}

TEST_P(SimulationTruth, SinglePrecisionAgreesWithDouble) {
  screens_ = turbulence(16);
  int compared = 0;
  SimulationOptions single = options_;
  single.precision = Precision::single_precision;
  for (const StoppingRule rule : {StoppingRule::difference, StoppingRule::rms_change}) {
    design_.reconstruction.stopping = rule;
    const Performance expected = evaluate(design_, screens_, options_);
    const Performance result = evaluate(design_, screens_, single);
    for (std::size_t i = 0; i < screens_.size(); ++i) {
      const ScreenPerformance& in_double = expected.screens[i];
      const ScreenPerformance& in_single = result.screens[i];
      EXPECT_EQ(in_single.captured_energy, in_double.captured_energy);
      // But for ties, where the change crosses the tolerance right at a loop, and wavefronts that
      // did not converge.
      const double fraction =
          std::abs(in_double.fractional_loops - std::round(in_double.fractional_loops));
      if (fraction < 1e-3) continue;
      ++compared;
      EXPECT_EQ(in_single.loops, in_double.loops) << i;
      EXPECT_NEAR(in_single.wavefront.residual_wfe, in_double.wavefront.residual_wfe, 0.02e-9);
    }
  }
  EXPECT_GE(compared, 28);
}

TEST_P(SimulationTruth, ConjugateLightMirrorsThePlanes) {
  const Performance expected = evaluate(design_, screens_, options_);
  for (double& plane : design_.planes) plane = -plane;
  const auto conjugate =
      changed(screens_, [](const PhaseScreen& phase) { return (-phase).eval(); });
  expect_equal(evaluate(design_, conjugate, options_), expected);
}

TEST_P(SimulationTruth, FlippedAndTransposedScreensDoAsWell) {
  const Performance expected = evaluate(design_, screens_, options_);
  using Change = PhaseScreen (*)(const PhaseScreen&);
  for (const Change change :
       {Change([](const PhaseScreen& phase) { return PhaseScreen(phase.rowwise().reverse()); }),
        Change([](const PhaseScreen& phase) { return PhaseScreen(phase.colwise().reverse()); }),
        Change([](const PhaseScreen& phase) { return PhaseScreen(phase.transpose()); })}) {
    expect_equal(evaluate(design_, changed(screens_, change), options_), expected);
  }
}

TEST_P(SimulationTruth, APistonIsNotSeen) {
  const auto lifted =
      changed(screens_, [](const PhaseScreen& phase) { return (phase + 2.5).eval(); });
  expect_equal(evaluate(design_, lifted, options_), evaluate(design_, screens_, options_));
}

TEST_P(SimulationTruth, NoiseDoesNotDependOnTheVisitingOrder) {
  // With a first estimate that stays as it is, the centroids' tilt is all that noise can change;
  // it does not depend on the order but for rounding.
  design_.detector.photons = 1e4;
  design_.reconstruction.initial_guess = InitialGuess::centroid;
  design_.reconstruction.max_loops = 1;
  design_.reconstruction.relaxation_start = design_.reconstruction.relaxation_end = -1.0 + 1e-12;
  const Performance expected = evaluate(design_, screens_, options_);
  design_.planes = {35e3, -100e3, -35e3, 100e3};
  const Performance result = evaluate(design_, screens_, options_);
  SimulationOptions reseeded = options_;
  reseeded.noise_seed = 2;
  const Performance other = evaluate(design_, screens_, reseeded);
  for (std::size_t i = 0; i < screens_.size(); ++i) {
    const double residual = expected.screens[i].wavefront.residual_wfe;
    EXPECT_NEAR(result.screens[i].wavefront.residual_wfe, residual, 1e-9 * residual);
    EXPECT_GT(std::abs(other.screens[i].wavefront.residual_wfe - residual), 1e-5 * residual);
  }
}

TEST_P(SimulationTruth, PhotonNoiseRaisesTheResidual) {
  const auto residual = [&](double photons, double read_noise) {
    design_.detector.photons = photons;
    design_.detector.read_noise = read_noise;
    return evaluate(design_, screens_, options_)
        .mean_of([](const ScreenPerformance& screen) { return screen.wavefront.residual_wfe; })
        .mean;
  };
  // Not even the best of sensors does better than M / (4 N) rad^2 with M pupil pixels and N
  // photons.
  const auto pixels = double(pupil_mask(design_.detector.pupil_pixels, 0.0).count());
  for (const double photons : {1e3, 1e4, 1e5}) {
    const double best = std::sqrt(pixels / (4.0 * photons)) * 532e-9 / (2.0 * std::numbers::pi);
    EXPECT_GT(residual(photons, 0.0), best);
    EXPECT_GT(residual(photons, 0.0), 1.1 * residual(10.0 * photons, 0.0));
    EXPECT_GT(residual(photons, 3.0), 1.2 * residual(photons, 0.0));
  }
  // So many photons are none.
  EXPECT_NEAR(residual(1e15, 0.0), residual(0.0, 0.0), 0.01e-9);
}

TEST_P(SimulationTruth, BearsAlmostNoPhotons) {
  design_.detector.photons = 1e-3;
  const Performance result = evaluate(design_, screens_, options_);
  for (const ScreenPerformance& screen : result.screens) {
    for (const PerformanceMetric& metric : performance_metrics()) {
      EXPECT_TRUE(std::isfinite(metric(screen))) << metric.name;
    }
  }
}

TEST_P(SimulationTruth, APlaneAtThePupilCapturesAllAndKeepsTheSymmetry) {
  design_.planes = {0.0, -60e3, 60e3};
  const Performance first = evaluate(design_, screens_, options_);
  for (const ScreenPerformance& screen : first.screens) {
    EXPECT_NEAR(screen.captured_energy[0], 1.0, 1e-12);
  }
  const Performance conjugate = [&] {
    design_.planes = {0.0, 60e3, -60e3};
    return evaluate(design_,
                    changed(screens_, [](const PhaseScreen& phase) { return (-phase).eval(); }),
                    options_);
  }();
  expect_equal(conjugate, first);
}

TEST_P(SimulationTruth, ARecordIsOfTheEvaluation) {
  design_.detector.photons = 1e5;
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    options_.precision = precision;
    const Simulation simulation({}, screens_, options_);
    const Performance performance = simulation.evaluate(design_);
    const PupilMask mask = pupil_mask(design_.pupil_samples(), 0.0);
    const double length_per_radian = Telescope{}.wavelength / (2.0 * std::numbers::pi);
    for (int i = 0; i < simulation.screen_count(); ++i) {
      const ScreenPerformance& screen = performance.screens[static_cast<std::size_t>(i)];
      const ScreenRecord record = simulation.record(design_, i);
      expect_identical({{record.performance}}, {{screen}});
      // The residual phase is the wavefront error.
      EXPECT_NEAR(length_per_radian * piston_free_rms(record.residual_phase, mask),
                  screen.wavefront.residual_wfe, 1e-12 * screen.wavefront.residual_wfe);
      // One residual per loop, ending where the rule stopped.
      ASSERT_EQ(record.performance.residual_after_loops.size(), std::size_t(screen.loops));
      EXPECT_EQ(record.performance.residual_after_loops.back(), screen.wavefront.residual_wfe);
    }
  }
}

TEST_P(SimulationTruth, ARecordsPhasesCoverThePupilWithoutPiston) {
  const ScreenRecord record = Simulation({}, screens_, options_).record(design_, 1);
  const PupilMask mask = pupil_mask(design_.pupil_samples(), 0.0);
  const std::vector<const Image<double>*> phases{&record.true_phase, &record.reconstructed_phase,
                                                 &record.residual_phase};
  for (const Image<double>* phase : phases) {
    ASSERT_EQ(phase->rows(), mask.rows());
    EXPECT_TRUE((phase->isNaN() == !mask).all());
    EXPECT_NEAR(piston(*phase, mask), 0.0, 1e-12);
  }
  const Image<double> difference = record.reconstructed_phase - record.true_phase;
  EXPECT_LT(mask.select((difference - record.residual_phase).abs(), 0.0).maxCoeff(), 1e-12);
  const Image<double> sampled =
      block_average(screens_[1], screens_[1].rows() / design_.pupil_samples());
  EXPECT_LT(
      mask.select((record.true_phase - sampled + piston(sampled, mask)).abs(), 0.0).maxCoeff(),
      1e-12);
}

TEST_P(SimulationTruth, ARecordsImagesAreThoseOfTheReconstruction) {
  design_.detector.photons = 1e5;
  const Simulation simulation({}, screens_, options_);
  const SensorDesign design = simulation.checked(design_);
  const ScreenRecord record = simulation.record(design_, 2);
  ASSERT_EQ(record.images.size(), design.planes.size());
  const GerchbergSaxton<double> loop({}, design);
  const Image<double> phase = loop.unwrapper().unwrap(loop.reconstruct(record.images).pupil_field);
  const Image<double> shown = phase - piston(phase, loop.mask());
  EXPECT_TRUE(loop.mask().select(shown == record.reconstructed_phase, true).all());

  design_.detector.photons = 0.0;
  const ScreenRecord noise_free = simulation.record(design_, 2);
  const double pupil = double(pupil_mask(screen_samples, 0.0).count()) /
                       std::pow(screen_samples / design_.detector.pupil_pixels, 2);
  for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
    EXPECT_NEAR(noise_free.images[plane].sum() / pupil,
                noise_free.performance.captured_energy[plane], 1e-12);
    EXPECT_FALSE((noise_free.images[plane] == record.images[plane]).all());
  }
}

TEST(Simulation, CapturedEnergyGrowsWithTheWindowToOne) {
  SensorDesign design = small_design();
  design.reconstruction.window = 16.0;
  design.reconstruction.max_loops = 1;
  const auto screens = turbulence(2);
  std::vector<double> before(4, 0.0);
  for (const double window : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    design.detector.window = window;
    const std::vector<double> energy = evaluate(design, screens).captured_energy();
    ASSERT_EQ(energy.size(), 4U);
    for (std::size_t plane = 0; plane < 4; ++plane) {
      EXPECT_GT(energy[plane], before[plane]);
      EXPECT_LE(energy[plane], 1.0);
    }
    before = energy;
  }
  for (const double energy : before) EXPECT_GT(energy, 0.95);
}

TEST(Simulation, AMatchedDetectorCapturesAllTheLight) {
  for (const double energy :
       evaluate(matched_design(), turbulence(2), {.truth = TruthModel::matched})
           .captured_energy()) {
    EXPECT_NEAR(energy, 1.0, 1e-12);
  }
}

TEST(Simulation, AMatchedTruthIsReachedAndAnExtendedOneIsNot) {
  // The inverse crime, which is why the extended truth is the default.
  SensorDesign design = matched_design();
  design.reconstruction.max_loops = 40;
  const auto residual = [&](TruthModel truth) {
    return evaluate(design, turbulence(3), {.truth = truth})
        .mean_of([](const ScreenPerformance& screen) { return screen.wavefront.residual_wfe; })
        .mean;
  };
  EXPECT_LT(residual(TruthModel::matched), 1e-9);
  EXPECT_GT(residual(TruthModel::extended), 3.0 * residual(TruthModel::matched));
}

TEST(Simulation, APeriodicTruthOfThePixelsSamplingIsTheMatchedOne) {
  const Performance matched =
      evaluate(matched_design(), turbulence(2), {.truth = TruthModel::matched});
  expect_equal(evaluate(matched_design(), turbulence(2), {.truth = TruthModel::periodic}), matched);
}

TEST(Simulation, APeriodicTruthIsBinnedToThePixels) {
  SensorDesign design = matched_design();
  design.detector.pupil_pixels = screen_samples / 4;
  const Performance binned = evaluate(design, turbulence(2), {.truth = TruthModel::periodic});
  for (const ScreenPerformance& screen : binned.screens) {
    // All light is measured, and the pixels are too coarse to see all of the wavefront.
    for (const double energy : screen.captured_energy) EXPECT_NEAR(energy, 1.0, 1e-9);
    EXPECT_GT(screen.wavefront.total_wfe, screen.wavefront.residual_wfe);
  }
  design.detector.pupil_pixels = 24;
  EXPECT_THAT(
      message_of([&] { (void)evaluate(design, turbulence(1), {.truth = TruthModel::periodic}); }),
      HasSubstr("a multiple of detector.pupil_pixels"));
}

TEST(Simulation, FollowsTheResidualFromLoopToLoop) {
  SensorDesign endless = small_design();
  endless.reconstruction.tolerance = 0.0;
  const Performance with = Simulation({}, turbulence(3), {}).follow(small_design());
  const Performance without = evaluate(endless, turbulence(3));
  expect_equal(with, without);
  for (std::size_t i = 0; i < with.screens.size(); ++i) {
    const ScreenPerformance& screen = with.screens[i];
    ASSERT_EQ(screen.residual_after_loops.size(), static_cast<std::size_t>(screen.loops));
    EXPECT_EQ(screen.residual_after_loops.back(), screen.wavefront.residual_wfe);
    EXPECT_GT(screen.residual_after_loops.front(), screen.residual_after_loops.back());
    EXPECT_TRUE(without.screens[i].residual_after_loops.empty());
  }
}

TEST(Simulation, KnowsHowStrongItsAberrationsAre) {
  // A tilt of one wave over the diameter: its RMS over a round pupil is a quarter of a wave.
  const int samples = 64;
  PhaseScreen tilt(samples, samples);
  for (int column = 0; column < samples; ++column) {
    tilt.col(column) = 2.0 * std::numbers::pi * (column + 0.5) / samples;
  }
  const std::vector<double> aberrations =
      Simulation({.wavelength = 800e-9}, {tilt, 0.5 * tilt}, {}).aberrations();
  ASSERT_EQ(aberrations.size(), 2u);
  EXPECT_NEAR(aberrations[0], 200e-9, 1e-9);  // of a disc of samples
  EXPECT_NEAR(aberrations[1], 0.5 * aberrations[0], 1e-18);
}

TEST(Simulation, BroadbandLightCostsAccuracy) {
  const auto residual = [](const LightSource& source) {
    return evaluate(small_design(), turbulence(4), {.source = source})
        .mean_of(performance_metric("residual_wfe_nm"))
        .mean;
  };
  LightSource narrow{.bands = {{526e-9, 538e-9}}, .wavelengths = 4};
  LightSource wide{.bands = {{432e-9, 632e-9}}, .wavelengths = 8};
  EXPECT_LT(residual({}), residual(narrow));
  EXPECT_LT(residual(narrow), residual(wide));
}

TEST(Simulation, RefusesASourceThatDoesNotSuitThePlanes) {
  const LightSource source{.bands = {{500e-9, 600e-9}, {600e-9, 700e-9}}};
  EXPECT_THAT(
      message_of([&] { (void)evaluate(small_design(), turbulence(1), {.source = source}); }),
      HasSubstr("one for each of the 4 planes"));
}

TEST(Simulation, AFinerTruthOfTheSameDesignEndsNearby) {
  // As a verification does: the screens' own block means are what the coarser truth sees.
  SensorDesign design = small_design();
  design.planes = {-60e3, 60e3, -25e3, 25e3};
  const auto fine = turbulence(3, 2 * screen_samples);
  const auto coarse =
      changed(fine, [](const PhaseScreen& phase) { return block_average(phase, 2).eval(); });
  const auto residual = [&](const std::vector<PhaseScreen>& screens) {
    const Simulation simulation({}, screens, {});
    EXPECT_EQ(simulation.truth_samples(), screens.front().rows());
    return simulation.evaluate(design)
        .mean_of([](const ScreenPerformance& screen) { return screen.wavefront.residual_wfe; })
        .mean;
  };
  const double of_coarse = residual(coarse);
  const double of_fine = residual(fine);
  EXPECT_NEAR(of_fine / of_coarse, 1.0, 0.1);
  EXPECT_NE(of_fine, of_coarse);
}

TEST(Simulation, SeesADesignAsItIsSimulated) {
  SensorDesign design = matched_design();
  design.detector.window = 2.0;
  const auto screens = turbulence(1);
  EXPECT_EQ(Simulation({}, screens, {.truth = TruthModel::matched}).checked(design).detector.window,
            4.0);
  EXPECT_EQ(Simulation({}, screens, {}).checked(design).detector.window, 2.0);
}

TEST(Simulation, NamesWhatDoesNotFitTheTruth) {
  const auto screens = turbulence(1);
  const Simulation extended({}, screens, {});
  const auto refusal = [&](const Simulation& simulation, const SensorDesign& design) {
    std::string message = message_of([&] { (void)simulation.checked(design); });
    EXPECT_EQ(message_of([&] { (void)simulation.evaluate(design); }), message);
    return message;
  };
  EXPECT_EQ(message_of([&] { (void)extended.checked(small_design()); }), "");

  SensorDesign design = small_design();
  design.detector.pupil_pixels = 12;
  EXPECT_THAT(refusal(extended, design),
              StartsWith("simulation.pupil_samples = 32: a multiple of detector.pupil_pixels, "
                         "which is 12"));
  design.detector.pupil_pixels = 64;
  EXPECT_THAT(refusal(extended, design), StartsWith("simulation.pupil_samples = 32: "));

  design = small_design();
  design.reconstruction.oversampling = 3;
  EXPECT_THAT(refusal(extended, design), AllOf(StartsWith("reconstruction.oversampling = 3: "),
                                               HasSubstr("which is 48"), HasSubstr("which is 32")));
  for (const int oversampling : {1, 2, 4}) {
    design.reconstruction.oversampling = oversampling;
    EXPECT_EQ(message_of([&] { (void)extended.checked(design); }), "");
  }

  design = small_design();
  design.planes = {35e3};
  EXPECT_THAT(refusal(extended, design), StartsWith("sensor.planes = "));
  design = small_design();
  design.detector.window = 3.99;
  EXPECT_THAT(refusal(extended, design), StartsWith("detector.window = 3.99: "));
}

TEST(Simulation, NamesWhatDoesNotFitAMatchedTruth) {
  const Simulation matched({}, turbulence(1), {.truth = TruthModel::matched});
  const auto refusal = [&](const SensorDesign& design) {
    return message_of([&] { (void)matched.evaluate(design); });
  };
  SensorDesign design = matched_design();
  EXPECT_EQ(message_of([&] { (void)matched.checked(design); }), "");
  design.detector.pupil_pixels = 16;
  EXPECT_THAT(refusal(design),
              StartsWith("simulation.pupil_samples = 32: a matched truth has the detector's 16"));
  design = matched_design();
  design.reconstruction.oversampling = 2;
  EXPECT_THAT(refusal(design), StartsWith("reconstruction.oversampling = 2: 1 with a matched"));
  // The window that counts is the reconstruction's; the detector's own is not looked at.
  design = matched_design();
  design.reconstruction.window = 0.5;
  EXPECT_THAT(refusal(design), StartsWith("reconstruction.window = 0.5: "));
  design = matched_design();
  design.detector.window = 0.5;
  EXPECT_EQ(message_of([&] { (void)matched.checked(design); }), "");
}

TEST(Simulation, NeedsAScreenAndATelescope) {
  EXPECT_THAT(message_of([] { Simulation({}, {}, {}); }),
              StartsWith("screens.count = 0: at least 1"));
  EXPECT_THAT(message_of([] { Simulation({.diameter = -1.0}, turbulence(1), {}); }),
              StartsWith("telescope.diameter = -1: "));
}

TEST(Simulation, FailsWhereAWavefrontTakesTooLong) {
  const auto screens = turbulence(2);
  const Simulation slow({}, screens, {.time_limit = 1e-9});
  const auto expect_failure = [](const auto& action) {
    EXPECT_THAT(action, testing::ThrowsMessage<std::runtime_error>(
                            "a wavefront took longer than simulation.time_limit, 1e-09 s"));
  };
  expect_failure([&] { (void)slow.evaluate(small_design()); });
  expect_failure([&] { (void)slow.follow(small_design()); });
  expect_failure([&] { (void)slow.record(small_design(), 0); });

  const Simulation patient({}, screens, {.time_limit = 1e9});
  const Simulation unlimited({}, screens, {});
  EXPECT_EQ(patient.evaluate(small_design()).screens[1].wavefront.total_wfe,
            unlimited.evaluate(small_design()).screens[1].wavefront.total_wfe);
  // It decides on whether there is a result, not on the result.
  EXPECT_EQ(slow.identity(), unlimited.identity());
  EXPECT_EQ(patient.identity(), unlimited.identity());
}

TEST(Simulation, EndsWithItsFirstScreensWhereTheWatchSaysSo) {
  const std::vector<PhaseScreen> screens = turbulence(9);
  const Simulation simulation({}, screens, {});
  const Performance whole = simulation.evaluate(small_design());
  for (const int threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    for (const int most : {1, 3}) {
      std::atomic<int> done = 0;
      const Performance ended = simulation.evaluate(small_design(), [&] { return ++done < most; });
      EXPECT_EQ(ended.screens.size(), static_cast<std::size_t>(done));
      EXPECT_GE(done, most);
      EXPECT_LT(done, most + threads) << "those that are begun are done";
      for (std::size_t i = 0; i < ended.screens.size(); ++i) {
        EXPECT_EQ(ended.screens[i].wavefront.residual_wfe, whole.screens[i].wavefront.residual_wfe);
      }
    }
  }
  std::atomic<int> done = 0;
  EXPECT_EQ(simulation.follow(small_design(), [&] { return ++done < 9; }).screens.size(), 9u);
  EXPECT_EQ(done, 9) << "the last screen ends nothing";
}

}  // namespace
}  // namespace nlcwfs
