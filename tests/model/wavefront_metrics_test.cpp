// Tests: A reconstruction is held against the truth: wavefront errors and Strehl ratio.
#include "model/wavefront_metrics.hpp"

#include "model/phase_unwrapping.hpp"
#include "model/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double wavelength = 532e-9;
constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double length_per_radian = wavelength / two_pi;

/// function(x, y) at the samples' centres; the pupil is the unit disc.
template <class Function>
PhaseScreen sampled(int samples, const Function& function) {
  return PhaseScreen::NullaryExpr(samples, samples, [&](Eigen::Index row, Eigen::Index column) {
    return function((2.0 * double(column) + 1.0) / samples - 1.0,
                    (2.0 * double(row) + 1.0) / samples - 1.0);
  });
}

PhaseScreen tilt(int samples, double coefficient) {
  return sampled(samples, [=](double x, double y) { return coefficient * (0.6 * x - 0.8 * y); });
}
PhaseScreen defocus(int samples, double coefficient) {
  return sampled(samples,
                 [=](double x, double y) { return coefficient * (2.0 * (x * x + y * y) - 1.0); });
}

PhaseScreen random_phase(int samples, double rms) {
  RandomStream stream = random_stream({17});
  boost::random::normal_distribution<double> normal;
  return PhaseScreen::NullaryExpr(samples, samples, [&] { return rms * normal(stream); });
}

/// The metrics of a field of the given phase, which stands as the unwrapped one.
WavefrontMetrics metrics_of(const PhaseScreen& phase, const PhaseScreen& truth,
                            double central_obscuration = 0.0) {
  const PupilMask mask = pupil_mask(int(phase.rows()), central_obscuration);
  const PupilMask truth_mask = pupil_mask(int(truth.rows()), central_obscuration);
  return measure_wavefront(pupil_field(phase, mask), mask.select(phase, 0.0), mask, truth,
                           truth_mask, wavelength);
}

TEST(WavefrontMetrics, APistonIsNoError) {
  const PhaseScreen truth = defocus(32, 1.3);
  for (const double piston : {0.0, 1.0, -3.0, 40.0}) {
    const WavefrontMetrics metrics = metrics_of(truth + piston, truth);
    EXPECT_NEAR(metrics.residual_wfe, 0.0, 1e-20);
    EXPECT_NEAR(metrics.wrapped_wfe, 0.0, 1e-20);
    EXPECT_NEAR(metrics.total_wfe, 0.0, 1e-20);
    EXPECT_NEAR(metrics.field_strehl, 1.0, 1e-12);
  }
}

TEST(WavefrontMetrics, KnownErrorsHaveTheirAnalyticRms) {
  // Over the unit disc a tilt's RMS is half its coefficient, that of defocus 1/sqrt(3) of it; the
  // sampled rim leaves an error of the order of a pixel's share, 1/n^(3/2) or so.
  const int samples = 128;
  const PhaseScreen truth = defocus(samples, 2.0) + tilt(samples, -1.0);
  const double coefficient = 0.4;
  const WavefrontMetrics tilted = metrics_of(truth + tilt(samples, coefficient), truth);
  const WavefrontMetrics defocused = metrics_of(truth + defocus(samples, coefficient), truth);
  const double tilt_rms = 0.5 * coefficient * length_per_radian;
  const double defocus_rms = coefficient / std::numbers::sqrt3 * length_per_radian;
  for (const auto metric : {&WavefrontMetrics::residual_wfe, &WavefrontMetrics::wrapped_wfe,
                            &WavefrontMetrics::total_wfe}) {
    EXPECT_NEAR(tilted.*metric / tilt_rms, 1.0, 2e-3);
    EXPECT_NEAR(defocused.*metric / defocus_rms, 1.0, 2e-3);
  }
}

TEST(WavefrontMetrics, DefocusOverAnAnnulusHasItsAnalyticRms) {
  // The variance of 2 rho^2 - 1 over eps <= rho <= 1 is (1 - eps^2)^2 / 3.
  const double obscuration = 0.4;
  const WavefrontMetrics metrics =
      metrics_of(defocus(128, 0.5), PhaseScreen::Zero(128, 128), obscuration);
  const double expected =
      0.5 * (1.0 - obscuration * obscuration) / std::numbers::sqrt3 * length_per_radian;
  EXPECT_NEAR(metrics.residual_wfe / expected, 1.0, 5e-3);
  EXPECT_NEAR(metrics.wrapped_wfe / expected, 1.0, 5e-3);
}

TEST(WavefrontMetrics, TheWrappedErrorIsTheResidualOfSmallErrors) {
  // The argument of the mean phasor differs from the mean phase in the third order.
  const PhaseScreen truth = defocus(64, 3.0);
  const WavefrontMetrics metrics = metrics_of(truth + random_phase(64, 0.05), truth);
  EXPECT_NEAR(metrics.wrapped_wfe, metrics.residual_wfe, 1e-6 * metrics.residual_wfe);
}

TEST(WavefrontMetrics, TheWrappedErrorIsBlindToCycles) {
  const PhaseScreen truth = defocus(64, 3.0);
  const PhaseScreen error = random_phase(64, 0.3);
  // The left half of the pupil is a cycle off: an RMS of half a cycle.
  PhaseScreen cycles = PhaseScreen::Zero(64, 64);
  cycles.leftCols(32).setConstant(two_pi);
  const WavefrontMetrics clean = metrics_of(truth + error, truth);
  const WavefrontMetrics slipped = metrics_of(truth + error + cycles, truth);
  EXPECT_NEAR(slipped.wrapped_wfe, clean.wrapped_wfe, 1e-12 * wavelength);
  EXPECT_NEAR(slipped.field_strehl, clean.field_strehl, 1e-12);
  EXPECT_NEAR(metrics_of(truth + cycles, truth).residual_wfe, 0.5 * wavelength, 1e-12 * wavelength);
}

TEST(WavefrontMetrics, StrehlOfRandomErrorsIsThatOfMarechal) {
  // E[S_F] = exp(-s^2) + (1 - exp(-s^2)) / n for n independent errors. Its standard error: the mean
  // phasor's real part has the variance (1 - exp(-s^2))^2 / (2 n), doubled by squaring.
  for (const double rms : {0.05, 0.2, 0.5}) {
    const auto count = double(pupil_mask(128, 0.0).count());
    const double coherent = std::exp(-rms * rms);
    const double expected = coherent + (1.0 - coherent) / count;
    const double error = 2.0 * std::sqrt(coherent) * (1.0 - coherent) / std::sqrt(2.0 * count);
    const WavefrontMetrics metrics =
        metrics_of(random_phase(128, rms), PhaseScreen::Zero(128, 128));
    EXPECT_NEAR(metrics.field_strehl, expected, 4.0 * error) << rms;
  }
}

TEST(RecoveredShare, IsThatOfTheTruthInTheReconstruction) {
  const PupilMask mask = pupil_mask(64, 0.2);
  const PhaseScreen truth = random_phase(64, 1.0) + 3.0;
  for (const double share : {-0.5, 0.0, 0.8, 1.0}) {
    EXPECT_NEAR(recovered_share(share * truth + 5.0, truth, mask), share, 1e-12);
  }
  // What has nothing to do with the truth counts little: a regression of noise over n samples.
  const double error = 1.0 / std::sqrt(double(mask.count()));
  EXPECT_NEAR(recovered_share(truth + tilt(64, 1.0), truth, mask), 1.0, 4.0 * error);
  EXPECT_EQ(recovered_share(truth, PhaseScreen::Constant(64, 64, 2.0), mask), 0.0);
  // Nor does what is outside the pupil.
  PhaseScreen outside = truth;
  outside(0, 0) = 1e9;
  EXPECT_NEAR(recovered_share(outside, truth, mask), 1.0, 1e-12);
}

TEST(FieldEstimatedStrehl, DoesNotDependOnBrightnessAndPunishesUnevenAmplitudes) {
  const PupilMask mask = pupil_mask(64, 0.2);
  const Field<double> truth = pupil_field(random_phase(64, 1.0), mask);
  const Field<double> field = pupil_field(random_phase(64, 1.1), mask);
  const double strehl = field_estimated_strehl(field, truth, mask);
  EXPECT_NEAR(field_estimated_strehl(1e-3 * field, 5.0 * truth, mask), strehl, 1e-12);
  EXPECT_NEAR(field_estimated_strehl(field * std::polar(2.0, 1.0), truth, mask), strehl, 1e-12);
  // A left half of amplitude 3 and a right half of 1: (3 + 1)^2 / (2 (9 + 1)).
  Field<double> uneven = truth;
  uneven.leftCols(32) *= 3.0;
  EXPECT_NEAR(field_estimated_strehl(uneven, truth, mask), 0.8, 1e-12);
  // Light outside the mask does not count.
  Field<double> surrounded = mask.select(field, std::complex<double>(9.0));
  EXPECT_NEAR(field_estimated_strehl(surrounded, truth, mask), strehl, 1e-12);
}

TEST(FieldEstimatedStrehl, OfADarkFieldIsZero) {
  const PupilMask mask = pupil_mask(16, 0.0);
  EXPECT_EQ(
      field_estimated_strehl(Field<double>::Zero(16, 16), mask.cast<std::complex<double>>(), mask),
      0.0);
}

TEST(WavefrontMetrics, TotalErrorOfPerfectCoarseSamplesIsWhatTheyCannotResolve) {
  // A ripple through pixels of `factor` truth samples that hold its mean. A truth sample at the
  // share t of the way from one pixel's centre to the next gets, relative to exp(i k x), the mean
  // of both pixels, which is the pixel's own loss times (1 - t) exp(-i k t) + t exp(i k (1 - t)).
  const int fine = 128;
  const int factor = 4;
  const PupilMask mask = pupil_mask(fine / factor, 0.0);
  // The rim, which has its own errors, is left out.
  PupilMask inner = PupilMask::Constant(fine, fine, false);
  inner.block(8, 8, 112, 112) = pupil_mask(112, 0.0);
  for (const int periods : {1, 2, 4, 8}) {
    const PhaseScreen truth =
        sampled(fine, [=](double x, double) { return std::sin(std::numbers::pi * periods * x); });
    const PhaseScreen mean = block_average(truth, factor);
    const WavefrontMetrics metrics =
        measure_wavefront(pupil_field(mean, mask), mean, mask, truth, inner, wavelength);
    EXPECT_NEAR(metrics.residual_wfe, 0.0, 1e-12 * wavelength);

    const double k = two_pi * periods * factor / fine;  // rad per pixel
    double pixel_gain = 0.0;
    for (int i = 0; i < factor; ++i)
      pixel_gain += std::cos(k * ((i + 0.5) / factor - 0.5)) / factor;
    double variance = 0.0;
    for (int i = 0; i < factor; ++i) {
      const double t = (i + 0.5) / factor;
      const std::complex<double> interpolated =
          pixel_gain * ((1.0 - t) * std::polar(1.0, -k * t) + t * std::polar(1.0, k * (1.0 - t)));
      variance += 0.5 * std::norm(interpolated - 1.0) / factor;
    }
    // The disc does not hold whole periods: the share of its rim in the ripple's mean square.
    EXPECT_NEAR(metrics.total_wfe / (std::sqrt(variance) * length_per_radian), 1.0,
                0.1 / std::sqrt(periods))
        << periods;
  }
}

TEST(WavefrontMetrics, TotalErrorIsNeverBelowTheResidual) {
  // Noise of single samples, which an interpolation to the truth's would smooth by a third.
  const PhaseScreen truth = defocus(128, 3.0) + tilt(128, 1.0);
  for (const int samples : {16, 32, 64, 128, 256}) {
    const PhaseScreen sampled_truth = truth_on_samples(truth, samples);
    const WavefrontMetrics noisy =
        metrics_of(sampled_truth + random_phase(samples, 1.0), truth, 0.2);
    const WavefrontMetrics exact = metrics_of(sampled_truth, truth, 0.2);
    EXPECT_GE(noisy.total_wfe, noisy.residual_wfe) << samples;
    EXPECT_NEAR(noisy.total_wfe, std::hypot(noisy.residual_wfe, exact.total_wfe),
                1e-12 * wavelength)
        << samples;
  }
}

TEST(WavefrontMetrics, TotalErrorOfATiltIsTheRimsAlone) {
  // Half a pixel around the rim is extrapolated by its nearest samples.
  for (const int coarse : {16, 32, 64}) {
    const WavefrontMetrics metrics = metrics_of(tilt(coarse, 1.0), tilt(128, 1.0));
    EXPECT_NEAR(metrics.residual_wfe, 0.0, 1e-12 * wavelength);
    EXPECT_LT(
        metrics.total_wfe,
        0.25 / coarse * piston_free_rms(tilt(128, 1.0), pupil_mask(128, 0.0)) * length_per_radian);
  }
}

TEST(WavefrontMetrics, AFinerReconstructionIsComparedWithRepeatedTruth) {
  const PhaseScreen truth = random_phase(16, 0.5);
  const PhaseScreen repeated = PhaseScreen::NullaryExpr(
      48, 48, [&](Eigen::Index row, Eigen::Index column) { return truth(row / 3, column / 3); });
  const WavefrontMetrics metrics = metrics_of(repeated, truth);
  EXPECT_NEAR(metrics.residual_wfe, 0.0, 1e-12 * wavelength);
  EXPECT_NEAR(metrics.wrapped_wfe, 0.0, 1e-12 * wavelength);
  EXPECT_NEAR(metrics.field_strehl, 1.0, 1e-12);
  // Away from the rim, where some of the finer samples lie outside the finer mask, their means are
  // the truth; at the rim they are as all samples of a block are equal.
  EXPECT_NEAR(metrics.total_wfe, 0.0, 1e-12 * wavelength);
}

TEST(PistonFreeRms, CountsTheMaskOnlyAndForgetsAnyPiston) {
  const PupilMask mask = pupil_mask(20, 0.3);
  const PhaseScreen phase = random_phase(20, 1.0);
  const PhaseScreen dirty = mask.select(phase, 1e9);
  EXPECT_NEAR(piston_free_rms(dirty, mask), piston_free_rms(phase, mask), 1e-14);
  EXPECT_NEAR(piston_free_rms(phase + 1e3, mask), piston_free_rms(phase, mask), 1e-12);
  EXPECT_NEAR(piston_free_rms(-2.0 * phase, mask), 2.0 * piston_free_rms(phase, mask), 1e-14);
}

TEST(WrappedPhaseRms, OfUniformPhasesIsThatOfTheUniformDistribution) {
  // pi / sqrt(3); with one sample of a cycle in each of n phases, exactly pi / sqrt(3) less the
  // sampling's 1/n^2.
  const int samples = 64;
  const PupilMask mask = PupilMask::Constant(samples, samples, true);
  Field<double> field(samples, samples);
  for (int column = 0; column < samples; ++column) {
    field.col(column).setConstant(std::polar(1.0, two_pi * (column + 0.5) / samples));
  }
  field(0, samples / 2) *= 1.0 + 1e-6;  // says where the mean phasor points
  EXPECT_NEAR(wrapped_phase_rms(field, Field<double>::Ones(samples, samples), mask),
              std::numbers::pi / std::numbers::sqrt3, 1e-2);
}

TEST(ResampleOverMask, AveragesTheMasksSamplesOfEachBlock) {
  const PupilMask mask = pupil_mask(24, 0.4);
  const PhaseScreen phase = mask.select(random_phase(24, 1.0), 1e9);
  for (const int factor : {1, 2, 3, 4}) {
    const Image<double> coarse = resample_over_mask(phase, mask, 24 / factor);
    for (int row = 0; row < 24 / factor; ++row) {
      for (int column = 0; column < 24 / factor; ++column) {
        const auto inside = mask.block(row * factor, column * factor, factor, factor);
        const auto values = phase.block(row * factor, column * factor, factor, factor);
        const double sum = inside.select(values, 0.0).sum();
        const auto count = double(inside.count());
        EXPECT_NEAR(coarse(row, column), sum / std::max(count, 1.0), 1e-13);
      }
    }
  }
}

TEST(ResampleOverMask, InterpolatesAPlaneExactlyAwayFromTheRims) {
  for (const double obscuration : {0.0, 0.4}) {
    const PupilMask mask = pupil_mask(32, obscuration);
    for (const int factor : {2, 3, 4}) {
      const PhaseScreen fine = tilt(32 * factor, 3.0);
      const Image<double> resampled = resample_over_mask(tilt(32, 3.0), mask, 32 * factor);
      const double pixel = 2.0 / 32.0;
      int inner = 0;
      for (int row = 0; row < 32 * factor; ++row) {
        for (int column = 0; column < 32 * factor; ++column) {
          const double radius = std::hypot((2.0 * column + 1.0) / (32.0 * factor) - 1.0,
                                           (2.0 * row + 1.0) / (32.0 * factor) - 1.0);
          const double to_a_rim =
              obscuration > 0.0 ? std::min(1.0 - radius, radius - obscuration) : 1.0 - radius;
          if (to_a_rim < 0.0) continue;
          // At the rims a sample is at most some two pixels from where its value comes from.
          const bool is_inner = to_a_rim >= 1.5 * pixel;
          EXPECT_NEAR(resampled(row, column), fine(row, column),
                      is_inner ? 1e-13 : 3.0 * 2.0 * pixel);
          inner += is_inner ? 1 : 0;
        }
      }
      EXPECT_GT(inner, 300 * factor * factor);
    }
  }
}

TEST(ResampleOverMask, ReachesEverySampleOfTheFinerPupil) {
  // A constant stays one all the way to the rims.
  for (const int coarse : {4, 6, 8, 10, 16, 32, 64}) {
    for (const double obscuration : {0.0, 0.1, 0.25, 0.5}) {
      const PupilMask mask = pupil_mask(coarse, obscuration);
      for (const int factor : {2, 3, 4, 8}) {
        const PupilMask fine = pupil_mask(coarse * factor, obscuration);
        const Image<double> resampled =
            resample_over_mask(mask.cast<double>() * 7.0, mask, coarse * factor);
        EXPECT_NEAR(fine.select((resampled - 7.0).abs(), 0.0).maxCoeff(), 0.0, 1e-13)
            << coarse << " x " << factor << ", obscuration " << obscuration;
      }
    }
  }
}

}  // namespace
}  // namespace nlcwfs
