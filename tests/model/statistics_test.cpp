// Tests: Means, standard errors and quantiles of samples.
#include "model/statistics.hpp"

#include "model/random_stream.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(MeanAndStandardError, UsesTheSampleVariance) {
  const std::array values{1.0, 2.0, 3.0, 4.0};
  const MeanAndError result = mean_and_standard_error(values);
  EXPECT_DOUBLE_EQ(result.mean, 2.5);
  EXPECT_DOUBLE_EQ(result.standard_error, std::sqrt(5.0 / 3.0 / 4.0));
}

TEST(MeanAndStandardError, DoesNotLoseASmallSpreadAboutALargeMean) {
  const std::array values{1e9 - 1.0, 1e9, 1e9 + 1.0};
  EXPECT_DOUBLE_EQ(mean_and_standard_error(values).standard_error, std::sqrt(1.0 / 3.0));
}

TEST(MeanAndStandardError, OfOneValueHasNoError) {
  const std::array values{7.0};
  const MeanAndError result = mean_and_standard_error(values);
  EXPECT_EQ(result.mean, 7.0);
  EXPECT_EQ(result.standard_error, 0.0);
}

TEST(StandardDeviationAndError, IsOverOneLessThanTheirNumber) {
  const std::array values{1.0, 2.0, 3.0, 4.0};
  const MeanAndError result = standard_deviation_and_error(values);
  EXPECT_DOUBLE_EQ(result.mean, std::sqrt(5.0 / 3.0));
  EXPECT_DOUBLE_EQ(result.standard_error, std::sqrt(5.0 / 3.0 / 6.0));
}

TEST(StandardDeviationAndError, ItsErrorIsTheSpreadOfManyOfNormalValues) {
  boost::random::normal_distribution<double> normal(3.0, 0.7);
  RandomStream stream = random_stream({5});
  std::vector<double> deviations;
  double error = 0.0;
  const int repeats = 2000;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    std::array<double, 20> values{};
    for (double& value : values) value = normal(stream);
    const MeanAndError result = standard_deviation_and_error(values);
    deviations.push_back(result.mean);
    error += result.standard_error / repeats;
  }
  const MeanAndError spread = standard_deviation_and_error(deviations);
  // To second order in 1 / n its mean is low by 1 / (4 n), and so is the spread's.
  EXPECT_NEAR(error, spread.mean, 4.0 * spread.standard_error + 0.02 * spread.mean);
  EXPECT_NEAR(mean_and_standard_error(deviations).mean, 0.7, 0.02);
}

TEST(Statistics, QuantilesAreBetweenTheValues) {
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
  EXPECT_EQ(quantile({1.0, 2.0}, 0.0), 1.0);
  EXPECT_EQ(quantile({1.0, 2.0}, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(quantile({0.0, 10.0}, 0.3), 3.0);
  EXPECT_EQ(quantile({7.0}, 0.9), 7.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace
}  // namespace nlcwfs
