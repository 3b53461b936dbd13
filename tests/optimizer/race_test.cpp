// Tests: Designs that are clearly worse are given up after their first samples.
#include "optimizer/race.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr std::size_t samples = 16;

/// Costs of a rival and of a design that is dearer by `excess` on average. Half of their variance
/// is the screens' own, which is common to both.
struct Pair {
  Pair(boost::random::mt19937_64& generator, double excess) {
    boost::random::normal_distribution<double> normal;
    for (std::size_t i = 0; i < samples; ++i) {
      const double screen = normal(generator);
      rival.push_back(5.0 + screen + normal(generator));
      design.push_back(5.0 + excess + screen + normal(generator));
    }
  }

  /// The samples after which a race gives the design up, with looks at 4 and 8; 0 = never.
  std::size_t given_up_after(double significance) const {
    const Race race(rival, significance);
    for (std::size_t count = 4; count < samples; count *= 2) {
      if (!race.goes_on(std::span(design).first(count))) return count;
    }
    return 0;
  }

  std::vector<double> rival;
  std::vector<double> design;
};

TEST(Race, GivesUpAnEquallyGoodDesignNoMoreOftenThanItsSignificance) {
  constexpr int trials = 4000;
  for (const double significance : {0.05, 0.2}) {
    boost::random::mt19937_64 generator(1);
    int given_up = 0;
    for (int i = 0; i < trials; ++i) {
      if (Pair(generator, 0.0).given_up_after(significance) > 0) ++given_up;
    }
    const double standard_error = std::sqrt(significance * (1.0 - significance) / trials);
    EXPECT_LT(given_up, trials * (significance + 3.0 * standard_error));
    EXPECT_GT(given_up, 0);
  }
}

TEST(Race, GivesUpAClearlyWorseDesignEarly) {
  constexpr int trials = 500;
  boost::random::mt19937_64 generator(2);
  int given_up = 0;
  std::size_t samples_spent = 0;
  for (int i = 0; i < trials; ++i) {
    const std::size_t after = Pair(generator, 5.0).given_up_after(0.05);
    if (after > 0) ++given_up;
    samples_spent += after > 0 ? after : samples;
  }
  EXPECT_EQ(given_up, trials);
  EXPECT_LT(samples_spent, trials * samples / 2);
}

TEST(Race, KeepsABetterDesign) {
  boost::random::mt19937_64 generator(3);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(Pair(generator, -5.0).given_up_after(0.05), 0u);
}

TEST(Race, EstimatesTheCostFromTheSamplesSeen) {
  boost::random::mt19937_64 generator(4);
  const Pair pair(generator, 1.0);
  const Race race(pair.rival, 0.05);
  const double cost = std::accumulate(pair.design.begin(), pair.design.end(), 0.0) / samples;
  EXPECT_NEAR(race.estimated_cost(pair.design), cost, 1e-12);
  // A constant difference to the rival is known after one sample.
  std::vector<double> shifted = pair.rival;
  for (double& value : shifted) value += 0.25;
  const double rival_cost = std::accumulate(pair.rival.begin(), pair.rival.end(), 0.0) / samples;
  EXPECT_NEAR(race.estimated_cost(std::span(shifted).first(1)), rival_cost + 0.25, 1e-12);
}

TEST(Race, DecidesWithoutScatterAndNeverOnOneSample) {
  const std::vector<double> rival(samples, 2.0);
  const Race race(rival, 0.05);
  const std::vector<double> worse(samples, 2.5);
  EXPECT_TRUE(race.goes_on(std::span(worse).first(1)));
  EXPECT_FALSE(race.goes_on(std::span(worse).first(2)));
  EXPECT_TRUE(race.goes_on(rival));
}

}  // namespace
}  // namespace nlcwfs
