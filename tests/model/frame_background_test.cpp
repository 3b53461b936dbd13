// Tests: What is left of the background in a calibrated frame.
#include "model/frame_background.hpp"

#include "model/random_stream.hpp"
#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

const Eigen::Array2d on_axis = Eigen::Array2d::Zero();

/// level + c r^(-11/3) with the axis at a place, r in pixels.
Image<double> scattered(Eigen::Index width, double level, double c, const Eigen::Array2d& axis) {
  return Image<double>::NullaryExpr(width, width, [=](Eigen::Index row, Eigen::Index column) {
    const double x = double(column) + 0.5 - 0.5 * double(width) - axis.x();
    const double y = double(row) + 0.5 - 0.5 * double(width) - axis.y();
    return level + c * std::pow(std::hypot(x, y), -11.0 / 3.0);
  });
}

TEST(FrameBackground, IsTheLevelThatDoesNotFallOff) {
  for (const double level : {-3.0, 0.0, 7.0}) {
    for (const Eigen::Array2d& axis : {on_axis, Eigen::Array2d(3.5, -2.0)}) {
      const auto found = frame_background(scattered(128, level, 1e7, axis), 32.0, axis);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->level, level, 1e-9);
      EXPECT_NEAR(found->error, 0.0, 1e-9);
    }
  }
}

TEST(FrameBackground, ItsErrorIsThatOfItsScatter) {
  // 200 frames of noise: the mean of the squared errors is the variance, to 4 standard errors of
  // the ratio, which for the jackknife's 15 degrees of freedom is sqrt(2 / 15 / 200) + sqrt(2/200).
  RandomStream stream = random_stream({5});
  boost::random::normal_distribution<double> normal(0.0, 2.0);
  double sum = 0.0;
  double squares = 0.0;
  double errors = 0.0;
  constexpr int frames = 200;
  for (int i = 0; i < frames; ++i) {
    Image<double> frame = scattered(64, 1.0, 1e4, on_axis);
    for (double& pixel : frame.reshaped()) pixel += normal(stream);
    const auto found = frame_background(frame, 16.0, on_axis);
    ASSERT_TRUE(found);
    sum += found->level - 1.0;
    squares += (found->level - 1.0) * (found->level - 1.0);
    errors += found->error * found->error;
  }
  EXPECT_NEAR(sum / frames, 0.0, 4.0 * std::sqrt(squares) / frames);
  EXPECT_NEAR(errors / squares, 1.0,
              4.0 * (std::sqrt(2.0 / 15 / frames) + std::sqrt(2.0 / frames)));
}

TEST(FrameBackground, LeavesOutWhatWasNotMeasured) {
  Image<double> frame = scattered(128, 5.0, 1e7, on_axis);
  frame.topRows(20).setConstant(std::numeric_limits<double>::quiet_NaN());
  frame(127, 127) = std::numeric_limits<double>::quiet_NaN();
  const auto found = frame_background(frame, 32.0, on_axis);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->level, 5.0, 1e-9);
}

TEST(FrameBackground, IsNotFoundWithoutAnUnlitBorder) {
  // A frame of 1.05 diameters: no pixel is farther out than 1.5 radii.
  EXPECT_FALSE(frame_background(scattered(34, 5.0, 0.0, on_axis), 32.0, on_axis));
  Image<double> frame = scattered(128, 5.0, 1e7, on_axis);
  frame.rightCols(110).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(frame_background(frame, 32.0, on_axis));
}

constexpr int sets = 60;

/// The frames of each set, of the light that reaches a sensor.
std::vector<std::vector<Image<double>>> simulated_frames(const SensorDesign& design,
                                                         double d_over_r0) {
  const Telescope telescope;
  const Seeing seeing{.fried_parameter = telescope.diameter / d_over_r0};
  const TurbulenceScreenGenerator generator(seeing, 64, telescope.diameter, 9);
  std::vector<PhaseScreen> screens;
  for (int i = 0; i < sets; ++i) screens.push_back(generator.screen(i));
  const Simulation simulation(telescope, screens, {});
  std::vector<std::vector<Image<double>>> frames;
  for (int i = 0; i < sets; ++i) frames.push_back(simulation.record(design, i).images);
  return frames;
}

TEST(FrameBackground, IsFoundInSimulatedFramesWhereItIsAndNotWhereItIsNot) {
  struct Case {
    double d_over_r0;
    double photons;
    double read_noise;
    double harmful;  ///< in units of the pupil's intensity: doubles the wavefront's error or more
  };
  for (const auto& [d_over_r0, photons, read_noise, harmful] :
       std::vector<Case>{{4.0, 1e6, 0.0, 0.01},
                         {4.0, 1e4, 0.0, 0.02},
                         {4.0, 1e5, 3.0, 0.04},
                         {8.0, 1e6, 1.0, 0.005}}) {
    SensorDesign design;
    design.detector = {.pupil_pixels = 16, .photons = photons, .read_noise = read_noise};
    design.reconstruction.max_loops = 1;
    const auto frames = simulated_frames(design, d_over_r0);
    const auto refused_with = [&](double background) {
      return std::ranges::count_if(frames, [&](const std::vector<Image<double>>& set) {
        return std::ranges::any_of(set, [&](const Image<double>& frame) {
          const auto found =
              frame_background(frame + background, design.detector.pupil_pixels, on_axis);
          return found && found->is_significant();
        });
      });
    };
    // At most 5 % and at least 95 % of very many sets: four standard errors beside, of these.
    const double error = 4.0 * std::sqrt(sets * 0.05 * 0.95);
    EXPECT_LE(refused_with(0.0), sets * 0.05 + error) << photons;
    for (const double background : {harmful, 3.0 * harmful, -harmful}) {
      EXPECT_GE(refused_with(background), sets * 0.95 - error) << background << " at " << photons;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
