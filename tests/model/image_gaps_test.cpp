// Tests: Gaps of an image are filled from around them.
#include "model/image_gaps.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ImageGaps, AreFilledWithTheMeanOfTheirNeighbours) {
  Image<double> image(3, 3);
  image << 1, 2, 3, 4, nan, 6, 7, 8, 14;
  EXPECT_DOUBLE_EQ(with_gaps_filled(image)(1, 1), 45.0 / 8.0);
  image << nan, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_DOUBLE_EQ(with_gaps_filled(image)(0, 0), 11.0 / 3.0);
}

TEST(ImageGaps, AreFilledFromTheirEdgeInwards) {
  Image<double> image = Image<double>::Constant(1, 5, nan);
  image(0, 0) = 1.0;
  image(0, 4) = 3.0;
  Image<double> expected(1, 5);
  expected << 1, 1, 2, 3, 3;
  EXPECT_TRUE((with_gaps_filled(image) == expected).all());
}

TEST(ImageGaps, OfAPlainImageDoNotShow) {
  Image<double> image = Image<double>::Constant(20, 30, 2.5);
  image.block(3, 4, 9, 11).setConstant(nan);
  image.rightCols(7).setConstant(nan);
  EXPECT_LT((with_gaps_filled(image) - 2.5).abs().maxCoeff(), 1e-14);
}

TEST(ImageGaps, LeaveValuesAsTheyAre) {
  const Image<double> image = Image<double>::Random(5, 5);
  EXPECT_TRUE((with_gaps_filled(image) == image).all());
}

TEST(ImageGaps, StayWhereThereIsNoValueAtAll) {
  EXPECT_TRUE(with_gaps_filled(Image<double>::Constant(4, 4, nan)).isNaN().all());
}

}  // namespace
}  // namespace nlcwfs
