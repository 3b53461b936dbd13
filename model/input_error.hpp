#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

/// Everything of nlcwfs: the libraries and the program.
namespace nlcwfs {

/// Input that a user can mend: names the configuration key, its value and what is allowed, in one
/// line of one grammar: `key = value: allowed`.
class InputError : public std::runtime_error {
 public:
  /// @param key      the configuration key or file that holds the value
  /// @param value    the value as the user would write it
  /// @param allowed  what is allowed and, where it helps, how to mend it
  template <class Value>
  InputError(std::string_view key, const Value& value, std::string_view allowed)
      : std::runtime_error(fmt::format("{} = {}: {}", key, value, allowed)) {}
};

}  // namespace nlcwfs
