// Why a key does not take a value, in a few words.
#include "studies/settings/value_fault.hpp"

#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::vector<std::string> parts_of(std::string_view value, char separator) {
  std::vector<std::string> parts;
  boost::split(parts, value, [separator](char c) { return c == separator; });
  return parts;
}

std::string fault_of_range(const ConfigurationKey& key, std::string_view value) {
  const std::vector<std::string> parts = parts_of(value, ':');
  if (parts.size() < 2 || key.element == Kind::choice) return {};
  const auto lower = key.element_of(parts[0]);
  const auto upper = key.element_of(parts[1]);
  if (!lower || !upper) return {};
  if (!(*lower < *upper)) return "the minimum is not below the maximum";
  if (key.kind != Kind::axis) return {};
  if (parts.size() == 2) return "the count is missing";
  const auto count = parse_integer(parts[2]);
  if (!count) return {};
  if (*count < 2) return "at least 2 values";
  if (*count > most_places) return fmt::format("at most {} values", most_places);
  const bool is_logarithmic = parts.size() == 4 && trimmed(parts[3]) == "log";
  return is_logarithmic && !(*lower > 0.0) ? "log needs a minimum above 0" : "";
}

std::string fault_of_order(std::string_view order) {
  if (order.size() < 2) return {};
  for (const char digit : order) {
    if (digit < '1' || digit > '6') return {};
    if (std::ranges::count(order, digit) > 1) {
      return fmt::format("{}: plane {} is twice", order, digit);
    }
  }
  // An odd number of planes leaves one of a pair out.
  return fmt::format("{}: {} planes have the numbers 1 to {}", order, order.size(),
                     order.size() + order.size() % 2);
}

std::string fault_of_length(const ConfigurationKey& key, std::string_view value, double length) {
  // All units of lengths end in m.
  const bool has_unit = value.find('m') != std::string_view::npos;
  return length > key.bounds.greatest && !has_unit ? "without a unit it is in m" : "";
}

/// The parts as numbers or, where they are no numbers, as texts that are equal where these are.
std::vector<std::string> comparable(const ConfigurationKey& key,
                                    const std::vector<std::string>& parts) {
  std::vector<std::string> texts;
  for (const std::string& part : parts) {
    const auto number = key.kind == Kind::length_list ? parse_length(part) : key.element_of(part);
    texts.push_back(number && key.kind != Kind::orders ? fmt::format("{}", *number)
                                                       : std::string(trimmed(part)));
  }
  return texts;
}

bool is_tried_one_by_one(const ConfigurationKey& key) {
  constexpr std::array<std::string_view, 6> not_tried{"sensor.planes",  "baseline.planes",
                                                      "frames.centre",  "frames.flux",
                                                      "source.weights", "trade.reference"};
  switch (key.kind) {
    case Kind::number_list:
    case Kind::length_list:
      return std::ranges::count(not_tried, key.name) == 0;
    case Kind::domain:
    case Kind::axis:
    case Kind::orders:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string fault_of(const ConfigurationKey& key, std::string_view value) {
  switch (key.kind) {
    case Kind::domain:
    case Kind::axis:
      return fault_of_range(key, value);
    case Kind::orders:
      for (const std::string& order : parts_of(value, ',')) {
        if (!parse_orders(order)) return fault_of_order(trimmed(order));
      }
      return {};
    case Kind::bands: {
      const auto bands = parse_bands(value);
      return bands ? fault_of_length(key, value, bands->front().longest) : "";
    }
    case Kind::length:
      return fault_of_length(key, value, parse_length(value).value_or(0.0));
    default:
      return {};
  }
}

std::string repeated_part(const ConfigurationKey& key, std::string_view value) {
  if (!is_tried_one_by_one(key)) return {};
  const std::vector<std::string> parts = parts_of(value, ',');
  const std::vector<std::string> texts = comparable(key, parts);
  std::map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [first, is_new] = places.emplace(texts[i], i);
    if (!is_new) return std::string(trimmed(parts[first->second]));
  }
  return {};
}

}  // namespace nlcwfs
