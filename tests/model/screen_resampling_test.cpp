// Tests: A phase is brought to another number of samples.
#include "model/screen_resampling.hpp"

#include "model/pupil.hpp"
#include "model/random_stream.hpp"

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

PhaseScreen random_screen(int samples) {
  RandomStream stream = random_stream({11});
  boost::random::normal_distribution<double> normal;
  return PhaseScreen::NullaryExpr(samples, samples, [&] { return normal(stream); });
}

/// A plane over a square of width 1 around the axis.
PhaseScreen plane(int samples, double slope_x, double slope_y, double piston) {
  return PhaseScreen::NullaryExpr(samples, samples, [=](Eigen::Index row, Eigen::Index column) {
    const double y = (double(row) + 0.5) / samples - 0.5;
    const double x = (double(column) + 0.5) / samples - 0.5;
    return piston + slope_x * x + slope_y * y;
  });
}

TEST(ScreenResampling, OfTheSameSizeIsTheIdentity) {
  for (const int samples : {2, 5, 64}) {
    const PhaseScreen screen = random_screen(samples);
    EXPECT_LT((resampled_screen(screen, samples) - screen).abs().maxCoeff(), 1e-14);
  }
}

TEST(ScreenResampling, ToADivisorIsTheMeanOfBlocks) {
  const PhaseScreen screen = random_screen(24);
  for (const int factor : {2, 3, 4, 24}) {
    EXPECT_LT(
        (resampled_screen(screen, 24 / factor) - block_average(screen, factor)).abs().maxCoeff(),
        1e-14);
  }
}

TEST(ScreenResampling, ToFewerSamplesKeepsTheMeanWhereBlocksAreNotWhole) {
  const PhaseScreen screen = random_screen(24);
  for (const int samples : {1, 5, 7, 17, 23}) {
    EXPECT_NEAR(resampled_screen(screen, samples).mean(), screen.mean(), 1e-14) << samples;
  }
}

TEST(ScreenResampling, AveragesOverTheAreaOfTheNewSample) {
  // Three samples onto two: each new one holds a whole old one and half of the middle one.
  PhaseScreen screen(3, 3);
  screen << 1.0, 2.0, 3.0,  //
      10.0, 20.0, 30.0,     //
      100.0, 200.0, 300.0;
  const PhaseScreen resampled = resampled_screen(screen, 2);
  const auto mean = [&](int row, int column) {
    double sum = 0.0;
    for (const int i : {row, 1}) {
      for (const int j : {column, 1}) {
        sum += screen(i, j) * (i == 1 ? 1.0 : 2.0) * (j == 1 ? 1.0 : 2.0) / 9.0;
      }
    }
    return sum;
  };
  EXPECT_NEAR(resampled(0, 0), mean(0, 0), 1e-13);
  EXPECT_NEAR(resampled(0, 1), mean(0, 2), 1e-13);
  EXPECT_NEAR(resampled(1, 0), mean(2, 0), 1e-13);
  EXPECT_NEAR(resampled(1, 1), mean(2, 2), 1e-13);
}

TEST(ScreenResampling, KeepsAPlaneExactlyUpAndDown) {
  for (const int from : {2, 3, 16, 21}) {
    for (const int to : {1, 2, 5, 16, 20, 21, 64}) {
      // A mean over whole samples is that of their centres; over parts of them it is not.
      if (to < from && from % to != 0) continue;
      EXPECT_LT((resampled_screen(plane(from, 0.7, -1.9, 5.0), to) - plane(to, 0.7, -1.9, 5.0))
                    .abs()
                    .maxCoeff(),
                1e-13)
          << from << " to " << to;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
