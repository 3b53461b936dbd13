// Tests: When so many evaluations fail that a study is given up.
#include "optimizer/failure_count.hpp"

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

void add(FailureCount& count, int times, bool is_failure) {
  for (int i = 0; i < times; ++i) count.add(is_failure);
}

TEST(FailureCount, IsTooHighAfterSoManyInARow) {
  FailureCount count;
  add(count, FailureCount::allowed_in_a_row - 1, true);
  EXPECT_FALSE(count.is_too_high());
  count.add(true);
  EXPECT_TRUE(count.is_too_high());
}

TEST(FailureCount, StartsAgainAfterASuccess) {
  FailureCount count;
  add(count, FailureCount::allowed_in_a_row - 1, true);
  count.add(false);
  add(count, FailureCount::allowed_in_a_row - 1, true);
  EXPECT_FALSE(count.is_too_high());
  EXPECT_EQ(count.failures(), 2 * (FailureCount::allowed_in_a_row - 1));
}

TEST(FailureCount, IsNotTooHighWhereMostSucceed) {
  FailureCount count;
  add(count, FailureCount::allowed_in_a_row + 1, false);
  add(count, FailureCount::allowed_in_a_row, true);
  EXPECT_FALSE(count.is_too_high());
  count.add(true);
  EXPECT_TRUE(count.is_too_high()) << "half of all";
}

}  // namespace
}  // namespace nlcwfs
