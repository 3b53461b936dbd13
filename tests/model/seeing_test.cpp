// Tests: The turbulence that a telescope looks through, and the theory of its phase.
#include "model/seeing.hpp"

#include "model/input_error.hpp"
#include "model/screen_statistics.hpp"
#include "model/turbulence_screen.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(Seeing, FriedParameterOfOneArcsecondAt500NanometresIs10Centimetres) {
  EXPECT_NEAR(fried_parameter_of_fwhm(1.0, 500e-9), 0.10066, 1e-5);
  EXPECT_NEAR(fried_parameter_of_fwhm(0.5, 500e-9), 2.0 * fried_parameter_of_fwhm(1.0, 500e-9),
              1e-15);
}

TEST(Seeing, FriedParameterGrowsWithWavelengthToThePowerSixFifths) {
  EXPECT_NEAR(scaled_fried_parameter(0.1, 500e-9, 1000e-9), 0.1 * std::pow(2.0, 1.2), 1e-15);
  EXPECT_NEAR(scaled_fried_parameter(scaled_fried_parameter(0.1, 500e-9, 2.2e-6), 2.2e-6, 500e-9),
              0.1, 1e-15);
}

TEST(Seeing, WavelengthScalingKeepsTheOpticalPath) {
  // Phase variance goes with 1 / lambda^2 where the optical path is one and the same.
  const double r0 = scaled_fried_parameter(0.1, 500e-9, 800e-9);
  EXPECT_NEAR(kolmogorov_structure_function(0.3, r0) * 800.0 * 800.0,
              kolmogorov_structure_function(0.3, 0.1) * 500.0 * 500.0, 1e-4);
}

TEST(Seeing, KolmogorovStructureFunctionIs6Point88AtTheFriedParameter) {
  EXPECT_DOUBLE_EQ(kolmogorov_structure_function(0.125, 0.125), 6.88);
  EXPECT_DOUBLE_EQ(kolmogorov_structure_function(1.0, 0.125), 6.88 * 32.0);
  EXPECT_EQ(kolmogorov_structure_function(0.0, 0.125), 0.0);
}

TEST(Seeing, VarianceOverThePupilIsNolls) {
  EXPECT_DOUBLE_EQ(noll_piston_removed_variance(1.0, 0.125), 1.0299 * 32.0);
  EXPECT_DOUBLE_EQ(noll_tilt_removed_variance(1.0, 0.125), 0.134 * 32.0);
}

TEST(Seeing, ServoLagIsTheStructureFunctionOfASingleLayer) {
  // 28.4 (tau f_G)^(5/3) = 6.88 (v tau / r0)^(5/3), to the constants' three digits.
  for (const double delay : {0.0, 1e-5, 1e-3, 0.3}) {
    for (const double wind : {0.5, 10.0, 80.0}) {
      const double expected = kolmogorov_structure_function(wind * delay, 0.15);
      EXPECT_NEAR(servo_lag_variance(delay, greenwood_frequency(wind, 0.15)), expected,
                  1e-3 * expected);
    }
  }
}

TEST(Seeing, GreenwoodFrequencyIsThatOfItsIntegral) {
  // Greenwood 1977: f_G = (0.102 k^2 int Cn2 v^(5/3) dz)^(3/5), r0 = (0.423 k^2 int Cn2 dz)^(-3/5).
  EXPECT_NEAR(greenwood_frequency(10.0, 0.1), std::pow(0.102 / 0.423, 0.6) * 100.0, 0.3);
}

TEST(Seeing, ServoLagIsWhatAFrozenScreenChangesByAsItDrifts) {
  constexpr int samples = 64;
  const double diameter = 1.0;
  const Seeing seeing{.fried_parameter = 0.1};
  const std::vector<PhaseScreen> screens =
      generate_screens(TurbulenceScreenGenerator(seeing, samples, diameter, 5), 100);
  const double wind = 10.0;
  const double frequency = greenwood_frequency(wind, seeing.fried_parameter);
  for (const int drift : {1, 4, 16}) {
    const MeanAndError changed = structure_function(screens, {.rows = 0, .columns = drift});
    const double delay = drift * diameter / samples / wind;
    EXPECT_NEAR(servo_lag_variance(delay, frequency), changed.mean,
                4.0 * changed.standard_error + 1e-3 * changed.mean)
        << drift;
  }
}

TEST(VonKarman, AgreesWithSixtyDigitArithmeticFromTinyToLargeSeparations) {
  // r0 = 1, L0 = 2 pi; evaluated with the power series of K_(5/6) in 60-digit arithmetic.
  struct Reference {
    double separation;
    double value;
  };
  for (const auto& [separation, value] : {Reference{1e-6, 6.82463194552432736954e-10},
                                          {1e-3, 6.32632033409289275087e-05},
                                          {0.1, 9.29999207987793063968e-02},
                                          {1.0, 1.70717683657531127395e+00},
                                          {1.999, 2.83102590591588443303e+00},
                                          {2.001, 2.83252426744325713770e+00},
                                          {10.0, 3.69074402755733066428e+00},
                                          {30.0, 3.69120363177231203267e+00}}) {
    const double computed = von_karman_structure_function(
        separation, {.fried_parameter = 1.0, .outer_scale = 2.0 * std::numbers::pi});
    EXPECT_NEAR(computed / value, 1.0, 4e-15) << "separation " << separation;
  }
}

TEST(VonKarman, TendsToKolmogorovAsTheOuterScaleGrows) {
  double previous = 0.0;
  for (const double outer_scale : {1.0, 1e1, 1e3, 1e6, 1e9, 1e30}) {
    const double ratio = von_karman_structure_function(0.1, {0.1, outer_scale}) / 6.88;
    EXPECT_GT(ratio, previous);
    previous = ratio;
  }
  EXPECT_NEAR(previous, 1.0, 1e-9);
  EXPECT_EQ(von_karman_structure_function(0.1, {.fried_parameter = 0.1}), 6.88);
}

TEST(VonKarman, SaturatesAtTwiceThePhaseVariance) {
  // Variance of the spectrum 0.0229 r0^(-5/3) (f^2 + L0^-2)^(-11/6): 6/5 pi 0.0229 (L0/r0)^(5/3).
  const double variance = 1.2 * std::numbers::pi * 0.0229 * std::pow(10.0, 5.0 / 3.0);
  EXPECT_NEAR(von_karman_structure_function(100.0, {0.1, 1.0}) / (2.0 * variance), 1.0, 1e-3);
  EXPECT_DOUBLE_EQ(von_karman_structure_function(1e6, {0.1, 1.0}),
                   von_karman_structure_function(1e3, {0.1, 1.0}));
}

TEST(VonKarman, IsZeroAtZeroSeparation) {
  EXPECT_EQ(von_karman_structure_function(0.0, {0.1, 10.0}), 0.0);
}

TEST(Seeing, NamesTheKeyAndTheValueOfWhatIsNotPhysical) {
  const auto message_of = [](const Seeing& seeing) -> std::string {
    try {
      seeing.validate();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message_of({-0.1}), testing::StartsWith("seeing.fried_parameter = -0.1: "));
  EXPECT_THAT(message_of({0.0}), testing::StartsWith("seeing.fried_parameter = 0: "));
  EXPECT_THAT(message_of({nan}), testing::StartsWith("seeing.fried_parameter = nan: "));
  EXPECT_THAT(message_of({infinity}), testing::StartsWith("seeing.fried_parameter = inf: "));
  EXPECT_THAT(message_of({0.1, 0.0}), testing::StartsWith("seeing.outer_scale = 0: "));
  EXPECT_THAT(message_of({0.1, -25.0}), testing::StartsWith("seeing.outer_scale = -25: "));
  EXPECT_THAT(message_of({0.1, nan}), testing::StartsWith("seeing.outer_scale = nan: "));
  EXPECT_THAT(message_of({0.1, infinity}), testing::StartsWith("seeing.outer_scale = inf: "));
  EXPECT_EQ(message_of({0.1}), "");
  EXPECT_EQ(message_of({0.1, 25.0}), "");
}

}  // namespace
}  // namespace nlcwfs
