// Tests: What a design costs: wavefront error, loops, time, penalties and limits.
#include "objectives/design_cost.hpp"

#include "tests/message_of.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

Performance two_screens() {
  ScreenPerformance first;
  first.wavefront = {.residual_wfe = 20e-9, .wrapped_wfe = 15e-9, .total_wfe = 30e-9};
  first.loops = 6;
  first.fractional_loops = 5.5;
  first.fft_count = 60;
  ScreenPerformance second;
  second.wavefront = {.residual_wfe = 40e-9, .wrapped_wfe = 25e-9, .total_wfe = 50e-9};
  second.loops = 9;
  second.fractional_loops = 8.25;
  second.fft_count = 90;
  return {{first, second}};
}

/// 64 pixels and 8 pupil diameters: transforms of 512 x 512.
const SensorDesign paper_sized;

constexpr double r0 = 0.125;  // m

CostTerm term(std::string_view name, double weight) { return {*find_design_metric(name), weight}; }

MetricBound bound(std::string_view name, Side side, double value) {
  return {*find_design_metric(name), side, value};
}

TEST(DesignCost, CountsTheChosenWavefrontErrorInUnitsOfItsScale) {
  DesignCost cost{.wfe_scale = 5e-9, .loop_weight = 0.0, .time_weight = 0.0};
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(DoubleEq(4), DoubleEq(8)));
  cost.wfe = WavefrontErrorKind::wrapped;
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(DoubleEq(3), DoubleEq(5)));
  cost.wfe = WavefrontErrorKind::total;
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(DoubleEq(6), DoubleEq(10)));
}

TEST(DesignCost, CountsFractionalLoops) {
  const DesignCost cost{.wfe_scale = 1.0, .loop_weight = 2.0};
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(testing::DoubleNear(11.0, 1e-7), testing::DoubleNear(16.5, 1e-7)));
}

TEST(DesignCost, CountsTheTimeOfAllTransforms) {
  const DesignCost cost{.wfe_scale = 1.0, .loop_weight = 0.0, .time_weight = 3.0};
  const double seconds = cost.operation.transform_seconds(paper_sized);
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(testing::DoubleNear(180.0 * seconds, 1e-7),
                          testing::DoubleNear(270.0 * seconds, 1e-7)));
}

TEST(DesignCost, IsTheSumOfItsTermsSoThatMeansMayBeTakenFirst) {
  const DesignCost all{
      .wfe = WavefrontErrorKind::total, .wfe_scale = 7e-9, .loop_weight = 0.3, .time_weight = 11.0};
  const Performance performance = two_screens();
  const double expected =
      40e-9 / 7e-9 + 0.3 * 6.875 + 11.0 * 75 * all.operation.transform_seconds({});
  EXPECT_DOUBLE_EQ(mean_and_standard_error(all.per_screen(performance, {}, r0)).mean, expected);
}

TEST(DesignCost, AddsTermsOfAnyMetric) {
  const DesignCost plain{.wfe_scale = 5e-9};
  DesignCost cost = plain;
  cost.terms = {term("plane_count", 0.5), term("fft_count", -0.25)};
  const std::vector<double> before = plain.per_screen(two_screens(), paper_sized, r0);
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(DoubleEq(before[0] + 2.0 - 15.0), DoubleEq(before[1] + 2.0 - 22.5)));
}

TEST(DesignCost, PenalisesOnlyWhatLiesBeyondABound) {
  DesignCost cost{.wfe_scale = 1.0, .loop_weight = 0.0};
  cost.penalties = {{bound("total_wfe_nm", Side::above, 40.0), 0.1},
                    {bound("loops", Side::below, 7.0), 3.0}};
  // 30 nm in 6 loops, 50 nm in 9.
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized, r0),
              ElementsAre(testing::DoubleNear(3.0, 1e-7), testing::DoubleNear(1.0, 1e-7)));
}

TEST(DesignCost, CanBeTheErrorBudget) {
  DesignCost cost{.kind = CostKind::error_budget, .wfe_scale = 1e-12, .loop_weight = 1e3};
  cost.operation.time_per_loop = 1e-4;
  cost.operation.wind_speed = 10.0;
  const Performance performance = two_screens();
  const std::vector<double> costs = cost.per_screen(performance, paper_sized, r0);
  for (const std::size_t i : {0, 1}) {
    const double delay = 1e-4 * performance.screens[i].fractional_loops;
    const double servo = std::sqrt(28.4 * std::pow(delay * 0.427 * 10.0 / r0, 5.0 / 3.0));
    EXPECT_NEAR(
        costs[i],
        std::hypot(performance.screens[i].wavefront.total_wfe * 1e9, servo * 532.0 / 6.2831853072),
        1e-6);
  }
}

TEST(DesignCost, LimitsCostNothingAndAreHeldAgainstTheMean) {
  const DesignCost free;
  DesignCost cost;
  const auto violation = [&] { return cost.violation(two_screens(), paper_sized, r0); };
  EXPECT_EQ(violation(), 0.0);
  // The mean of 30 and 50 nm, although one screen breaks it.
  cost.limits = {bound("total_wfe_nm", Side::above, 40.0 + 1e-9)};
  EXPECT_EQ(violation(), 0.0);
  cost.limits = {bound("total_wfe_nm", Side::above, 32.0)};
  EXPECT_NEAR(violation(), 0.25, 1e-12);
  cost.limits.push_back(bound("loops", Side::below, 10.0));
  EXPECT_NEAR(violation(), 0.25 + 0.25, 1e-12);
  cost.limits.push_back(bound("fft_count", Side::above, 1e9));
  EXPECT_NEAR(violation(), 0.25 + 0.25, 1e-12);
  EXPECT_EQ(cost.per_screen(two_screens(), paper_sized, r0),
            free.per_screen(two_screens(), paper_sized, r0));
}

TEST(DesignCost, ALimitOfZeroCanBeBrokenAndKept) {
  DesignCost cost;
  cost.limits = {bound("field_strehl", Side::above, 0.0)};
  EXPECT_EQ(cost.violation(two_screens(), paper_sized, r0), 0.0);
  cost.limits = {bound("loops", Side::above, 0.0)};
  const double violation = cost.violation(two_screens(), paper_sized, r0);
  EXPECT_GT(violation, 1e6);
  EXPECT_TRUE(std::isfinite(violation));
}

TEST(DesignCost, IsRefusedWithoutWhatItsMetricsNeed) {
  const auto message = [](const DesignCost& cost) { return message_of([&] { cost.validate(); }); };
  const std::string expected =
      "objective.greenwood_frequency = (not set): servo_wfe_nm and error_budget_nm need it or "
      "objective.wind_speed, such as 30";
  DesignCost budget{.kind = CostKind::error_budget};
  EXPECT_EQ(message(budget), expected);
  DesignCost limited;
  limited.limits = {bound("servo_wfe_nm", Side::above, 10.0)};
  EXPECT_EQ(message(limited), expected);
  budget.operation.greenwood_frequency = 30.0;
  EXPECT_NO_THROW(budget.validate());
  EXPECT_NO_THROW(DesignCost().validate());
}

}  // namespace
}  // namespace nlcwfs
