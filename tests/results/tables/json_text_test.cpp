// Tests: JSON is read that may come from anywhere.
#include "results/tables/json_text.hpp"

#include <string>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + '1' + std::string(levels, ']');
}

TEST(JsonText, IsReadWithItsMembersInOrder) {
  EXPECT_EQ(json_of(R"({"b": [1, null, "x"], "a": {"c": 0.5}})").dump(),
            R"({"b":[1,null,"x"],"a":{"c":0.5}})");
  EXPECT_EQ(json_of(nested(64)).dump(), nested(64));
}

TEST(JsonText, IsDiscardedWhereItIsNoJson) {
  for (const char* text : {"", "{", "[1,]", "{\"a\": 1} 2", "\"\xff\""}) {
    EXPECT_TRUE(json_of(text).is_discarded()) << text;
  }
}

TEST(JsonText, IsDiscardedWhereItIsNestedTooDeep) {
  for (const std::size_t levels : {65, 1000000}) {
    EXPECT_TRUE(json_of(nested(levels)).is_discarded()) << levels;
  }
  EXPECT_TRUE(json_of(R"({"a": )" + nested(100) + R"(, "b": 1})").is_discarded());
}

}  // namespace
}  // namespace nlcwfs
