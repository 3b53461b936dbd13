#include "studies/units.hpp"

#include "studies/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// value in SI = number * numerator / denominator. Both are exact in binary, a factor like 1e-9 is
/// not: so 532nm is the same double as 532e-9.
struct Unit {
  std::string_view name;
  double numerator;
  double denominator;
};

constexpr std::array<Unit, 7> length_units{{{"", 1, 1},
                                            {"nm", 1, 1e9},
                                            {"um", 1, 1e6},
                                            {"mm", 1, 1e3},
                                            {"cm", 1, 1e2},
                                            {"m", 1, 1},
                                            {"km", 1e3, 1}}};
constexpr std::array<Unit, 6> time_units{
    {{"", 1, 1}, {"us", 1, 1e6}, {"ms", 1, 1e3}, {"s", 1, 1}, {"min", 60, 1}, {"h", 3600, 1}}};

/// Reads a number at the start of `text` and moves `text` behind it.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  // from_chars knows no plus sign, yet +47km beside -47km is natural.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(end - text.data());
  return number;
}

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  text = trimmed(text);
  const auto number = take_number<Number>(text);
  return text.empty() ? number : std::nullopt;
}

std::optional<double> finite(std::optional<double> number) {
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<double> parse_quantity(std::string_view text, std::span<const Unit> units) {
  text = trimmed(text);
  const auto number = take_number<double>(text);
  if (!number) return std::nullopt;
  const auto unit = std::ranges::find(units, trimmed(text), &Unit::name);
  if (unit == units.end()) return std::nullopt;
  return finite(*number * unit->numerator / unit->denominator);
}

/// The two sides of the first separator; nothing where there is none.
std::optional<std::pair<std::string_view, std::string_view>> split_once(std::string_view text,
                                                                        char separator) {
  const auto at = text.find(separator);
  if (at == std::string_view::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  return finite(parse_whole<double>(text));
}

std::optional<int> parse_integer(std::string_view text) { return parse_whole<int>(text); }

std::optional<std::uint64_t> parse_seed(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

std::optional<double> parse_length(std::string_view text) {
  return parse_quantity(text, length_units);
}

std::optional<double> parse_time(std::string_view text) { return parse_quantity(text, time_units); }

std::optional<std::vector<double>> parse_lengths(std::string_view text) {
  std::vector<double> lengths;
  for (auto parts = split_once(text, ','); parts; parts = split_once(text, ',')) {
    const auto length = parse_length(parts->first);
    if (!length) return std::nullopt;
    lengths.push_back(*length);
    text = parts->second;
  }
  const auto last = parse_length(text);
  if (!last) return std::nullopt;
  lengths.push_back(*last);
  return lengths;
}

std::optional<std::pair<double, double>> parse_length_range(std::string_view text) {
  const auto parts = split_once(text, ':');
  if (!parts) return std::nullopt;
  const auto min = parse_length(parts->first);
  const auto max = parse_length(parts->second);
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return std::pair(*min, *max);
}

std::optional<std::pair<double, double>> parse_ramp(std::string_view text) {
  const auto parts = split_once(text, ':').value_or(std::pair(text, text));
  const auto start = parse_number(parts.first);
  const auto end = parse_number(parts.second);
  if (!start || !end) return std::nullopt;
  return std::pair(*start, *end);
}

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

}  // namespace nlcwfs
