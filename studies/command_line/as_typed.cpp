// Errors of the physics name values as the user has typed them.
#include "studies/command_line/as_typed.hpp"

#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

namespace nlcwfs {
namespace {

/// Whether the texts of a kind are numbers, which the physics writes in its own way.
bool is_numeric(Kind kind) {
  return kind != Kind::seed && kind != Kind::orders && kind != Kind::choice && kind != Kind::text;
}

std::optional<double> parse_in_unit(const ConfigurationKey& key, std::string_view text) {
  if (key.unit_text() == "m") return parse_length(text);
  if (key.unit_text() == "s") return parse_time(text);
  return parse_number(text);
}

/// The number of a value that is `shown`, as it is typed; empty where there is none, as where a
/// search tries what is not configured.
std::string number_as_typed(const ConfigurationKey& key, const std::string& typed, double shown) {
  constexpr double digits = 1e-5;  // that messages show
  std::vector<std::string> parts;
  boost::split(parts, typed, boost::is_any_of(",:"));
  for (const std::string& part : parts) {
    const auto number = parse_in_unit(key, part);
    if (number && std::abs(*number - shown) <= digits * std::abs(shown)) {
      return std::string(trimmed(part));
    }
  }
  return {};
}

}  // namespace

InputError as_typed(const InputError& error, const Configuration& configuration) {
  const auto key = std::ranges::find(configuration_keys(), error.key(), &ConfigurationKey::name);
  if (key == configuration_keys().end() || !is_numeric(key->kind)) return error;
  const std::string& typed = configuration.value_text(key->name);
  if (typed.empty()) return error;
  std::string shown = one_line(typed);
  if (const auto number = parse_number(error.value())) {
    shown = number_as_typed(*key, typed, *number);
  } else if (typed.find(error.value()) != std::string::npos) {
    return error;
  }
  if (shown.empty()) return error;
  return {key->name, shown, error.allowed(), error.remedy()};
}

}  // namespace nlcwfs
