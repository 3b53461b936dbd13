// Tests: Measured frames become images: background, bad pixels, saturation, brightness.
#include "model/frame_calibration.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Image<double> frame() {
  Image<double> values(2, 2);
  values << 10, 20, 30, 40;
  return values;
}

const Image<double> no_background = Image<double>::Zero(2, 2);
const PixelMask none_bad = PixelMask::Constant(2, 2, false);

TEST(FrameCalibration, SubtractsTheBackground) {
  Image<double> background(2, 2);
  background << 1, 2, 3, 44;
  Image<double> expected(2, 2);
  expected << 9, 18, 27, -4;
  EXPECT_TRUE((calibrated_frame(frame(), background, none_bad, infinity) == expected).all());
}

TEST(FrameCalibration, LeavesOutBadPixels) {
  PixelMask bad = none_bad;
  bad(0, 1) = true;
  const Image<double> calibrated = calibrated_frame(frame(), no_background, bad, infinity);
  EXPECT_TRUE((calibrated.isNaN() == bad).all());
  EXPECT_EQ(calibrated(1, 0), 30.0);
}

TEST(FrameCalibration, LeavesOutWhatIsSaturatedBeforeTheBackgroundIsSubtracted) {
  const Image<double> background = Image<double>::Constant(2, 2, 5.0);
  const Image<double> calibrated = calibrated_frame(frame(), background, none_bad, 30.0);
  EXPECT_EQ(calibrated.isNaN().count(), 2);
  EXPECT_TRUE(std::isnan(calibrated(1, 0)) && std::isnan(calibrated(1, 1)));
}

TEST(FrameCalibration, LeavesOutWhatIsNotFinite) {
  Image<double> broken = frame();
  broken(0, 0) = nan;
  broken(1, 1) = -infinity;
  Image<double> background = no_background;
  background(0, 1) = nan;
  const Image<double> calibrated = calibrated_frame(broken, background, none_bad, infinity);
  EXPECT_EQ(calibrated.isNaN().count(), 3);
  EXPECT_EQ(calibrated(1, 0), 30.0);
}

TEST(FrameCalibration, AddsUnmeasuredPixelsUpToAnEvenSquare) {
  const Image<double> odd = Image<double>::Constant(3, 5, 7.0);
  const Image<double> calibrated =
      calibrated_frame(odd, Image<double>::Zero(3, 5), PixelMask::Constant(3, 5, false), infinity);
  EXPECT_EQ(calibrated.rows(), 6);
  EXPECT_EQ(calibrated.cols(), calibrated_width(3, 5));
  EXPECT_TRUE((calibrated.topLeftCorner(3, 5) == 7.0).all());
  EXPECT_EQ(calibrated.isNaN().count(), 36 - 15);
  EXPECT_EQ(calibrated_width(4, 4), 4);
}

}  // namespace
}  // namespace nlcwfs
