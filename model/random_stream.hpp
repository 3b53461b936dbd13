// Random numbers that are the same on every platform.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/seed_seq.hpp>

namespace nlcwfs {

/// A generator whose numbers are the same on every platform.
using RandomStream = boost::random::mt19937_64;

/// An independent stream of random numbers for each list of keys, such as (seed, screen, plane):
/// the same keys give the same numbers on every platform, in any thread and in any order.
inline RandomStream random_stream(std::initializer_list<std::uint64_t> keys) {
  std::vector<std::uint32_t> words;
  for (const std::uint64_t key : keys) {
    words.push_back(static_cast<std::uint32_t>(key));
    words.push_back(static_cast<std::uint32_t>(key >> 32U));
  }
  boost::random::seed_seq sequence(words.begin(), words.end());
  return RandomStream(sequence);
}

}  // namespace nlcwfs
