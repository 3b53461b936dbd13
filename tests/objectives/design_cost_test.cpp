#include "objectives/design_cost.hpp"

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

TEST(DesignCost, CountsTheChosenWavefrontErrorInUnitsOfItsScale) {
  DesignCost cost{.wfe_scale = 5e-9, .loop_weight = 0.0, .time_weight = 0.0};
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized), ElementsAre(DoubleEq(4), DoubleEq(8)));
  cost.wfe = WavefrontErrorKind::wrapped;
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized), ElementsAre(DoubleEq(3), DoubleEq(5)));
  cost.wfe = WavefrontErrorKind::total;
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized), ElementsAre(DoubleEq(6), DoubleEq(10)));
}

TEST(DesignCost, CountsFractionalLoops) {
  const DesignCost cost{.wfe_scale = 1.0, .loop_weight = 2.0};
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized),
              ElementsAre(testing::DoubleNear(11.0, 1e-7), testing::DoubleNear(16.5, 1e-7)));
}

TEST(DesignCost, PredictsTheTimeOfATransformFromItsOperations) {
  // 5 x 512^2 x log2(512^2) = 23,592,960 operations.
  EXPECT_DOUBLE_EQ(DesignCost{.fft_rate = 1e9}.transform_seconds(paper_sized), 0.02359296);
  EXPECT_DOUBLE_EQ(DesignCost{.fft_rate = 2e9}.transform_seconds(paper_sized), 0.01179648);
  SensorDesign oversampled = paper_sized;
  oversampled.reconstruction.oversampling = 2;
  // Four times the samples, 20 instead of 18 butterflies deep.
  EXPECT_DOUBLE_EQ(DesignCost{.fft_rate = 1e9}.transform_seconds(oversampled),
                   0.02359296 * 4.0 * 20.0 / 18.0);
}

TEST(DesignCost, CountsTheTimeOfAllTransforms) {
  const DesignCost cost{.wfe_scale = 1.0, .loop_weight = 0.0, .time_weight = 3.0};
  const double seconds = cost.transform_seconds(paper_sized);
  EXPECT_THAT(cost.per_screen(two_screens(), paper_sized),
              ElementsAre(testing::DoubleNear(180.0 * seconds, 1e-7),
                          testing::DoubleNear(270.0 * seconds, 1e-7)));
}

TEST(DesignCost, IsTheSumOfItsTermsSoThatMeansMayBeTakenFirst) {
  const DesignCost all{
      .wfe = WavefrontErrorKind::total, .wfe_scale = 7e-9, .loop_weight = 0.3, .time_weight = 11.0};
  const Performance performance = two_screens();
  const double expected = 40e-9 / 7e-9 + 0.3 * 6.875 + 11.0 * 75 * all.transform_seconds({});
  EXPECT_DOUBLE_EQ(mean_and_standard_error(all.per_screen(performance, {})).mean, expected);
}

}  // namespace
}  // namespace nlcwfs
