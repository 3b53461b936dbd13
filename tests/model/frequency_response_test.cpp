// Tests: Single spatial frequencies are put before a sensor, beside what theory lets expect.
#include "model/frequency_response.hpp"

#include "model/detector.hpp"
#include "model/fresnel_propagator.hpp"
#include "model/pupil.hpp"
#include "model/random_stream.hpp"
#include "model/statistics.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using std::numbers::pi;

const Telescope telescope;

TEST(SinusoidScreen, HasItsPhaseAtTheSamplesCentres) {
  const PhaseSinusoid sinusoid{
      .frequency = 2.5, .amplitude = 0.3, .orientation = 0.7, .phase = 1.1};
  const int samples = 12;
  const PhaseScreen screen = sinusoid_screen(sinusoid, samples);
  ASSERT_EQ(screen.rows(), samples);
  ASSERT_EQ(screen.cols(), samples);
  for (const auto& [row, column] : {std::pair{0, 0}, {3, 8}, {11, 5}}) {
    const double x = (column + 0.5) / samples - 0.5;
    const double y = (row + 0.5) / samples - 0.5;
    const double cycles = 2.5 * (x * std::cos(0.7) + y * std::sin(0.7));
    EXPECT_NEAR(screen(row, column), 0.3 * std::sin(2.0 * pi * cycles + 1.1), 1e-14);
  }
}

/// The phase in the middle of a screen, and its slopes there, over the amplitude.
struct Middle {
  explicit Middle(const PhaseScreen& screen, double amplitude)
      : value(screen(half, half) / amplitude),
        slope_x((screen(half, half + 1) - screen(half, half - 1)) / amplitude),
        slope_y((screen(half + 1, half) - screen(half - 1, half)) / amplitude) {}
  static constexpr int half = 50;
  static constexpr int samples = 2 * half + 1;

  double value;
  double slope_x;
  double slope_y;
};

TEST(SinusoidScreen, AnotherFrequencyAndAmplitudeLeavesOrientationsAndPhases) {
  const auto slow = sinusoid_screens(0.1, 0.2, Middle::samples, 5, 3);
  const auto fast = sinusoid_screens(0.3, 0.5, Middle::samples, 5, 3);
  const auto more = sinusoid_screens(0.1, 0.2, Middle::samples, 9, 3);
  const auto other = sinusoid_screens(0.1, 0.2, Middle::samples, 5, 4);
  ASSERT_EQ(slow.size(), 5u);
  ASSERT_EQ(more.size(), 9u);
  for (std::size_t i = 0; i < slow.size(); ++i) {
    const Middle of_slow(slow[i], 0.2);
    const Middle of_fast(fast[i], 0.5);
    EXPECT_NEAR(of_slow.value, of_fast.value, 1e-12);
    EXPECT_NEAR(of_slow.slope_y * of_fast.slope_x, of_fast.slope_y * of_slow.slope_x, 1e-6);
    EXPECT_TRUE((slow[i] == more[i]).all());
    EXPECT_GT((slow[i] - other[i]).abs().maxCoeff(), 1e-3);
    EXPECT_GT((slow[i] - slow[(i + 1) % 5]).abs().maxCoeff(), 1e-3);
  }
}

TEST(SinusoidScreen, OrientationsAndPhasesAreUniform) {
  // Of uniform angles the sine's square has the mean 1/2 and the variance 1/8.
  const int count = 500;
  double phases = 0.0;
  double orientations = 0.0;
  for (const PhaseScreen& screen : sinusoid_screens(1e-3, 1.0, Middle::samples, count, 1)) {
    const Middle middle(screen, 1.0);
    phases += middle.value * middle.value;
    orientations += std::pow(middle.slope_y / std::hypot(middle.slope_x, middle.slope_y), 2);
  }
  const double bound = 4.0 * std::sqrt(0.125 / count);
  EXPECT_NEAR(phases / count, 0.5, bound);
  EXPECT_NEAR(orientations / count, 0.5, bound);
}

/// A periodic grid that holds the pupil and a whole number of a sinusoid's periods: an endless
/// pupil.
constexpr int grid = 120;
constexpr int cycles = 6;

/// The intensity at a distance behind an endless phase A sin(2 pi cycles x / D).
Image<double> image_of(double amplitude, double distance) {
  Field<double> field(grid, grid);
  for (int column = 0; column < grid; ++column) {
    field.col(column).setConstant(
        std::polar(1.0, amplitude * std::sin(2.0 * pi * cycles * column / grid)));
  }
  FresnelPropagator<double>(grid, telescope.diameter / grid, telescope.wavelength)
      .propagate(field, distance);
  return field.abs2();
}

/// sin(2 pi cycles x / D) on the grid.
Image<double> carrier() {
  return Image<double>::NullaryExpr(grid, grid, [](Eigen::Index, Eigen::Index column) {
    return std::sin(2.0 * pi * cycles * double(column) / grid);
  });
}

/// The modulation of an image with the phase's own sine, over the mean.
double modulation(const Image<double>& image) {
  return 2.0 * (image * carrier()).sum() / image.sum();
}

TEST(SinusoidContrast, IsThatOfThePropagatedLight) {
  const double amplitude = 1e-4;
  const double talbot = talbot_distance(telescope.diameter / cycles, telescope.wavelength);
  for (const double share : {-0.6, -0.25, -0.1, 0.0, 0.05, 0.25, 0.4, 0.5, 0.9, 1.3}) {
    const auto contrasts = sinusoid_contrasts(telescope, {share * talbot}, cycles);
    ASSERT_EQ(contrasts.size(), 1u);
    EXPECT_NEAR(contrasts.front().talbot,
                modulation(image_of(amplitude, share * talbot)) / amplitude, 1e-6)
        << share;
  }
}

TEST(SinusoidContrast, OfABandIsTheMeanOfItsWavelengthsImages) {
  const double amplitude = 1e-4;
  const std::vector<double> planes{-40e3, 90e3};
  for (const ChromaticAberration aberration :
       {ChromaticAberration::path, ChromaticAberration::phase}) {
    const LightSource source{.bands = {{400e-9, 500e-9}, {500e-9, 800e-9}},
                             .wavelengths = 3,
                             .weights = {1.0, 2.0, 3.0},
                             .aberration = aberration};
    const auto contrasts = sinusoid_contrasts(telescope, planes, cycles, source);
    for (std::size_t plane = 0; plane < 2; ++plane) {
      const double centre = source.bands[plane].centre();
      double expected = 0.0;
      for (const SpectralLine& line : source.lines(plane, 2, telescope.wavelength)) {
        // Where the band's middle has the Fresnel number of the plane, light of the line.
        Telescope coloured = telescope;
        coloured.wavelength = centre;
        const double distance = scaled_distance(planes[plane], telescope, coloured);
        const double phase = aberration == ChromaticAberration::path
                                 ? amplitude * telescope.wavelength / line.wavelength
                                 : amplitude;
        // At the telescope's wavelength the same image stands farther away.
        const double same = distance * line.wavelength / telescope.wavelength;
        expected += line.weight * modulation(image_of(phase, same)) / amplitude;
      }
      EXPECT_NEAR(contrasts[plane].talbot, expected, 1e-6);
    }
  }
}

/// The contrast of an endless pupil that would tell as much of a weak sinusoid's amplitude: from
/// the Fisher information of the light behind a round pupil itself, by differences.
double numerical_contrast(double distance, double frequency) {
  const int samples = 128;
  const int window = 256;
  const double step = 1e-3;
  const WrapFreePropagator propagator(samples, window, telescope.diameter / samples,
                                      telescope.wavelength);
  const LineFactors<double> transfer = propagator.transfer_function(distance);
  const PupilMask mask = pupil_mask(samples, 0.0);
  Field<double> spectrum = propagator.working_field();
  Field<double> field = propagator.working_field();
  const auto image = [&](const PhaseSinusoid& sinusoid) -> Image<double> {
    propagator.transform(pupil_field(sinusoid_screen(sinusoid, samples), mask), spectrum);
    propagator.propagate(spectrum, transfer, field);
    return field.topLeftCorner(window, window).abs2();
  };
  double information = 0.0;
  const std::vector<double> phases{0.3, 0.3 + 0.5 * pi};
  for (const double phase : phases) {
    const Image<double> more = image({frequency, step, 0.4, phase});
    const Image<double> less = image({frequency, -step, 0.4, phase});
    const Image<double> slope = (more - less) / (2.0 * step);
    information += (slope.square() / (0.5 * (more + less)).max(1e-12)).sum() / double(mask.count());
  }
  return std::sqrt(2.0 * information / double(phases.size()));
}

TEST(SinusoidContrast, OfARoundPupilTellsAsMuchAsItsLight) {
  // Between the near planes, where both beams meet (o = 0.9), and those where each is alone. The
  // diffraction at the pupil's rim, which the formula leaves out, is worth a few per cent.
  const double near = 10e3;
  for (const double frequency : {3.0, 5.0, 9.8, 13.0, 20.0, 28.0}) {
    const double expected = numerical_contrast(near, frequency);
    const auto contrast = sinusoid_contrasts(telescope, {near}, frequency).front();
    EXPECT_NEAR(contrast.effective / expected, 1.0, 0.06) << frequency;
  }
  // A Talbot blind one.
  const double blind = std::sqrt(fresnel_number(telescope, near));
  const auto contrast = sinusoid_contrasts(telescope, {near}, blind).front();
  EXPECT_NEAR(contrast.talbot, 0.0, 1e-10);
  EXPECT_NEAR(contrast.effective / numerical_contrast(near, blind), 1.0, 0.06);
}

TEST(SinusoidContrast, OfARoundPupilHasItsLimits) {
  for (const double share : {0.03, 0.2, 0.4, 0.5}) {
    // The finer the period, the nearer the same share of its Talbot distance.
    const double frequency = 1e4;
    const double distance =
        share * talbot_distance(telescope.diameter / frequency, telescope.wavelength);
    const auto contrast = sinusoid_contrasts(telescope, {distance}, frequency).front();
    EXPECT_NEAR(contrast.effective, std::abs(contrast.talbot), 0.03);
  }
  for (const double distance : {-180e3, 47e3}) {
    const double parted = 0.5 * std::abs(fresnel_number(telescope, distance));
    for (const double factor : {1.0, 1.1, 3.0}) {
      const auto contrast = sinusoid_contrasts(telescope, {distance}, factor * parted).front();
      EXPECT_NEAR(contrast.effective, std::numbers::sqrt2, 1e-12);
    }
    const auto there = sinusoid_contrasts(telescope, {distance}, 1.3).front();
    const auto opposite = sinusoid_contrasts(telescope, {-distance}, 1.3).front();
    EXPECT_DOUBLE_EQ(there.effective, opposite.effective);
    EXPECT_DOUBLE_EQ(there.talbot, -opposite.talbot);
  }
  EXPECT_EQ(sinusoid_contrasts(telescope, {0.0}, 5.0).front().effective, 0.0);
}

TEST(PhotonLimitedAmplitudeError, IsThatOfTheSumOverThePlanes) {
  const std::vector<double> planes{-180e3, 180e3, -47e3, 30e3};
  const double frequency = 2.2;
  double sum = 0.0;
  for (const double plane : planes) {
    const double sine =
        std::sin(pi * telescope.wavelength * plane * std::pow(frequency / telescope.diameter, 2));
    sum += 1e5 / 4.0 * sine * sine;
  }
  const double contrast =
      rms_contrast(sinusoid_contrasts(telescope, planes, frequency), &SinusoidContrast::talbot);
  EXPECT_NEAR(photon_limited_amplitude_error(1e5, contrast), 1.0 / std::sqrt(2.0 * sum), 1e-12);
  EXPECT_EQ(photon_limited_amplitude_error(1e5, 0.0), std::numeric_limits<double>::infinity());
}

TEST(PhotonLimitedAmplitudeError, IsThatOfTheBestEstimateFromNoisyImages) {
  const double amplitude = 0.02;
  const double photons = 1e6;
  const std::vector<double> planes{-20e3, 5e3};
  const auto contrasts = sinusoid_contrasts(telescope, planes, cycles);
  const double rms = rms_contrast(contrasts, &SinusoidContrast::talbot);
  const double photons_per_unit = photons / double(planes.size()) / (grid * grid);
  const Image<double> sine = carrier();
  std::vector<Image<double>> images;
  images.reserve(planes.size());
  for (const double plane : planes) images.push_back(image_of(amplitude, plane));

  // Weak: each pixel's weight is its derivative.
  const int draws = 400;
  std::vector<double> estimates;
  RandomStream stream = random_stream({7});
  for (int draw = 0; draw < draws; ++draw) {
    double weighted = 0.0;
    double weights = 0.0;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
      Image<double> image = images[plane];
      add_noise(image, photons_per_unit, 0.0, stream);
      const Image<double> slope = contrasts[plane].talbot * sine;
      weighted += (slope * (image - 1.0)).sum();
      weights += slope.square().sum();
    }
    estimates.push_back(weighted / weights);
  }
  const MeanAndError mean = mean_and_standard_error(estimates);
  const MeanAndError deviation = standard_deviation_and_error(estimates);
  EXPECT_NEAR(mean.mean, amplitude, 4.0 * mean.standard_error);
  EXPECT_NEAR(deviation.mean, photon_limited_amplitude_error(photons, rms),
              4.0 * deviation.standard_error);
}

}  // namespace
}  // namespace nlcwfs
