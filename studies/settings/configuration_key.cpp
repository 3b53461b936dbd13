// What a configuration key is, and which values it takes.
#include "studies/settings/configuration_key.hpp"

#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

std::string_view element_text(Kind element) {
  switch (element) {
    case Kind::length:
      return "lengths in nm, um, mm, cm, m or km";
    case Kind::time:
      return "times in us, ms, s, min or h";
    case Kind::integer:
      return "whole numbers";
    default:
      return "numbers";
  }
}

}  // namespace

bool Bounds::contain(double value) const {
  return (least_included ? value >= least : value > least) &&
         (greatest_included ? value <= greatest : value < greatest);
}

std::string Bounds::text(std::string_view unit) const {
  const bool below = std::isfinite(least);
  const bool above = std::isfinite(greatest);
  const auto shown = [unit](double value) {
    return value == 0.0 || unit.empty() ? fmt::format("{}", value)
                                        : fmt::format("{} {}", value, unit);
  };
  if (below && above && least_included && greatest_included) {
    return fmt::format("from {} to {}", shown(least), shown(greatest));
  }
  std::string text;
  if (below) text = fmt::format("{} {}", least_included ? "at least" : "above", shown(least));
  if (below && above) text += " and ";
  if (above) text += fmt::format("{} {}", greatest_included ? "at most" : "below", shown(greatest));
  return text;
}

std::string_view ConfigurationKey::unit_text() const {
  switch (kind) {
    case Kind::length:
    case Kind::length_list:
    case Kind::bands:
      return "m";
    case Kind::time:
      return "s";
    case Kind::domain:
    case Kind::axis:
      if (element == Kind::length) return "m";
      if (element == Kind::time) return "s";
      return unit;
    default:
      return unit;
  }
}

std::string ConfigurationKey::bounds_text() const {
  const std::string_view shown = unit_text();
  return bounds.text(shown == "m" || shown == "s" ? shown : "");
}

std::string ConfigurationKey::allowed() const {
  const std::string& shown = example.empty() ? default_text : example;
  const std::string such_as = shown.empty() ? shown : fmt::format(", such as {}", shown);
  const std::string limits = bounds_text();
  const std::string range = limits.empty() ? limits : fmt::format(" {}", limits);
  switch (kind) {
    case Kind::number:
      return fmt::format("a number{}{}{}{}", range, unit.empty() ? "" : " in ", unit, such_as);
    case Kind::number_list:
      return fmt::format("a number{}{}{}, or several separated by commas{}", range,
                         unit.empty() ? "" : " in ", unit, such_as);
    case Kind::integer:
      return fmt::format("a whole number{}", range);
    case Kind::seed:
      return "a whole number from 0 to 18446744073709551615";
    case Kind::length:
      return fmt::format("a length{} in nm, um, mm, cm, m or km{}", range, such_as);
    case Kind::length_list:
      return fmt::format("lengths{} in nm, um, mm, cm, m or km, separated by commas{}", range,
                         such_as);
    case Kind::bands:
      return fmt::format(
          "SHORTEST:LONGEST{} in nm, um, mm, cm, m or km, or several separated by "
          "commas{}",
          range, such_as);
    case Kind::domain:
      if (element == Kind::choice) {
        return fmt::format("one or more of {}, separated by commas", fmt::join(choices, ", "));
      }
      return fmt::format("min:max or min:max:log, or a list separated by commas, of {}{}{}",
                         element_text(element), range, such_as);
    case Kind::axis:
      if (element == Kind::choice) {
        return fmt::format("one or more of {}, separated by commas", fmt::join(choices, ", "));
      }
      return fmt::format(
          "min:max:count or min:max:count:log, or a list separated by commas, of "
          "{}{}{}",
          element_text(element), range, such_as);
    case Kind::orders:
      return fmt::format("all, or orders of plane numbers separated by commas{}", such_as);
    case Kind::time:
      return fmt::format("a time{} in us, ms, s, min or h{}", range, such_as);
    case Kind::ramp:
      return fmt::format("a number{}, or start:end{}", range, such_as);
    case Kind::choice:
      return fmt::format("one of {}", fmt::join(choices, ", "));
    case Kind::text:
      return fmt::format("{} without #{}", is_file ? "a path" : "one line of text", such_as);
  }
  assert(false);
  return {};
}

/// Long, as it has a case for each kind.
bool ConfigurationKey::accepts(std::string_view value) const {
  // A dump has each value in a line.
  if (std::ranges::any_of(value, [](char c) { return is_control(c) && c != '\t'; })) return false;
  const auto within = [this](auto number) {
    return number && bounds.contain(static_cast<double>(*number));
  };
  const auto both_within = [this](auto pair) {
    return pair && bounds.contain(pair->first) && bounds.contain(pair->second);
  };
  const auto all_within = [this](const std::vector<double>& values) {
    return std::ranges::all_of(values, [this](double v) { return bounds.contain(v); });
  };
  const auto list_within = [&](const auto& list) { return list && all_within(*list); };
  switch (kind) {
    case Kind::number:
      return within(parse_number(value));
    case Kind::number_list:
      return list_within(parse_numbers(value));
    case Kind::integer:
      return within(parse_integer(value));
    case Kind::seed:
      return parse_seed(value).has_value();
    case Kind::length:
      return within(parse_length(value));
    case Kind::length_list:
      return list_within(parse_lengths(value));
    case Kind::bands: {
      const auto bands = parse_bands(value);
      return bands && std::ranges::all_of(*bands, [this](const Band& band) {
               return bounds.contain(band.shortest) && bounds.contain(band.longest);
             });
    }
    case Kind::domain: {
      const auto domain = parse_domain(value, element_parser());
      if (!domain) return false;
      if (const auto* list = std::get_if<std::vector<double>>(&*domain)) return all_within(*list);
      const auto& range = std::get<ValueRange>(*domain);
      return element != Kind::choice && bounds.contain(range.lower) && bounds.contain(range.upper);
    }
    case Kind::axis: {
      const auto axis = parse_axis(value, element_parser());
      // A range of whole numbers or words may have places between them.
      return axis && all_within(*axis) &&
             (value.find(':') == std::string_view::npos || element == Kind::number ||
              element == Kind::length || element == Kind::time);
    }
    case Kind::orders:
      return parse_orders(value).has_value();
    case Kind::time:
      return within(parse_time(value));
    case Kind::ramp:
      return both_within(parse_ramp(value));
    case Kind::choice:
      return std::ranges::count(choices, value) > 0;
    case Kind::text:
      // In a file, # starts a comment wherever it stands: a dump could not hold it.
      return std::ranges::none_of(value, [](char c) { return c == '#' || is_control(c); });
  }
  assert(false);
  return false;
}

std::optional<double> ConfigurationKey::element_of(std::string_view value) const {
  switch (element) {
    case Kind::length:
      return parse_length(value);
    case Kind::time:
      return parse_time(value);
    case Kind::integer: {
      const auto integer = parse_integer(value);
      return integer ? std::optional<double>(*integer) : std::nullopt;
    }
    case Kind::choice: {
      const auto word = std::ranges::find(choices, trimmed(value));
      return word == choices.end() ? std::nullopt : std::optional<double>(word - choices.begin());
    }
    default:
      return parse_number(value);
  }
}

std::function<std::optional<double>(std::string_view)> ConfigurationKey::element_parser() const {
  return [this](std::string_view value) { return element_of(value); };
}

const ConfigurationKey& key_named(std::string_view name) {
  const auto key = std::ranges::find(configuration_keys(), name, &ConfigurationKey::name);
  assert(key != configuration_keys().end());
  return *key;
}

}  // namespace nlcwfs
