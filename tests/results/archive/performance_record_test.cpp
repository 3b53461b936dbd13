// Tests: Performances become bytes and back, to the last bit.
#include "results/archive/performance_record.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

ScreenPerformance screen(double value) {
  return {.wavefront = {.residual_wfe = value,
                        .wrapped_wfe = value / 3.0,
                        .total_wfe = -0.0,
                        .field_strehl = std::numeric_limits<double>::quiet_NaN(),
                        .recovered_share = 5e-324},
          .converged = true,
          .loops = 7,
          .fractional_loops = 6.1,
          .fft_count = 63,
          .seconds = 0.1,
          .data_seconds = 1e300,
          .captured_energy = {0.9, 1.0 / 3.0}};
}

TEST(PerformanceRecord, IsExact) {
  const std::vector<Performance> performances{{{screen(0.1), screen(1e-9)}}, {{screen(2.0)}}};
  const std::vector<Performance> again = performances_of(performance_record(performances));
  ASSERT_EQ(again.size(), 2u);
  ASSERT_EQ(again[0].screens.size(), 2u);
  ASSERT_EQ(again[1].screens.size(), 1u);
  const ScreenPerformance& one = again[0].screens[0];
  EXPECT_EQ(one.wavefront.residual_wfe, 0.1);
  EXPECT_EQ(one.wavefront.wrapped_wfe, 0.1 / 3.0);
  EXPECT_TRUE(std::signbit(one.wavefront.total_wfe));
  EXPECT_TRUE(std::isnan(one.wavefront.field_strehl));
  EXPECT_EQ(one.wavefront.recovered_share, 5e-324);
  EXPECT_TRUE(one.converged);
  EXPECT_EQ(one.loops, 7);
  EXPECT_EQ(one.fractional_loops, 6.1);
  EXPECT_EQ(one.fft_count, 63);
  EXPECT_EQ(one.seconds, 0.1);
  EXPECT_EQ(one.data_seconds, 1e300);
  EXPECT_EQ(one.captured_energy, (std::vector<double>{0.9, 1.0 / 3.0}));
  EXPECT_EQ(performance_record(again), performance_record(performances));
}

TEST(PerformanceRecord, RefusesOtherBytes) {
  const std::vector<std::uint8_t> whole = performance_record({{{screen(0.1)}}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(performances_of({whole.begin(), whole.begin() + std::ptrdiff_t(size)}),
                 std::runtime_error);
  }
  EXPECT_THROW(performances_of({0x01}), std::runtime_error) << "a number";
  EXPECT_THROW(performances_of({0x81, 0x81, 0x80}), std::runtime_error) << "a screen of nothing";
}

TEST(PerformanceRecord, RefusesOtherNesting) {
  EXPECT_THROW(performances_of(std::vector<std::uint8_t>(3000000, 0x81)), std::runtime_error);
  EXPECT_THROW(performances_of({0x81, 0x81, 0xa1}), std::runtime_error) << "an object";
  EXPECT_THROW(performances_of({0x81, 0xf6}), std::runtime_error) << "a null";
  EXPECT_THROW(performances_of({0x81, 0x61, 'a'}), std::runtime_error) << "a text";
}

TEST(PerformanceRecord, RefusesCountsThatAreNone) {
  const ScreenPerformance one = screen(0.1);
  std::vector<std::uint8_t> record = performance_record({{{one}}});
  const auto loops = std::ranges::find(record, std::uint8_t{7});
  ASSERT_NE(loops, record.end());
  EXPECT_EQ(performances_of(record).front().screens.front().loops, 7);
  // The number 7 as a half-precision float.
  *loops = 0xf9;
  record.insert(loops + 1, {0x47, 0x00});
  EXPECT_THAT([&] { (void)performances_of(record); },
              testing::ThrowsMessage<std::runtime_error>(
                  "no record of performances: a count is no whole number"));
}

}  // namespace
}  // namespace nlcwfs
