// Numbers, lengths, times, ranges and lists are read.
#pragma once

#include "model/light_source.hpp"
#include "objectives/design_space.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

// Text to numbers and back. Every parser reads the whole text or nothing, ignores spaces around
// values, follows no locale and refuses what is not finite or does not fit its type.

/// A number such as 0.5, -3 or 5e9.
std::optional<double> parse_number(std::string_view text);

/// A whole number without exponent or fraction.
std::optional<int> parse_integer(std::string_view text);

/// A seed: a whole number from 0 to 2^64 - 1.
std::optional<std::uint64_t> parse_seed(std::string_view text);

/// Numbers, separated by commas: 4,8. At least one, none empty.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// A length in m: 0.5, 532nm, 47km. Units nm, um, mm, cm, m and km; a bare number is in m.
std::optional<double> parse_length(std::string_view text);

/// A time in s: 90, 5min, 1.5h. Units us, ms, s, min and h; a bare number is in s.
std::optional<double> parse_time(std::string_view text);

/// Lengths in m, separated by commas: -47km,47km. At least one, none empty.
std::optional<std::vector<double>> parse_lengths(std::string_view text);

/// Ranges of wavelengths in m, separated by commas: 500nm:549nm,632.8nm. At least one, none empty.
std::optional<std::vector<Band>> parse_bands(std::string_view text);

/// Reads one value, such as parse_length.
using ValueParser = std::function<std::optional<double>(std::string_view)>;

/// What may be chosen: min:max, min:max:log or min:max:linear with min < max, or values separated
/// by commas.
std::optional<Domain> parse_domain(std::string_view text, const ValueParser& parse_value);

/// The most places that an axis may have.
constexpr int most_places = 100000;

/// Places on an axis: min:max:count (evenly spaced, both ends included) or min:max:count:log with
/// min < max and a count of at least 2, or values separated by commas.
std::optional<std::vector<double>> parse_axis(std::string_view text,
                                              const ValueParser& parse_value);

/// `all` (an empty list), or visiting orders separated by commas, each the numbers of its planes:
/// 3412,1234.
std::optional<std::vector<VisitingOrder>> parse_orders(std::string_view text);

/// The text of a domain or axis of lengths with each of its lengths replaced.
/// @pre parse_domain or parse_axis reads it
std::string with_lengths(std::string_view text, const std::function<double(double)>& replaced);

/// A number, or two as start:end; {start, end}, which are equal for one number.
std::optional<std::pair<double, double>> parse_ramp(std::string_view text);

}  // namespace nlcwfs
