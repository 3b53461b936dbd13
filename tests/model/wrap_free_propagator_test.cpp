#include "model/wrap_free_propagator.hpp"

#include "coma_reference.hpp"
#include "model/fresnel_propagator.hpp"

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

TEST(WrapFreePropagator, ZeroDistanceIsTheIdentityWithADarkSurround) {
  const WrapFreePropagator propagator(32, 96, diameter / 32, wavelength);
  const Field<double> pupil = aberrated_pupil(32);
  const Field<double> field =
      propagator.field(propagator.spectrum(pupil), propagator.transfer_function(0.0));
  Field<double> expected = Field<double>::Zero(96, 96);
  expected.block(32, 32, 32, 32) = pupil;
  EXPECT_LT((field - expected).abs().maxCoeff(), 1e-13);
}

TEST(WrapFreePropagator, IsTheTransposeOfItselfAndConjugateBackwards) {
  // A symmetric system: propagating the transposed pupil transposes the field; propagating the
  // conjugate pupil backwards conjugates it.
  const WrapFreePropagator propagator(32, 96, diameter / 32, wavelength);
  const Field<double> pupil = aberrated_pupil(32);
  const Eigen::ArrayXcd transfer = propagator.transfer_function(30e3);
  const Field<double> field = propagator.field(propagator.spectrum(pupil), transfer);
  const Field<double> transposed =
      propagator.field(propagator.spectrum(pupil.transpose()), transfer);
  EXPECT_LT((transposed - field.transpose()).abs().maxCoeff(), 1e-13);
  const Field<double> backwards =
      propagator.field(propagator.spectrum(pupil.conjugate()), propagator.transfer_function(-30e3));
  EXPECT_LT((backwards - field.conjugate()).abs().maxCoeff(), 1e-12);
}

TEST(WrapFreePropagator, AgreesWithTheDirectFresnelSumWhereItsChirpIsWellSampled) {
  // Where the chirp is well sampled over the grids, the sampled Fresnel integral is a second,
  // independent way; it replaces the band limit by replicas lambda z / pitch away.
  const int samples = 64;
  const int window = 128;
  const double pitch = diameter / samples;
  const double distance = 120e3;
  const WrapFreePropagator propagator(samples, window, pitch, wavelength);
  const Field<double> pupil = aberrated_pupil(samples);
  const Field<double> field =
      propagator.field(propagator.spectrum(pupil), propagator.transfer_function(distance));

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
  EXPECT_LT(relative_rms(field.abs2(), direct.abs2()), 2e-2);
}

TEST(WrapFreePropagator, ShowsTheAnalyticOnAxisIntensityOfACircularAperture) {
  // I(0, z) = 4 sin^2(pi N / 2) with N = D^2 / (4 lambda z), from the Fresnel integral of a disc.
  const int samples = 512;
  const WrapFreePropagator propagator(samples, samples, diameter / samples, wavelength);
  const PupilMask mask = pupil_mask(samples, 0.0);
  const Field<double> spectrum =
      propagator.spectrum(pupil_field(PhaseScreen::Zero(samples, samples), mask));
  for (const double zones : {0.5, 1.0, 1.5, 2.5, 3.0}) {
    const double distance = diameter * diameter / (4.0 * wavelength * zones);
    const Field<double> field = propagator.field(spectrum, propagator.transfer_function(distance));
    const double on_axis = field.block(samples / 2 - 1, samples / 2 - 1, 2, 2).abs2().mean();
    const double expected = 4.0 * std::pow(std::sin(0.5 * std::numbers::pi * zones), 2);
    EXPECT_NEAR(on_axis, expected, 0.05) << zones << " Fresnel zones";
  }
}

TEST(WrapFreePropagator, LosesNoLightAcrossAWindowThatHoldsAllOfIt) {
  // Band-limited light reaches lambda z / (2 pitch) + D/2 from the axis.
  const int samples = 32;
  const double pitch = diameter / samples;
  const double distance = 20e3;
  const double reach = wavelength * distance / (2.0 * pitch) + 0.5 * diameter;
  const int window = 2 * static_cast<int>(std::ceil(1.5 * reach / pitch));
  const WrapFreePropagator propagator(samples, window, pitch, wavelength);
  const Field<double> pupil = aberrated_pupil(samples);
  const Field<double> field =
      propagator.field(propagator.spectrum(pupil), propagator.transfer_function(distance));
  EXPECT_NEAR(field.abs2().sum() / pupil.abs2().sum(), 1.0, 1e-3);
}

}  // namespace
}  // namespace nlcwfs
