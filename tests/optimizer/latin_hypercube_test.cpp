// Tests: Points that fill a space.
#include "optimizer/latin_hypercube.hpp"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(LatinHypercube, HasAPointInEveryPartOfEveryRange) {
  const SubSpace space{"",
                       {{"x", -1.0, 3.0},
                        {"n", 2.0, 4.0, VariableKind::integer},
                        {"y", 100.0, 101.0},
                        {"kind", 0.0, 23.0, VariableKind::categorical}}};
  for (const int count : {1, 3, 12, 48}) {
    boost::random::mt19937_64 generator(7);
    const std::vector<SearchPoint> points = latin_hypercube(space, 5, count, generator);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    std::set<int> x_parts;
    std::set<int> y_parts;
    std::multiset<double> numbers;
    std::multiset<double> kinds;
    for (const SearchPoint& point : points) {
      EXPECT_EQ(point.sub_space, 5);
      x_parts.insert(static_cast<int>((point.x[0] + 1.0) / 4.0 * count));
      numbers.insert(point.x[1]);
      y_parts.insert(static_cast<int>((point.x[2] - 100.0) * count));
      kinds.insert(point.x[3]);
    }
    EXPECT_EQ(x_parts.size(), points.size());
    EXPECT_EQ(y_parts.size(), points.size());
    if (count % 3 == 0) {
      for (const double n : {2.0, 3.0, 4.0}) {
        EXPECT_EQ(numbers.count(n), points.size() / 3);
      }
    }
    if (count == 48) {
      for (int kind = 0; kind < 24; ++kind) EXPECT_EQ(kinds.count(kind), 2u);
    }
  }
}

TEST(LatinHypercube, IsShuffledByItsGenerator) {
  const SubSpace space{"", {{"x", 0.0, 1.0}, {"y", 0.0, 1.0}}};
  boost::random::mt19937_64 generator(7);
  const std::vector<SearchPoint> first = latin_hypercube(space, 0, 20, generator);
  const std::vector<SearchPoint> next = latin_hypercube(space, 0, 20, generator);
  generator.seed(7);
  const std::vector<SearchPoint> again = latin_hypercube(space, 0, 20, generator);
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].x, again[i].x);
    differs = differs || first[i].x != next[i].x;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace nlcwfs
