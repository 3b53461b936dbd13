// Tests: what is wrong with a user's input becomes one line.
#include "model/input_error.hpp"

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(InputError, SaysAllThatItCarriesInOneLine) {
  const InputError error("telescope.diameter", -0.5, "a length above 0", "give one in m");
  EXPECT_STREQ(error.what(), "telescope.diameter = -0.5: a length above 0; give one in m");
  EXPECT_EQ(error.key(), "telescope.diameter");
  EXPECT_EQ(error.value(), "-0.5");
  EXPECT_EQ(error.allowed(), "a length above 0");
  EXPECT_EQ(error.remedy(), "give one in m");
}

TEST(InputError, NeedsNoRemedy) {
  const InputError error("screens.count", 0, "from 1 to 1000000");
  EXPECT_STREQ(error.what(), "screens.count = 0: from 1 to 1000000");
  EXPECT_EQ(error.remedy(), "");
}

}  // namespace
}  // namespace nlcwfs
