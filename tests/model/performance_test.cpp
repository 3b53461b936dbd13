// Tests: How a design did on its wavefronts, and which figures of that are reported.
#include "model/performance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

/// Screens that took so many loops, and converged in fewer than 7.
Performance with_loops(const std::vector<int>& loops) {
  Performance performance;
  for (const int count : loops) {
    ScreenPerformance screen;
    screen.loops = count;
    screen.converged = count < 7;
    screen.captured_energy = {0.1 * count, 1.0};
    performance.screens.push_back(screen);
  }
  return performance;
}

TEST(Performance, OfOneConditionHasTheScreensValuesBitForBit) {
  const auto third = [](const ScreenPerformance& screen) { return screen.loops / 3.0; };
  EXPECT_THAT(with_loops({1, 5, 7}).samples_of(third), ElementsAre(1 / 3.0, 5 / 3.0, 7 / 3.0));
}

TEST(Performance, PooledOverConditionsHasItsErrorsOverTheScreens) {
  const std::vector<Performance> conditions{with_loops({4, 6, 11}), with_loops({6, 8, 13})};
  const Performance both = pooled(conditions);
  const PerformanceMetric loops = performance_metric("loops");
  EXPECT_THAT(both.samples_of(loops), ElementsAre(DoubleEq(5), DoubleEq(7), DoubleEq(12)));
  EXPECT_DOUBLE_EQ(both.mean_of(loops).mean, 8.0);
  // The conditions differ by 2 on every screen, so the second says nothing new about the errors.
  EXPECT_DOUBLE_EQ(both.mean_of(loops).standard_error, conditions[0].mean_of(loops).standard_error);
  EXPECT_DOUBLE_EQ(both.converged_fraction(), 0.5);
  EXPECT_THAT(both.captured_energy(), ElementsAre(DoubleEq(0.8), DoubleEq(1.0)));
  EXPECT_EQ(both.screens.size(), 6u);
}

TEST(Performance, PooledFromOneIsThatOne) {
  const Performance one = with_loops({3, 9});
  const Performance same = pooled(std::span(&one, 1));
  EXPECT_EQ(same.conditions, 1u);
  EXPECT_EQ(same.mean_of(performance_metric("loops")).mean,
            one.mean_of(performance_metric("loops")).mean);
}

}  // namespace
}  // namespace nlcwfs
