// Tests: Costs under several conditions become one.
#include "objectives/cost_aggregate.hpp"

#include "model/random_stream.hpp"
#include "model/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <boost/random/exponential_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using Costs = std::vector<std::vector<double>>;

MeanAndError aggregated(AggregateKind kind, double level, const Costs& costs) {
  return mean_and_standard_error(CostAggregate{kind, level}.per_screen(costs));
}

std::vector<double> one_to(int last) {
  std::vector<double> values(static_cast<std::size_t>(last));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

/// Costs of two conditions that share a part, so that they are correlated: 1 + shared + own and
/// 1.2 + shared + 2 own', all exponential.
Costs correlated_costs(std::uint64_t seed, std::size_t screens) {
  RandomStream stream = random_stream({seed});
  boost::random::exponential_distribution<double> exponential;
  Costs costs(2);
  for (std::size_t i = 0; i < screens; ++i) {
    const double shared = exponential(stream);
    costs[0].push_back(1.0 + shared + exponential(stream));
    costs[1].push_back(1.2 + shared + 2.0 * exponential(stream));
  }
  return costs;
}

std::vector<double> worst_of(const Costs& costs) {
  return CostAggregate{.kind = AggregateKind::worst}.per_screen(costs);
}

TEST(CostAggregate, OfOneConditionTheMeanAndTheWorstAreItsCosts) {
  const Costs costs{{0.1, 0.7, 1.3}};
  EXPECT_EQ(CostAggregate().per_screen(costs), costs.front());
  EXPECT_EQ(worst_of(costs), costs.front());
}

TEST(CostAggregate, MeanIsThatOfTheConditionsScreenByScreen) {
  EXPECT_THAT(CostAggregate().per_screen({{1.0, 2.0}, {3.0, 8.0}}),
              ElementsAre(DoubleEq(2.0), DoubleEq(5.0)));
}

TEST(CostAggregate, WorstIsTheConditionOfTheHighestMean) {
  EXPECT_THAT(worst_of({{9.0, 1.0, 1.0}, {4.0, 4.0, 4.0}, {3, 3, 3}}), ElementsAre(4.0, 4.0, 4.0));
}

TEST(CostAggregate, QuantileIsTheLeastCostThatAsManyAreWithinAsTheLevelSays) {
  for (const auto& [level, expected] :
       {std::pair{0.5, 5.0}, {0.51, 6.0}, {0.7, 7.0}, {0.9, 9.0}, {0.91, 10.0}, {0.05, 1.0}}) {
    EXPECT_NEAR(aggregated(AggregateKind::quantile, level, {one_to(10)}).mean, expected, 1e-12)
        << level;
  }
  // 0.07 x 100 is above 7 in floating point.
  EXPECT_NEAR(aggregated(AggregateKind::quantile, 0.07, {one_to(100)}).mean, 7.0, 1e-12);
}

TEST(CostAggregate, CvarIsTheMeanBeyondTheQuantile) {
  EXPECT_NEAR(aggregated(AggregateKind::cvar, 0.8, {one_to(10)}).mean, 9.5, 1e-12);
  EXPECT_NEAR(aggregated(AggregateKind::cvar, 0.9, {one_to(10)}).mean, 10.0, 1e-12);
  // Half of the second highest cost belongs to the worst 15 %.
  EXPECT_NEAR(aggregated(AggregateKind::cvar, 0.85, {one_to(10)}).mean, (10.0 + 0.5 * 9.0) / 1.5,
              1e-12);
  EXPECT_NEAR(aggregated(AggregateKind::cvar, 1e-9, {one_to(10)}).mean, 5.5, 1e-6);
}

TEST(CostAggregate, CvarIsTheMinimumOfRockafellarAndUryasev) {
  const Costs costs = correlated_costs(3, 15);
  const double level = 0.8;
  const double found = aggregated(AggregateKind::cvar, level, costs).mean;
  double least = HUGE_VAL;
  for (const std::vector<double>& candidates : costs) {
    for (const double q : candidates) {
      double sum = 0.0;
      for (const auto& row : costs) {
        for (const double cost : row) sum += std::max(0.0, cost - q);
      }
      least = std::min(least, q + sum / 30.0 / (1.0 - level));
    }
  }
  EXPECT_NEAR(found, least, 1e-12);
}

TEST(CostAggregate, PoolsAllScreensOfAllConditions) {
  const std::vector<double> all = one_to(10);
  const Costs split{{all.begin(), all.begin() + 5}, {all.begin() + 5, all.end()}};
  for (const AggregateKind kind : {AggregateKind::quantile, AggregateKind::cvar}) {
    EXPECT_NEAR(aggregated(kind, 0.8, split).mean, aggregated(kind, 0.8, {all}).mean, 1e-12);
  }
}

TEST(CostAggregate, GrowsWithItsLevelAndLiesBeyondTheQuantile) {
  const Costs costs = correlated_costs(4, 50);
  double quantile_before = 0.0;
  double cvar_before = 0.0;
  for (const double level : {0.1, 0.5, 0.75, 0.9, 0.99}) {
    const double quantile = aggregated(AggregateKind::quantile, level, costs).mean;
    const double cvar = aggregated(AggregateKind::cvar, level, costs).mean;
    EXPECT_GT(cvar, quantile);
    EXPECT_GT(quantile, quantile_before);
    EXPECT_GT(cvar, cvar_before);
    quantile_before = quantile;
    cvar_before = cvar;
  }
}

TEST(CostAggregate, FollowsAChangeOfScaleAndOrigin) {
  const Costs costs = correlated_costs(5, 40);
  Costs changed = costs;
  for (auto& row : changed) {
    for (double& cost : row) cost = 3.0 * cost - 7.0;
  }
  for (const AggregateKind kind :
       {AggregateKind::mean, AggregateKind::worst, AggregateKind::quantile, AggregateKind::cvar}) {
    const MeanAndError before = aggregated(kind, 0.9, costs);
    const MeanAndError after = aggregated(kind, 0.9, changed);
    EXPECT_NEAR(after.mean, 3.0 * before.mean - 7.0, 1e-9);
    EXPECT_NEAR(after.standard_error, 3.0 * before.standard_error, 1e-9);
    EXPECT_GT(before.standard_error, 0.0);
  }
}

TEST(CostAggregate, OfEqualCostsHasNoError) {
  for (const AggregateKind kind :
       {AggregateKind::mean, AggregateKind::worst, AggregateKind::quantile, AggregateKind::cvar}) {
    for (const std::size_t screens : {1, 2, 7}) {
      const Costs costs(2, std::vector<double>(screens, 2.5));
      const MeanAndError found = aggregated(kind, 0.9, costs);
      EXPECT_DOUBLE_EQ(found.mean, 2.5);
      EXPECT_EQ(found.standard_error, 0.0);
    }
  }
}

TEST(CostAggregate, TakesOneScreenOfOneCondition) {
  for (const AggregateKind kind :
       {AggregateKind::mean, AggregateKind::worst, AggregateKind::quantile, AggregateKind::cvar}) {
    EXPECT_THAT((CostAggregate{kind, 0.9}.per_screen({{4.0}})), ElementsAre(4.0));
  }
}

/// How much an estimate scatters, and how much it says that it does.
struct Scatter {
  double actual;
  double stated;
};

constexpr int repetitions = 400;

/// Over samples of their own.
Scatter scatter_of(AggregateKind kind, double level, std::size_t screens) {
  std::vector<double> means;
  std::vector<double> variances;
  for (std::uint64_t repetition = 0; repetition < repetitions; ++repetition) {
    const MeanAndError found = aggregated(kind, level, correlated_costs(100 + repetition, screens));
    means.push_back(found.mean);
    variances.push_back(found.standard_error * found.standard_error);
  }
  return {mean_and_standard_error(means).standard_error * std::sqrt(repetitions),
          std::sqrt(mean_and_standard_error(variances).mean)};
}

TEST(CostAggregate, StatesTheScatterOfItsEstimate) {
  // The standard deviation of n values is known to 1 / sqrt(2 n). On top, influence is a first
  // order, and a density from few order statistics is coarse.
  const double statistical = 4.0 / std::sqrt(2.0 * repetitions);
  for (const auto& [kind, level, first_order] : {std::tuple{AggregateKind::mean, 0.9, 0.0},
                                                 {AggregateKind::worst, 0.9, 0.0},
                                                 {AggregateKind::cvar, 0.9, 0.05},
                                                 {AggregateKind::cvar, 0.6, 0.05},
                                                 {AggregateKind::quantile, 0.5, 0.1},
                                                 {AggregateKind::quantile, 0.9, 0.1}}) {
    const Scatter scatter = scatter_of(kind, level, 200);
    EXPECT_NEAR(scatter.stated / scatter.actual, 1.0, statistical + first_order)
        << static_cast<int>(kind) << ' ' << level;
  }
}

TEST(CostAggregate, StatesTheErrorThatABootstrapFinds) {
  constexpr std::size_t screens = 300;
  constexpr int resamples = 500;
  const Costs costs = correlated_costs(9, screens);
  for (const auto& [kind, level, tolerance] : {std::tuple{AggregateKind::mean, 0.9, 0.13},
                                               {AggregateKind::worst, 0.9, 0.13},
                                               {AggregateKind::cvar, 0.9, 0.16},
                                               {AggregateKind::quantile, 0.9, 0.3}}) {
    RandomStream stream = random_stream({10});
    boost::random::uniform_int_distribution<std::size_t> any(0, screens - 1);
    std::vector<double> means;
    for (int resample = 0; resample < resamples; ++resample) {
      // Screens are drawn, each with all of its conditions.
      Costs drawn(costs.size());
      for (std::size_t i = 0; i < screens; ++i) {
        const std::size_t screen = any(stream);
        for (std::size_t k = 0; k < costs.size(); ++k) drawn[k].push_back(costs[k][screen]);
      }
      means.push_back(aggregated(kind, level, drawn).mean);
    }
    const double bootstrap = mean_and_standard_error(means).standard_error * std::sqrt(resamples);
    EXPECT_NEAR(aggregated(kind, level, costs).standard_error / bootstrap, 1.0, tolerance)
        << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace nlcwfs
