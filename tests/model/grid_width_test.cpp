// Tests: Widths that grids may have: bounded, and with small prime factors.
#include "model/grid_width.hpp"

#include "tests/message_of.hpp"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string message(double window, int samples) {
  return message_of([&] { validate_grid_window("a.window", window, "a.samples", samples); });
}

TEST(GridWidth, IsTheNearestWholeNumberOfSamples) {
  EXPECT_EQ(grid_width(4.0, 64), 256);
  EXPECT_EQ(grid_width(0.1 + 0.2, 100), 30);
  EXPECT_EQ(grid_width(10.0 / 3.0, 6), 20);
}

TEST(GridWidth, AllowsEvenWidthsOfAtLeastADiameter) {
  EXPECT_EQ(message(1.0, 64), "");
  EXPECT_EQ(message(10.0 / 3.0, 6), "");
  EXPECT_EQ(message(1.4, 10), "");
  EXPECT_EQ(message(4.03125, 64), "");
  EXPECT_EQ(message(max_grid_width / 64.0, 64), "");
}

TEST(GridWidth, DemandsADiameter) {
  for (const double window : {0.0, -4.0, 0.96875, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(message(window, 64), fmt::format("a.window = {}: at least 1 pupil diameter", window));
  }
}

TEST(GridWidth, NamesTheWidestWindow) {
  EXPECT_THAT(message(129.0, 64),
              StartsWith("a.window = 129: at most 128 pupil diameters of 64 samples, 8192 in all"));
  EXPECT_THAT(message(1e300, 64), StartsWith("a.window = 1e+300: at most 128 "));
  EXPECT_EQ(message(128.0, 64), "");
}

TEST(GridWidth, RefusesAWidthThatIsOddOrNotWhole) {
  EXPECT_EQ(message(4.02, 64),
            "a.window = 4.02: window x a.samples must be an even whole number of samples, but is "
            "257.28; the nearest window is 4.03125");
  EXPECT_THAT(message(1.5, 6), HasSubstr("but is 9;"));
}

TEST(GridWidth, NamesANearestWindowThatIsAllowed) {
  for (const int samples : {4, 6, 14, 22, 48, 64, 100, 1026}) {
    for (const double window : {1.01, 1.2345, 3.33333, 4.0001, 5.77}) {
      const std::string text = message(window, samples);
      if (text.empty()) continue;
      const std::string nearest = text.substr(text.rfind(' ') + 1);
      EXPECT_EQ(message(std::stod(nearest), samples), "") << text;
      EXPECT_NEAR(std::stod(nearest), window, 1.0001 / samples);
    }
  }
}

}  // namespace
}  // namespace nlcwfs
