// What a configuration key is, and which values it takes.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

/// What the text of a key stands for; the parsers are in studies/settings/units.hpp.
enum class Kind {
  number,
  number_list,  ///< separated by commas
  integer,
  seed,         ///< 64-bit unsigned
  length,       ///< m
  length_list,  ///< m, separated by commas
  bands,        ///< ranges of wavelengths in m, see parse_bands
  domain,       ///< what a search may choose, see parse_domain
  axis,         ///< what a sweep tries, see parse_axis
  orders,       ///< visiting orders, see parse_orders
  time,         ///< s
  ramp,         ///< a number, or start:end
  choice,       ///< one of a few words
  text
};

/// Where a number must lie, in SI; everywhere unless said otherwise.
struct Bounds {
  /// The least value that is allowed.
  double least = -std::numeric_limits<double>::infinity();
  /// The greatest value that is allowed.
  double greatest = std::numeric_limits<double>::infinity();
  bool least_included = true;     ///< whether the least is allowed itself
  bool greatest_included = true;  ///< whether the greatest is allowed itself

  /// Whether a value is allowed.
  bool contain(double value) const;
  /// For people: "above 0", "from 1 to 64", "at most 0.001 m"; empty without bounds.
  /// @param unit  of what is not 0; empty where it is said elsewhere
  std::string text(std::string_view unit = {}) const;
};

/// One row of the table of configuration keys, which is also the user's documentation of them.
struct ConfigurationKey {
  std::string name;                       ///< section.key
  Kind kind = Kind::text;                 ///< what its text stands for
  std::string default_text = {};          ///< empty = not set
  std::string description = {};           ///< what it means, one line
  std::string unit = {};                  ///< of a number; lengths and times have m and s
  Bounds bounds = {};                     ///< of every number in the value
  std::vector<std::string> choices = {};  ///< the words of a choice, or that a shell offers
  std::string example = {};               ///< for messages; the default where empty
  Kind element = Kind::number;            ///< of a domain's or axis's values: number, integer,
                                          ///< length, time or choice
  bool is_file = false;                   ///< whether the text names a file

  /// What a value may be, for messages and documentation: "a length above 0, such as 0.5m".
  std::string allowed() const;
  /// m, s, arcsec, ...; empty for what has no unit.
  std::string_view unit_text() const;
  /// Its bounds for people, in the unit where it is m or s.
  std::string bounds_text() const;
  /// Whether `value` is well-formed and within bounds.
  bool accepts(std::string_view value) const;
  /// Reads one value of a domain or axis; a choice is its index.
  std::optional<double> element_of(std::string_view value) const;
  /// element_of, while the key lives.
  std::function<std::optional<double>(std::string_view)> element_parser() const;
};

/// Every key, grouped by section.
const std::vector<ConfigurationKey>& configuration_keys();

/// @pre there is such a key
const ConfigurationKey& key_named(std::string_view name);

/// Values that are set together under one name.
struct Preset {
  std::string name;                                         ///< as it is typed
  std::string description;                                  ///< a few words
  std::vector<std::pair<std::string, std::string>> values;  ///< key, value
};

/// Every preset, in the order of the help.
const std::vector<Preset>& presets();

}  // namespace nlcwfs
