// Lengths and durations, for people.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace nlcwfs {

/// A unit that values are typed and shown in: value in SI = number * numerator / denominator. Both
/// are exact in binary, a factor like 1e-9 is not: so 532nm is the same double as 532e-9.
struct Unit {
  std::string_view name;  ///< empty for SI without a unit
  double numerator;       ///< see above
  double denominator;     ///< see above
};

/// Of lengths, ascending.
inline constexpr std::array<Unit, 7> length_units{{{"", 1, 1},
                                                   {"nm", 1, 1e9},
                                                   {"um", 1, 1e6},
                                                   {"mm", 1, 1e3},
                                                   {"cm", 1, 1e2},
                                                   {"m", 1, 1},
                                                   {"km", 1e3, 1}}};

/// A length for people, with 4 significant digits: 47 km, 532 nm. A key of lengths reads it back.
/// @param length  m
std::string format_length(double length);

/// "1 h 05 min", "2 min 10 s", "45 s".
std::string duration_text(double seconds);

}  // namespace nlcwfs
