#include "model/statistics.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(MeanAndStandardError, UsesTheSampleVariance) {
  const std::array values{1.0, 2.0, 3.0, 4.0};
  const MeanAndError result = mean_and_standard_error(values);
  EXPECT_DOUBLE_EQ(result.mean, 2.5);
  EXPECT_DOUBLE_EQ(result.standard_error, std::sqrt(5.0 / 3.0 / 4.0));
}

TEST(MeanAndStandardError, DoesNotLoseASmallSpreadAboutALargeMean) {
  const std::array values{1e9 - 1.0, 1e9, 1e9 + 1.0};
  EXPECT_DOUBLE_EQ(mean_and_standard_error(values).standard_error, std::sqrt(1.0 / 3.0));
}

TEST(MeanAndStandardError, OfOneValueHasNoError) {
  const std::array values{7.0};
  const MeanAndError result = mean_and_standard_error(values);
  EXPECT_EQ(result.mean, 7.0);
  EXPECT_EQ(result.standard_error, 0.0);
}

}  // namespace
}  // namespace nlcwfs
