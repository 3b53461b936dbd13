// Tests: Figures of a design that costs, limits and fronts may use.
#include "objectives/design_metric.hpp"

#include "model/input_error.hpp"
#include "model/seeing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

class DesignMetricTest : public testing::Test {
 protected:
  DesignMetricTest() {
    screen_.wavefront = {
        .residual_wfe = 20e-9, .wrapped_wfe = 15e-9, .total_wfe = 30e-9, .field_strehl = 0.9};
    screen_.loops = 6;
    screen_.fractional_loops = 5.5;
    screen_.fft_count = 60;
    screen_.seconds = 0.25;
    screen_.captured_energy = {0.97, 0.88, 0.99, 0.9};
  }

  double value(std::string_view name) const {
    return find_design_metric(name)->value(screen_, {design_, operation_, fried_parameter_});
  }

  ScreenPerformance screen_;
  SensorDesign design_;  ///< four planes of 256 x 256 pixels, transforms of 512 x 512
  Operation operation_;
  double fried_parameter_ = 0.125;
};

TEST_F(DesignMetricTest, HasEveryMetricOfAPerformanceAsItIs) {
  for (const PerformanceMetric& metric : performance_metrics()) {
    EXPECT_EQ(value(metric.name), metric(screen_)) << metric.name;
  }
}

TEST_F(DesignMetricTest, AreFoundByNamesThatDifferAndEndWithTheirUnit) {
  std::set<std::string_view> names;
  for (const DesignMetric& metric : design_metrics()) {
    names.insert(metric.name);
    EXPECT_EQ(find_design_metric(metric.name), &metric);
    const std::string unit(metric.unit == "s" ? "seconds" : metric.unit);
    EXPECT_TRUE(metric.name.ends_with(unit)) << metric.name;
    for (const char* ending : {"_nm", "seconds"}) {
      EXPECT_EQ(metric.name.ends_with(ending), !unit.empty() && std::string(ending).ends_with(unit))
          << metric.name;
    }
  }
  EXPECT_EQ(names.size(), design_metrics().size());
  EXPECT_EQ(find_design_metric("residual_wfe"), nullptr);
}

TEST_F(DesignMetricTest, PredictsTheTimeOfATransformFromItsOperations) {
  // 5 x 512^2 x log2(512^2) = 23,592,960 operations.
  operation_.fft_rate = 1e9;
  EXPECT_DOUBLE_EQ(operation_.transform_seconds(design_), 0.02359296);
  EXPECT_DOUBLE_EQ(value("model_seconds"), 60 * 0.02359296);
  operation_.fft_rate = 2e9;
  EXPECT_DOUBLE_EQ(operation_.transform_seconds(design_), 0.01179648);
  operation_.fft_rate = 1e9;
  design_.reconstruction.oversampling = 2;
  // Four times the samples, 20 instead of 18 butterflies deep.
  EXPECT_DOUBLE_EQ(operation_.transform_seconds(design_), 0.02359296 * 4.0 * 20.0 / 18.0);
}

TEST_F(DesignMetricTest, CountsPixelsPlanesAndTheLeastLight) {
  EXPECT_EQ(value("detector_pixels"), 4 * 256 * 256);
  EXPECT_EQ(value("plane_count"), 4);
  EXPECT_EQ(value("captured_energy"), 0.88);
  design_.planes = {-47e3, 47e3};
  design_.detector.window = 2.0;
  EXPECT_EQ(value("detector_pixels"), 2 * 128 * 128);
}

TEST_F(DesignMetricTest, LatencyIsExposureReadOutAndLoops) {
  operation_.fft_rate = 1e9;
  const double modelled = 5.5 * 10 * 0.02359296;  // ten transforms a loop
  EXPECT_DOUBLE_EQ(value("latency_seconds"), modelled);
  operation_.time_per_loop = 1e-4;
  EXPECT_DOUBLE_EQ(value("latency_seconds"), 5.5e-4);
  operation_.readout_time_per_pixel = 1e-9;
  EXPECT_DOUBLE_EQ(value("latency_seconds"), 5.5e-4 + 4 * 256 * 256 * 1e-9);
  design_.detector.exposure = 2e-3;
  EXPECT_DOUBLE_EQ(value("latency_seconds"), 2e-3 + 5.5e-4 + 4 * 256 * 256 * 1e-9);
}

TEST_F(DesignMetricTest, ServoLagIsTheTurbulencesChangeInTheLatency) {
  operation_.time_per_loop = 1e-3;
  operation_.wind_speed = 8.0;
  // One frozen layer has moved by v tau: 6.88 (v tau / r0)^(5/3) rad^2.
  const double variance = kolmogorov_structure_function(8.0 * 5.5e-3, fried_parameter_);
  const double expected = std::sqrt(variance) * 532.0 / (2.0 * std::numbers::pi);
  // The constants 28.4 and 0.427 have three digits.
  EXPECT_NEAR(value("servo_wfe_nm") / expected, 1.0, 1e-3);
  EXPECT_DOUBLE_EQ(value("error_budget_nm"), std::hypot(30.0, value("servo_wfe_nm")));
  const double from_wind = value("servo_wfe_nm");
  operation_.greenwood_frequency = 0.427 * 8.0 / 0.125;
  operation_.wind_speed.reset();
  EXPECT_DOUBLE_EQ(value("servo_wfe_nm"), from_wind);
  operation_.wavelength *= 2.0;
  EXPECT_DOUBLE_EQ(value("servo_wfe_nm"), 2.0 * from_wind);
}

TEST_F(DesignMetricTest, WithoutALatencyTheErrorBudgetIsTheTotalError) {
  operation_.time_per_loop = 0.0;
  operation_.greenwood_frequency = 1e3;
  EXPECT_EQ(value("servo_wfe_nm"), 0.0);
  EXPECT_DOUBLE_EQ(value("error_budget_nm"), 30.0);
}

TEST_F(DesignMetricTest, ServoLagNeedsToKnowTheTurbulencesSpeed) {
  EXPECT_THROW(value("servo_wfe_nm"), InputError);
  EXPECT_THROW(value("error_budget_nm"), InputError);
}

TEST_F(DesignMetricTest, IsMinimisedUnlessHigherIsBetter) {
  std::set<std::string> higher;
  for (const DesignMetric& metric : design_metrics()) {
    EXPECT_EQ(metric.minimised(0.5), metric.higher_is_better ? -0.5 : 0.5) << metric.name;
    EXPECT_EQ(metric.minimised(metric.minimised(0.5)), 0.5) << metric.name;
    if (metric.higher_is_better) higher.emplace(metric.name);
  }
  EXPECT_THAT(higher, testing::ElementsAre("captured_energy", "field_strehl"));
}

TEST_F(DesignMetricTest, SaysWhatIsNotSetBeforeAnyScreen) {
  for (const DesignMetric& metric : design_metrics()) {
    const bool needs_speed = metric.name == "servo_wfe_nm" || metric.name == "error_budget_nm";
    if (needs_speed) {
      EXPECT_THROW(metric.validate(operation_), InputError) << metric.name;
    } else {
      EXPECT_NO_THROW(metric.validate(operation_)) << metric.name;
    }
  }
  operation_.wind_speed = 8.0;
  EXPECT_NO_THROW(find_design_metric("error_budget_nm")->validate(operation_));
}

}  // namespace
}  // namespace nlcwfs
