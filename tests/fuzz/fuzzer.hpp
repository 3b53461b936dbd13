// What the fuzzers share.
#pragma once

#include "model/input_error.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// What libFuzzer calls, and the replay of a corpus: reads hostile input, of which nothing may
/// escape.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nlcwfs {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return {reinterpret_cast<const char*>(data), size};
}

/// Does what may end in an InputError, and in no other exception.
/// @returns whether there was none
template <class Action>
bool is_accepted(const Action& action) {
  try {
    action();
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace nlcwfs
