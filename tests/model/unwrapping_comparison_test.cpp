// Tests: the comparison of unwrapping methods runs.
#include "model/simulation.hpp"
#include "model/statistics.hpp"
#include "model/turbulence_screen.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

/// The default and the other method on the same reconstructions: those stop by
/// StoppingRule::difference, which does not unwrap. Strong turbulence, few pixels and photons leave
/// branch points in them, on which the methods differ.
TEST(UnwrappingComparison, TheDefaultIsNotWorseOnNoisyReconstructions) {
  const Telescope telescope;
  const TurbulenceScreenGenerator generator({.fried_parameter = telescope.diameter / 10.0}, 64,
                                            telescope.diameter, 1);
  const Simulation simulation(telescope, generate_screens(generator, 64), {});
  SensorDesign design;
  design.detector.pupil_pixels = 32;
  design.detector.photons = 3e3;
  design.reconstruction.window = 4.0;
  const Performance with_default = simulation.evaluate(design);
  design.reconstruction.unwrapping =
      design.reconstruction.unwrapping == UnwrappingMethod::quality_guided
          ? UnwrappingMethod::least_squares
          : UnwrappingMethod::quality_guided;
  const Performance with_other = simulation.evaluate(design);

  const PerformanceMetric wrapped = performance_metric("wrapped_wfe_nm");
  ASSERT_EQ(with_default.samples_of(wrapped), with_other.samples_of(wrapped));
  const PerformanceMetric residual = performance_metric("residual_wfe_nm");
  std::vector<double> excess = with_default.samples_of(residual);
  std::ranges::transform(excess, with_other.samples_of(residual), excess.begin(), std::minus<>());
  const MeanAndError difference = mean_and_standard_error(excess);
  EXPECT_GT(difference.standard_error, 0.0);
  EXPECT_LE(difference.mean, 3.0 * difference.standard_error);
}

}  // namespace
}  // namespace nlcwfs
