// Tests: Light is propagated to a window on an infinite plane, where nothing wraps round.
#include "model/wrap_free_propagator.hpp"

#include "coma_reference.hpp"
#include "model/fresnel_propagator.hpp"
#include "model/turbulence_screen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double wavelength = 532e-9;
constexpr double diameter = 0.5;

double relative_rms(const Image<double>& image, const Image<double>& reference) {
  return std::sqrt((image - reference).square().sum() / reference.square().sum());
}

/// A coma and defocus about as strong as turbulence of D/r0 = 8.
Field<double> aberrated_pupil(int samples) {
  return pupil_field(coma_phase(6.0, samples), pupil_mask(samples, 0.0));
}

Field<double> spectrum_of(const WrapFreePropagator& propagator, const Field<double>& pupil) {
  Field<double> spectrum = propagator.working_field();
  propagator.transform(pupil, spectrum);
  return spectrum;
}

Field<double> window_of(const WrapFreePropagator& propagator, const Field<double>& spectrum,
                        const LineFactors<double>& transfer) {
  Field<double> field = propagator.working_field();
  propagator.propagate(spectrum, transfer, field);
  return field.topLeftCorner(propagator.window_samples(), propagator.window_samples());
}

Field<double> light_in_window(const WrapFreePropagator& propagator, const Field<double>& pupil,
                              const LineFactors<double>& transfer) {
  return window_of(propagator, spectrum_of(propagator, pupil), transfer);
}

TEST(WrapFreePropagator, ZeroDistanceIsTheIdentityWithADarkSurround) {
  const WrapFreePropagator propagator(32, 96, diameter / 32, wavelength);
  const Field<double> pupil = aberrated_pupil(32);
  const Field<double> field = light_in_window(propagator, pupil, propagator.transfer_function(0.0));
  Field<double> expected = Field<double>::Zero(96, 96);
  expected.block(32, 32, 32, 32) = pupil;
  EXPECT_LT((field - expected).abs().maxCoeff(), 1e-13);
}

TEST(WrapFreePropagator, IsTheTransposeOfItselfAndConjugateBackwards) {
  // A symmetric system: propagating the transposed pupil transposes the field; propagating the
  // conjugate pupil backwards conjugates it.
  const WrapFreePropagator propagator(32, 96, diameter / 32, wavelength);
  const Field<double> pupil = aberrated_pupil(32);
  const LineFactors<double> transfer = propagator.transfer_function(30e3);
  const Field<double> field = light_in_window(propagator, pupil, transfer);
  const Field<double> transposed = light_in_window(propagator, pupil.transpose(), transfer);
  EXPECT_LT((transposed - field.transpose()).abs().maxCoeff(), 1e-13);
  const Field<double> backwards =
      light_in_window(propagator, pupil.conjugate(), propagator.transfer_function(-30e3));
  EXPECT_LT((backwards - field.conjugate()).abs().maxCoeff(), 1e-12);
}

TEST(WrapFreePropagator, AgreesWithTheDirectFresnelSumWhereItsChirpIsWellSampled) {
  // Where the chirp is well sampled over the grids, the sampled Fresnel integral is a second,
  // independent way; it replaces the band limit by replicas lambda z / pitch away. The light that
  // the pupil's sharp rim sends beyond the band limit makes the difference.
  const int samples = 64;
  const int window = 128;
  const double pitch = diameter / samples;
  const double distance = 120e3;
  const WrapFreePropagator propagator(samples, window, pitch, wavelength);
  const Field<double> pupil = aberrated_pupil(samples);
  const Field<double> field =
      light_in_window(propagator, pupil, propagator.transfer_function(distance));

  Eigen::MatrixXcd chirp(window, samples);
  for (int j = 0; j < window; ++j) {
    for (int k = 0; k < samples; ++k) {
      const double offset = (j - 0.5 * (window - 1) - (k - 0.5 * (samples - 1))) * pitch;
      chirp(j, k) = std::polar(
          pitch / std::sqrt(wavelength * distance),
          std::numbers::pi * offset * offset / (wavelength * distance) - std::numbers::pi / 4.0);
    }
  }
  const Field<double> direct = (chirp * pupil.matrix() * chirp.transpose()).array();
  EXPECT_LT(relative_rms(field.abs2(), direct.abs2()), 5e-4);
}

TEST(WrapFreePropagator, ShowsTheAnalyticOnAxisIntensityOfACircularAperture) {
  // I(0, z) = 4 sin^2(pi N / 2) with N = D^2 / (4 lambda z), from the Fresnel integral of a disc;
  // the pixelated rim leaves an error.
  const int samples = 512;
  const WrapFreePropagator propagator(samples, samples, diameter / samples, wavelength);
  const PupilMask mask = pupil_mask(samples, 0.0);
  const Field<double> spectrum =
      spectrum_of(propagator, pupil_field(PhaseScreen::Zero(samples, samples), mask));
  for (const double zones : {0.5, 1.0, 1.5, 2.5, 3.0}) {
    const double distance = diameter * diameter / (4.0 * wavelength * zones);
    const Field<double> field =
        window_of(propagator, spectrum, propagator.transfer_function(distance));
    const double on_axis = field.block(samples / 2 - 1, samples / 2 - 1, 2, 2).abs2().mean();
    const double expected = 4.0 * std::pow(std::sin(0.5 * std::numbers::pi * zones), 2);
    EXPECT_NEAR(on_axis, expected, 5e-3) << zones << " Fresnel zones";
  }
}

TEST(WrapFreePropagator, LosesNoLightAcrossAWindowThatHoldsAllOfIt) {
  // Band-limited light reaches lambda z / (2 pitch) + D/2 from the axis; but for the tails that the
  // sharp band limit makes.
  const int samples = 32;
  const double pitch = diameter / samples;
  const double distance = 20e3;
  const double reach = wavelength * distance / (2.0 * pitch) + 0.5 * diameter;
  const int window = 2 * static_cast<int>(std::ceil(1.5 * reach / pitch));
  const WrapFreePropagator propagator(samples, window, pitch, wavelength);
  const Field<double> pupil = aberrated_pupil(samples);
  const Field<double> field =
      light_in_window(propagator, pupil, propagator.transfer_function(distance));
  EXPECT_NEAR(field.abs2().sum() / pupil.abs2().sum(), 1.0, 5e-5);
}

/// The light in the window, propagated on a periodic plane so wide that what leaves it is not seen
/// in the window: all rows first, then the columns, of which only the window is kept.
Field<double> on_wide_plane(const Field<double>& pupil, int window, double distance) {
  const auto samples = int(pupil.rows());
  const double pitch = diameter / samples;
  const double reach = wavelength * std::abs(distance) / (2.0 * pitch) + 0.5 * diameter;
  const int period = fast_transform_length(
      std::max(4 * window, static_cast<int>(std::ceil(4.0 * (reach / pitch + 0.5 * window)))));
  const LineTransform<double> transform(period);
  const Eigen::ArrayXcd transfer =
      fresnel_transfer_function(period, pitch, wavelength, distance) / double(period);
  Eigen::ArrayXcd line(period);
  Eigen::ArrayXcd spectrum(period);
  const auto propagated = [&](const Eigen::ArrayXcd& lit) -> Eigen::ArrayXcd {
    line.setZero();
    line.segment((period - samples) / 2, samples) = lit;
    transform.forward(line.data(), spectrum.data());
    spectrum *= transfer;
    transform.backward(spectrum.data(), line.data());
    return line.segment((period - window) / 2, window);
  };
  Field<double> rows(samples, window);
  for (int row = 0; row < samples; ++row) rows.row(row) = propagated(pupil.row(row)).transpose();
  Field<double> field(window, window);
  for (int column = 0; column < window; ++column) field.col(column) = propagated(rows.col(column));
  return field;
}

class WrapFreeTurbulence : public testing::TestWithParam<double> {};

TEST_P(WrapFreeTurbulence, AgreesWithAPeriodicPlaneThatIsWideEnough) {
  const int samples = 128;
  const int window = 512;
  const double distance = GetParam();
  const WrapFreePropagator propagator(samples, window, diameter / samples, wavelength);
  const WrapFreePropagator wider(samples, window, diameter / samples, wavelength, 256.0);
  for (const double d_over_r0 : {4.0, 8.0}) {
    const Seeing seeing{.fried_parameter = diameter / d_over_r0};
    const Field<double> pupil =
        pupil_field(TurbulenceScreenGenerator(seeing, samples, diameter, 3).screen(0),
                    pupil_mask(samples, 0.0));
    const Field<double> spectrum = spectrum_of(propagator, pupil);
    const Image<double> intensity =
        window_of(propagator, spectrum, propagator.transfer_function(distance)).abs2();
    const Image<double> of_wider =
        window_of(propagator, spectrum, wider.transfer_function(distance)).abs2();
    const Image<double> reference = on_wide_plane(pupil, window, distance).abs2();
    // What is left is the wide plane's own wrapping, which falls with the square of its width.
    EXPECT_LT(relative_rms(intensity, reference), 1e-4);
    EXPECT_LT(relative_rms(intensity, of_wider), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, WrapFreeTurbulence,
                         testing::Values(5e3, -20e3, 47e3, -100e3, 250e3));

TEST(WrapFreePropagator, ItsErrorFallsWithTheSixthPowerOfTheKernelsPeriod) {
  // As it must with two corrections to the trapezoidal rule; a wrong one would leave the second or
  // fourth power. The period is a power of two, so that margins of powers of two give exact ratios.
  const auto transfer_with = [](double period_margin, double distance) {
    const WrapFreePropagator propagator(64, 256, diameter / 64, wavelength, period_margin);
    const LineFactors<double> transfer = propagator.transfer_function(distance);
    return Eigen::ArrayXcd(Eigen::ArrayXcd::NullaryExpr(
        transfer.length(), [&](Eigen::Index index) { return transfer[index]; }));
  };
  for (const double distance : {5e3, -47e3, 180e3, 1000e3}) {
    const Eigen::ArrayXcd exact = transfer_with(128.0, distance);
    const auto error = [&](double period_margin) {
      return std::sqrt((transfer_with(period_margin, distance) - exact).abs2().sum() /
                       exact.abs2().sum());
    };
    EXPECT_LT(error(4.0), 1e-5) << distance;
    EXPECT_NEAR(error(4.0) / error(8.0), 64.0, 6.0) << distance;
    EXPECT_LT(error(16.0), 2e-9) << distance;
  }
}

/// A Gaussian amplitude exp(-r^2 / waist^2).
Image<double> gaussian(int samples, double pitch, double waist) {
  return Image<double>::NullaryExpr(samples, samples, [&](Eigen::Index row, Eigen::Index column) {
    const double y = (double(row) - 0.5 * (samples - 1)) * pitch;
    const double x = (double(column) - 0.5 * (samples - 1)) * pitch;
    return std::exp(-(x * x + y * y) / (waist * waist));
  });
}

TEST(WrapFreePropagator, SpreadsAGaussianBeamAsTheTheorySays) {
  // The field of a beam of waist w is exp(-r^2 / (w^2 q)) / q with q = 1 + i lambda z / (pi w^2),
  // less the factor exp(ikz).
  const int samples = 96;
  const int window = 288;
  const double pitch = diameter / samples;
  const double waist = diameter / 12.0;
  const WrapFreePropagator propagator(samples, window, pitch, wavelength);
  const Field<double> spectrum =
      spectrum_of(propagator, gaussian(samples, pitch, waist).cast<std::complex<double>>());
  for (const double distance : {0.0, 3e3, -10e3, 47e3, -200e3, 1000e3}) {
    const std::complex<double> q(1.0, wavelength * distance / (std::numbers::pi * waist * waist));
    Field<double> expected(window, window);
    for (int row = 0; row < window; ++row) {
      for (int column = 0; column < window; ++column) {
        const double y = (row - 0.5 * (window - 1)) * pitch;
        const double x = (column - 0.5 * (window - 1)) * pitch;
        expected(row, column) = std::exp(-(x * x + y * y) / (waist * waist * q)) / q;
      }
    }
    const Field<double> field =
        window_of(propagator, spectrum, propagator.transfer_function(distance));
    EXPECT_LT((field - expected).abs().maxCoeff(), 1e-13) << distance;
  }
}

}  // namespace
}  // namespace nlcwfs
