// What is wrong with a user's input becomes one line.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

/// Everything of nlcwfs: the libraries and the program.
namespace nlcwfs {

/// Input that a user can mend: names the configuration key, its value, what is allowed and, where
/// it helps, how to mend it, in one line of one grammar: `key = value: allowed; remedy`.
class InputError : public std::runtime_error {
 public:
  /// @param key      the configuration key or file that holds the value
  /// @param value    the value as the user would write it
  /// @param allowed  what is allowed, or what is wrong
  /// @param remedy   how to mend it; empty where that is plain
  template <class Value>
  InputError(std::string_view key, const Value& value, std::string_view allowed,
             std::string_view remedy = {})
      : std::runtime_error(fmt::format("{} = {}: {}{}{}", key, value, allowed,
                                       remedy.empty() ? "" : "; ", remedy)),
        key_(key),
        value_(fmt::format("{}", value)),
        allowed_(allowed),
        remedy_(remedy) {}

  const std::string& key() const { return key_; }          ///< as given
  const std::string& value() const { return value_; }      ///< as text
  const std::string& allowed() const { return allowed_; }  ///< as given
  const std::string& remedy() const { return remedy_; }    ///< as given; may be empty

 private:
  std::string key_;
  std::string value_;
  std::string allowed_;
  std::string remedy_;
};

/// @throws InputError of the other arguments unless the input is as it should be
template <class Value>
void require(bool is_right, std::string_view key, const Value& value, std::string_view allowed) {
  if (!is_right) throw InputError(key, value, allowed);
}

}  // namespace nlcwfs
