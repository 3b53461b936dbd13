// Lengths and durations, for people.
#include "results/text/quantity_text.hpp"

#include <cmath>

#include <fmt/format.h>

namespace nlcwfs {

std::string format_length(double length) {
  if (length == 0.0) return "0 m";
  const Unit* chosen = &length_units[1];  // the smallest
  for (const Unit& unit : length_units) {
    if (unit.name.empty() || unit.name == "cm") continue;
    if (std::abs(length) * unit.denominator / unit.numerator >= 1.0) chosen = &unit;
  }
  const double scaled = length * chosen->denominator / chosen->numerator;
  // Beyond 1000 km whole kilometres read better than an exponent.
  return std::abs(scaled) < 1000.0 ? fmt::format("{:.4g} {}", scaled, chosen->name)
                                   : fmt::format("{:.6g} {}", std::round(scaled), chosen->name);
}

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

}  // namespace nlcwfs
