// Bounds as messages show them: rounded so that they are allowed themselves.
#pragma once

#include "model/array.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace nlcwfs {

/// A greatest distance for messages, rounded down so that it is allowed itself: "4699 km".
/// @param distance  m, above 0
inline std::string bound_text(double distance) {
  const double kilometres = distance / 1e3;
  const double last_digit = std::pow(10.0, std::floor(std::log10(kilometres)) - 3.0);
  return fmt::format("{:.4g} km", std::floor(kilometres / last_digit) * last_digit);
}

/// What too much memory takes, for messages: "20 GiB of memory, and 16 GiB are allowed".
/// @param bytes  above max_image_memory
inline std::string memory_text(double bytes) {
  return fmt::format("{:.3g} GiB of memory, and {:g} GiB are allowed", bytes / std::exp2(30),
                     max_image_memory / std::exp2(30));
}

}  // namespace nlcwfs
