// Tests: Random numbers that are the same on every platform.
#include "model/random_stream.hpp"

#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(RandomStream, IsTheSameForTheSameKeys) {
  RandomStream first = random_stream({1, 2, 3});
  RandomStream second = random_stream({1, 2, 3});
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(first(), second());
}

TEST(RandomStream, DiffersForOtherKeysOtherOrdersAndOtherNumbersOfKeys) {
  constexpr std::uint64_t high = std::uint64_t{1} << 32U;
  std::set<std::uint64_t> firsts;
  int streams = 0;
  for (const auto keys :
       std::initializer_list<std::initializer_list<std::uint64_t>>{{0},
                                                                   {1},
                                                                   {high},
                                                                   {1, 0},
                                                                   {0, 1},
                                                                   {1, 2, 3},
                                                                   {3, 2, 1},
                                                                   {1, 3, 2},
                                                                   {1, 2},
                                                                   {1 + high, 2},
                                                                   {1, 2 + high},
                                                                   {0, 0},
                                                                   {~std::uint64_t{0}}}) {
    RandomStream stream = random_stream(keys);
    firsts.insert(stream());
    ++streams;
  }
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (std::uint64_t screen = 0; screen < 30; ++screen) {
      RandomStream stream = random_stream({seed, screen, 7});
      firsts.insert(stream());
      ++streams;
    }
  }
  EXPECT_EQ(firsts.size(), std::size_t(streams));
}

TEST(RandomStream, IsTheStandardsGeneratorAndSeeding) {
  // Each key as its low and its high word.
  std::seed_seq sequence{5U, 0U, 7U, 1U};
  std::mt19937_64 standard(sequence);
  RandomStream stream = random_stream({5, 7 + (std::uint64_t{1} << 32U)});
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(stream(), standard());
}

TEST(RandomStream, NeighbouringKeysAreUncorrelated) {
  // Correlation of n pairs of uniform numbers: standard error 1 / sqrt(n).
  const int pairs = 20000;
  const auto uniform = [](RandomStream& stream) { return double(stream()) / 0x1p64 - 0.5; };
  for (std::uint64_t key = 0; key < 5; ++key) {
    RandomStream first = random_stream({1, key, 0});
    RandomStream second = random_stream({1, key + 1, 0});
    double product = 0.0;
    for (int i = 0; i < pairs; ++i) product += uniform(first) * uniform(second);
    EXPECT_LT(std::abs(product / pairs * 12.0), 4.0 / std::sqrt(double(pairs)));
  }
}

}  // namespace
}  // namespace nlcwfs
