// Tests: Variances and structure functions of phase screens.
#include "model/screen_statistics.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

PhaseScreen plane(int samples, double per_row, double per_column, double piston) {
  return PhaseScreen::NullaryExpr(samples, samples, [=](Eigen::Index row, Eigen::Index column) {
    return piston + per_row * static_cast<double>(row) + per_column * static_cast<double>(column);
  });
}

TEST(ScreenStatistics, APlaneHasTheVarianceOfItsSlopeAndNoneOnceTiltIsRemoved) {
  const std::vector screens{plane(20, 0.3, -0.1, 50.0)};
  const PupilMask pupil = pupil_mask(20, 0.2);
  double mean_square = 0.0;
  for (int row = 0; row < 20; ++row) {
    mean_square += static_cast<double>(pupil.row(row).count()) * (row - 9.5) * (row - 9.5);
  }
  mean_square /= static_cast<double>(pupil.count());
  EXPECT_NEAR(piston_removed_variance(screens, pupil).mean, (0.09 + 0.01) * mean_square, 1e-11);
  EXPECT_NEAR(tilt_removed_variance(screens, pupil).mean, 0.0, 1e-20);
}

TEST(ScreenStatistics, DefocusOverAFinelySampledPupilHasItsAnalyticVariance) {
  // a (2 rho^2 - 1) has the variance a^2 / 3 over the unit disc, and no tilt.
  const int samples = 200;
  const double a = 0.7;
  const auto defocus = [&](Eigen::Index row, Eigen::Index column) {
    const double y = (2.0 * static_cast<double>(row) + 1.0) / samples - 1.0;
    const double x = (2.0 * static_cast<double>(column) + 1.0) / samples - 1.0;
    return a * (2.0 * (x * x + y * y) - 1.0);
  };
  const std::vector<PhaseScreen> screens{PhaseScreen::NullaryExpr(samples, samples, defocus)};
  const PupilMask pupil = pupil_mask(samples, 0.0);
  EXPECT_NEAR(piston_removed_variance(screens, pupil).mean, a * a / 3.0, 1e-3);
  EXPECT_NEAR(tilt_removed_variance(screens, pupil).mean,
              piston_removed_variance(screens, pupil).mean, 1e-12);
}

TEST(ScreenStatistics, OnlyTheSamplesOfThePupilCount) {
  const PupilMask pupil = pupil_mask(16, 0.4);
  const PhaseScreen inside = plane(16, 0.1, 0.2, 0.0);
  const std::vector clean{inside};
  const std::vector dirty{pupil.select(inside, 1e6).eval()};
  EXPECT_EQ(piston_removed_variance(clean, pupil).mean, piston_removed_variance(dirty, pupil).mean);
  EXPECT_EQ(tilt_removed_variance(clean, pupil).mean, tilt_removed_variance(dirty, pupil).mean);
}

TEST(ScreenStatistics, StructureFunctionOfAPlaneTellsTheDirectionsApart) {
  const std::vector screens{plane(12, 0.3, -0.1, 5.0)};
  const auto value = [&](int rows, int columns) {
    return structure_function(screens, {.rows = rows, .columns = columns}).mean;
  };
  for (const int k : {1, 5, 11}) {
    EXPECT_NEAR(value(k, 0), 0.09 * k * k, 1e-12);
    EXPECT_NEAR(value(0, k), 0.01 * k * k, 1e-12);
    EXPECT_NEAR(value(0, -k), 0.01 * k * k, 1e-12);
    EXPECT_NEAR(value(k, k), 0.04 * k * k, 1e-12);
    EXPECT_NEAR(value(k, -k), 0.16 * k * k, 1e-12);
  }
}

TEST(ScreenStatistics, StructureFunctionAveragesAllPairsOfTheSquare) {
  PhaseScreen screen(2, 3);
  screen << 0.0, 1.0, 3.0,  //
      10.0, 14.0, 20.0;
  const std::vector screens{screen};
  EXPECT_DOUBLE_EQ(structure_function(screens, {0, 1}).mean, (1.0 + 4.0 + 16.0 + 36.0) / 4.0);
  EXPECT_DOUBLE_EQ(structure_function(screens, {1, 0}).mean, (100.0 + 169.0 + 289.0) / 3.0);
  EXPECT_DOUBLE_EQ(structure_function(screens, {1, 1}).mean, (196.0 + 361.0) / 2.0);
  EXPECT_DOUBLE_EQ(structure_function(screens, {1, -1}).mean, (81.0 + 121.0) / 2.0);
}

TEST(ScreenStatistics, ErrorsAreThoseOfTheMeanOverScreens) {
  const std::vector screens{plane(8, 1.0, 0.0, 0.0), plane(8, std::sqrt(3.0), 0.0, 0.0)};
  const MeanAndError result = structure_function(screens, {1, 0});
  EXPECT_NEAR(result.mean, 2.0, 1e-12);
  EXPECT_NEAR(result.standard_error, 1.0, 1e-12);
}

}  // namespace
}  // namespace nlcwfs
