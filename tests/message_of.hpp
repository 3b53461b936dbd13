// The message of an error that is expected.
#pragma once

#include "model/input_error.hpp"

#include <string>

namespace nlcwfs {

/// What the InputError says that `action` throws; empty if it throws none.
template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace nlcwfs
