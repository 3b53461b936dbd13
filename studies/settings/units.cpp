// Numbers, lengths, times, ranges and lists are read.
#include "studies/settings/units.hpp"

#include "results/text/quantity_text.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

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

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (auto both = split_once(text, separator); both; both = split_once(text, separator)) {
    parts.push_back(both->first);
    text = both->second;
  }
  parts.push_back(text);
  return parts;
}

/// Values separated by commas, at least one, none empty.
std::optional<std::vector<double>> parse_list(std::string_view text,
                                              const ValueParser& parse_value) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) {
    const auto value = parse_value(part);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Scale> parse_scale(std::string_view text) {
  if (trimmed(text) == "log") return Scale::logarithmic;
  if (trimmed(text) == "linear") return Scale::linear;
  return std::nullopt;
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

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  return parse_list(text, parse_number);
}

std::optional<std::vector<double>> parse_lengths(std::string_view text) {
  return parse_list(text, parse_length);
}

std::optional<std::vector<Band>> parse_bands(std::string_view text) {
  std::vector<Band> bands;
  for (const std::string_view part : split(text, ',')) {
    const auto ends = split_once(part, ':');
    const auto shortest = parse_length(ends ? ends->first : part);
    const auto longest = parse_length(ends ? ends->second : part);
    if (!shortest || !longest || *shortest > *longest) return std::nullopt;
    bands.push_back({*shortest, *longest});
  }
  return bands;
}

std::optional<Domain> parse_domain(std::string_view text, const ValueParser& parse_value) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() == 1) return parse_list(text, parse_value);
  const auto lower = parse_value(parts[0]);
  const auto upper = parse_value(parts[1]);
  if (!lower || !upper || !(*lower < *upper) || parts.size() > 3) return std::nullopt;
  ValueRange range{*lower, *upper};
  if (parts.size() == 3) {
    range.scale = parse_scale(parts[2]);
    if (!range.scale) return std::nullopt;
  }
  return range;
}

std::optional<std::vector<double>> parse_axis(std::string_view text,
                                              const ValueParser& parse_value) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() == 1) return parse_list(text, parse_value);
  if (parts.size() < 3 || parts.size() > 4) return std::nullopt;
  const auto lower = parse_value(parts[0]);
  const auto upper = parse_value(parts[1]);
  const auto count = parse_integer(parts[2]);
  const auto scale = parts.size() == 4 ? parse_scale(parts[3]) : Scale::linear;
  if (!lower || !upper || !count || !scale || !(*lower < *upper) || *count < 2 ||
      *count > most_places || (*scale == Scale::logarithmic && !(*lower > 0.0))) {
    return std::nullopt;
  }
  std::vector<double> places;
  for (int i = 0; i < *count; ++i) {
    const double share = double(i) / (*count - 1);
    places.push_back(*scale == Scale::linear
                         ? std::lerp(*lower, *upper, share)
                         : std::exp(std::lerp(std::log(*lower), std::log(*upper), share)));
  }
  places.front() = *lower;
  places.back() = *upper;
  return places;
}

std::optional<std::vector<VisitingOrder>> parse_orders(std::string_view text) {
  std::vector<VisitingOrder> orders;
  if (trimmed(text) == "all") return orders;
  for (const std::string_view word : split(text, ',')) {
    VisitingOrder& order = orders.emplace_back();
    for (const char digit : trimmed(word)) {
      const int number = digit - '0';
      if (number < 1 || number > 6 || std::ranges::count(order, number) > 0) return std::nullopt;
      order.push_back(number);
    }
    // The planes of the pairs that the number of planes needs, all or all but one.
    const auto count = static_cast<int>(order.size());
    if (count < 2 || std::ranges::max(order) > count + count % 2) return std::nullopt;
  }
  return orders;
}

std::string with_lengths(std::string_view text, const std::function<double(double)>& replaced) {
  const bool is_range = text.find(':') != std::string_view::npos;
  std::vector<std::string> parts;
  for (const std::string_view part : split(text, is_range ? ':' : ',')) {
    const bool is_length = !is_range || parts.size() < 2;
    parts.push_back(is_length ? fmt::format("{}", replaced(parse_length(part).value()))
                              : std::string(part));
  }
  return fmt::format("{}", fmt::join(parts, is_range ? ":" : ","));
}

std::optional<std::pair<double, double>> parse_ramp(std::string_view text) {
  const auto parts = split_once(text, ':').value_or(std::pair(text, text));
  const auto start = parse_number(parts.first);
  const auto end = parse_number(parts.second);
  if (!start || !end) return std::nullopt;
  return std::pair(*start, *end);
}

}  // namespace nlcwfs
