// Tests: Phase screens are drawn whose structure function is exact.
#include "model/turbulence_screen.hpp"

#include "model/input_error.hpp"
#include "model/screen_statistics.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

constexpr double diameter = 0.5;
constexpr Seeing kolmogorov{.fried_parameter = 0.125};

bool same(const PhaseScreen& a, const PhaseScreen& b) { return (a == b).all(); }

/// Rows, columns and both diagonals, `step` samples along each axis.
std::vector<SampleOffset> offsets_of(int step) {
  return {{0, step}, {step, 0}, {step, step}, {step, -step}};
}

double separation_of(SampleOffset offset, int samples) {
  return std::hypot(offset.rows, offset.columns) * diameter / samples;
}

void expect_within_one_percent_or_three_errors(const MeanAndError& measured, double theory) {
  EXPECT_NEAR(measured.mean, theory, std::max(0.01 * theory, 3.0 * measured.standard_error));
}

TEST(TurbulenceScreen, HasKolmogorovStatisticsAtEverySeparationAndOverThePupil) {
  constexpr int samples = 64;
  const std::vector<PhaseScreen> screens =
      generate_screens(TurbulenceScreenGenerator(kolmogorov, samples, diameter, 8), 4000);
  for (int step = 1; step < samples; ++step) {
    for (const SampleOffset offset : offsets_of(step)) {
      SCOPED_TRACE(testing::Message() << offset.rows << " rows, " << offset.columns << " columns");
      expect_within_one_percent_or_three_errors(
          structure_function(screens, offset),
          kolmogorov_structure_function(separation_of(offset, samples),
                                        kolmogorov.fried_parameter));
    }
  }
  const PupilMask pupil = pupil_mask(samples, 0.0);
  expect_within_one_percent_or_three_errors(
      piston_removed_variance(screens, pupil),
      noll_piston_removed_variance(diameter, kolmogorov.fried_parameter));
  expect_within_one_percent_or_three_errors(
      tilt_removed_variance(screens, pupil),
      noll_tilt_removed_variance(diameter, kolmogorov.fried_parameter));
}

TEST(TurbulenceScreen, IsExactForEveryOuterScale) {
  // Few samples allow many screens: standard errors near 1 %, with no other tolerance.
  constexpr int samples = 8;
  const std::vector<std::optional<double>> outer_scales{0.0025, 0.05, 0.25,  0.5,
                                                        1.25,   5.0,  500.0, std::nullopt};
  for (const std::optional<double> outer_scale : outer_scales) {
    const Seeing seeing{.fried_parameter = 0.125, .outer_scale = outer_scale};
    const std::vector<PhaseScreen> screens =
        generate_screens(TurbulenceScreenGenerator(seeing, samples, diameter, 1), 10000);
    for (int step = 1; step < samples; ++step) {
      for (const SampleOffset offset : offsets_of(step)) {
        const MeanAndError measured = structure_function(screens, offset);
        const double theory = von_karman_structure_function(separation_of(offset, samples), seeing);
        EXPECT_NEAR(measured.mean, theory, 4.0 * measured.standard_error)
            << offset.rows << " rows, " << offset.columns << " columns, outer scale "
            << outer_scale.value_or(0.0);
        EXPECT_LT(measured.standard_error, 0.02 * theory);
      }
    }
  }
}

TEST(TurbulenceScreen, CanBeMadeForAnyOuterScaleAndSampling) {
  for (const int samples : {2, 3, 17, 100}) {
    for (double outer_scale = 1e-6 * diameter; outer_scale < 1e7 * diameter; outer_scale *= 1.7) {
      EXPECT_NO_THROW(TurbulenceScreenGenerator({0.125, outer_scale}, samples, diameter, 1))
          << samples << " samples, outer scale " << outer_scale;
    }
  }
}

TEST(TurbulenceScreen, AFiniteOuterScaleOfAMillionDiametersIsNearlyKolmogorov) {
  const PhaseScreen finite =
      TurbulenceScreenGenerator({0.125, 1e6 * diameter}, 16, diameter, 1).screen(0);
  const PhaseScreen infinite = TurbulenceScreenGenerator(kolmogorov, 16, diameter, 1).screen(0);
  const double difference =
      ((finite - finite.mean()) - (infinite - infinite.mean())).abs().maxCoeff();
  EXPECT_LT(difference, 0.02 * (infinite - infinite.mean()).abs().maxCoeff());
}

TEST(TurbulenceScreen, PairsShareATransformAndYetAreIndependent) {
  const std::vector<PhaseScreen> screens =
      generate_screens(TurbulenceScreenGenerator(kolmogorov, 8, diameter, 1), 20000);
  std::vector<double> next;
  std::vector<double> after_next;
  for (std::size_t i = 0; i + 2 < screens.size(); i += 2) {
    const auto across = [&](std::size_t screen) {
      return screens[screen](3, 7) - screens[screen](3, 0);
    };
    next.push_back(across(i) * across(i + 1));
    after_next.push_back(across(i) * across(i + 2));
  }
  for (const auto& products : {next, after_next}) {
    const MeanAndError covariance = mean_and_standard_error(products);
    EXPECT_NEAR(covariance.mean, 0.0, 4.0 * covariance.standard_error);
  }
}

TEST(TurbulenceScreen, IsTheSameForAnyNumberOfThreads) {
  const TurbulenceScreenGenerator generator(kolmogorov, 32, diameter, 7);
  std::vector<std::vector<PhaseScreen>> sets;
  for (const int threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    sets.push_back(generate_screens(generator, 9));
  }
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_TRUE(same(sets[0][i], sets[1][i]));
    EXPECT_TRUE(same(sets[0][i], sets[2][i]));
  }
}

TEST(TurbulenceScreen, DoesNotDependOnWhichOthersAreDrawn) {
  const TurbulenceScreenGenerator generator({0.125, 5.0}, 16, diameter, 7);
  const std::vector<PhaseScreen> five = generate_screens(generator, 5);
  const std::vector<PhaseScreen> eight = generate_screens(generator, 8);
  ASSERT_EQ(five.size(), 5u);
  ASSERT_EQ(eight.size(), 8u);
  EXPECT_TRUE(generate_screens(generator, 0).empty());
  for (int i = 4; i >= 0; --i) {
    EXPECT_TRUE(same(five[i], eight[i]));
    EXPECT_TRUE(same(five[i], generator.screen(i)));
    const TurbulenceScreenGenerator again({0.125, 5.0}, 16, diameter, 7);
    EXPECT_TRUE(same(five[i], again.screen(i)));
  }
}

TEST(TurbulenceScreen, SeedsAndIndicesGiveDifferentScreens) {
  std::vector<PhaseScreen> screens;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32}) {
    const TurbulenceScreenGenerator generator(kolmogorov, 8, diameter, seed);
    for (int index = 0; index < 4; ++index) screens.push_back(generator.screen(index));
  }
  for (std::size_t i = 0; i < screens.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(same(screens[i], screens[j]));
  }
}

TEST(TurbulenceScreen, PhaseScalesWithTheFriedParameterToThePowerMinusFiveSixths) {
  const PhaseScreen strong = TurbulenceScreenGenerator({0.1, 5.0}, 16, diameter, 1).screen(0);
  const PhaseScreen weak = TurbulenceScreenGenerator({0.2, 5.0}, 16, diameter, 1).screen(0);
  EXPECT_TRUE(strong.isApprox(std::pow(2.0, 5.0 / 6.0) * weak, 1e-12));
}

TEST(TurbulenceScreen, OnlyTheRatiosOfTheLengthsMatter) {
  const PhaseScreen small = TurbulenceScreenGenerator({0.1, 5.0}, 16, 0.5, 1).screen(0);
  const PhaseScreen large = TurbulenceScreenGenerator({1.0, 50.0}, 16, 5.0, 1).screen(0);
  EXPECT_TRUE(small.isApprox(large, 1e-12));
}

TEST(TurbulenceScreen, RefusesSeeingThatIsNotPhysical) {
  EXPECT_THROW(TurbulenceScreenGenerator({0.0}, 16, diameter, 1), InputError);
  EXPECT_THROW(TurbulenceScreenGenerator({0.1, -1.0}, 16, diameter, 1), InputError);
}

TEST(TurbulenceScreen, EndsWithItsFirstScreensWhereTheWatchSaysSo) {
  const TurbulenceScreenGenerator generator({.fried_parameter = 0.1}, 8, 0.5, 4);
  const std::vector<PhaseScreen> whole = generate_screens(generator, 21);
  std::atomic<int> drawn = 0;
  const std::vector<PhaseScreen> ended = generate_screens(generator, 21, [&](int more) {
    drawn += more;
    return drawn < 5;
  });
  EXPECT_EQ(ended.size(), static_cast<std::size_t>(drawn));
  EXPECT_GE(ended.size(), 5u);
  for (std::size_t i = 0; i < ended.size(); ++i) EXPECT_TRUE((ended[i] == whole[i]).all());
  drawn = 0;
  EXPECT_EQ(generate_screens(generator, 21,
                             [&](int more) {
                               drawn += more;
                               return true;
                             })
                .size(),
            21u);
  EXPECT_EQ(drawn, 21);
}

}  // namespace
}  // namespace nlcwfs
