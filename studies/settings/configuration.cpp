// Values of keys, layer upon layer: defaults, preset, files, command line.
#include "studies/settings/configuration.hpp"

#include "model/input_error.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"
#include "studies/settings/value_fault.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <system_error>

#include <boost/program_options/errors.hpp>
#include <boost/program_options/options_description.hpp>
#include <boost/program_options/parsers.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

namespace po = boost::program_options;

/// The three measures of one thing, of which one is set.
constexpr std::array<std::string_view, 3> seeing_measures{"seeing.d_over_r0",
                                                          "seeing.fried_parameter", "seeing.fwhm"};
constexpr std::string_view default_source = "by default";

std::size_t index_of(std::string_view name) {
  return static_cast<std::size_t>(&key_named(name) - configuration_keys().data());
}

/// The part of section.key before and after the dot.
std::pair<std::string_view, std::string_view> section_and_name(const ConfigurationKey& key) {
  const std::string_view name = key.name;
  const auto dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

/// The source without the line of a file: a layer's values override those of the layers before it.
std::string_view layer_of(std::string_view source) {
  return source.substr(0, source.rfind(", line "));
}

}  // namespace

Configuration::Configuration() {
  for (const ConfigurationKey& key : configuration_keys()) {
    values_.push_back({key.default_text, std::string(default_source)});
  }
}

void Configuration::apply_preset(std::string_view name) {
  const auto preset = std::ranges::find(presets(), name, &Preset::name);
  if (preset == presets().end()) {
    std::vector<std::string> names;
    for (const Preset& known : presets()) names.push_back(known.name);
    throw InputError("--preset", one_line(name),
                     fmt::format("{} {}", names.size() == 1 ? "the only one is" : "one of",
                                 fmt::join(names, ", ")));
  }
  for (const auto& [key, value] : preset->values) set(key, value, "by --preset " + preset->name);
}

void Configuration::read_file(const std::filesystem::path& path) {
  const std::string name = one_line(path.string());
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError("--config", name, "a directory", "give the path of a configuration file");
  }
  std::ifstream file(path);
  if (!file) {
    throw InputError("--config", name,
                     fmt::format("cannot be read ({})", std::generic_category().message(errno)),
                     "give the path of a configuration file");
  }
  // A device may never end.
  constexpr std::size_t most_characters = std::size_t{16} << 20U;
  std::string text;
  for (char c = 0; text.size() <= most_characters && file.get(c);) text += c;
  if (file.bad()) throw std::runtime_error(fmt::format("{}: reading failed", name));
  if (text.size() > most_characters) {
    throw InputError("--config", name, "longer than 16 MiB",
                     "give the path of a configuration file");
  }
  std::istringstream lines_of_file(std::move(text));
  // Boost parses one line at a time, under its section's header: it has no line numbers itself.
  std::string header;
  std::string line;
  std::map<std::string, int> line_of;
  for (int number = 1; std::getline(lines_of_file, line); ++number) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some editors write it
    if (number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    if (std::ranges::any_of(line, [](char c) { return is_control(c) && c != '\t' && c != '\r'; })) {
      throw InputError("--config", name, fmt::format("line {} is no text", number),
                       "give the path of a configuration file");
    }
    // Not parsed again and again under a long header.
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    std::istringstream lines(fmt::format("{}\n{}", header, line));
    std::vector<po::option> options;
    try {
      constexpr bool allow_unregistered = true;
      options = po::parse_config_file(lines, po::options_description(), allow_unregistered).options;
    } catch (const po::error&) {
      throw InputError("--config", name,
                       fmt::format("line {}, '{}', must be [section], key = value or # comment",
                                   number, one_line(trimmed(line))));
    }
    if (options.empty()) {
      if (trimmed(line).starts_with('[')) header = line;
      continue;
    }
    const std::string& key = options.front().string_key;
    const std::string& value = options.front().value.front();
    const auto [first, is_new] = line_of.emplace(key, number);
    if (!is_new) {
      throw InputError(one_line(key), one_line(value),
                       fmt::format("set twice in {}, lines {} and {}", name, first->second, number),
                       "keep one of them");
    }
    set(key, value, fmt::format("in {}, line {}", name, number));
  }
}

void Configuration::set(std::string_view key, std::string_view value, std::string_view source) {
  value = trimmed(value);
  const std::string shown = one_line(value);
  const auto row = std::ranges::find(configuration_keys(), key, &ConfigurationKey::name);
  if (row == configuration_keys().end()) {
    std::vector<std::string> names;
    for (const ConfigurationKey& known : configuration_keys()) names.push_back(known.name);
    const std::string shown_key = one_line(key);
    throw InputError(shown_key, shown,
                     fmt::format("unknown key {}{}", source,
                                 suggestion(shown_key, names, "; nlcwfs manual lists all keys")));
  }
  if (value.empty() || !row->accepts(value)) {
    const std::string fault = fault_of(*row, value);
    throw InputError(
        key, shown,
        fmt::format("{}{}{} ({})", row->allowed(), fault.empty() ? "" : "; ", fault, source));
  }
  if (const std::string repeated = repeated_part(*row, value); !repeated.empty()) {
    throw InputError(key, shown,
                     fmt::format("each value once, but {} is twice ({})", repeated, source));
  }
  if (std::ranges::count(seeing_measures, key) > 0) {
    for (const std::string_view other : seeing_measures) {
      if (other == key || !is_set(other)) continue;
      Value& rival = values_.at(index_of(other));
      if (layer_of(rival.source) == layer_of(source)) {
        throw InputError(
            key, shown,
            fmt::format("set only one of {} ({} is set to {} {})", fmt::join(seeing_measures, ", "),
                        other, rival.text, rival.source));
      }
      rival.text.clear();
    }
  }
  values_.at(index_of(key)) = {std::string(value), std::string(source)};
}

const std::string& Configuration::text_of(std::string_view key, [[maybe_unused]] Kind kind) const {
  assert(configuration_keys().at(index_of(key)).kind == kind);
  note_read(key);
  return value_text(key);
}

double Configuration::number(std::string_view key) const {
  return parse_number(text_of(key, Kind::number)).value();
}

std::vector<double> Configuration::numbers(std::string_view key) const {
  return parse_numbers(text_of(key, Kind::number_list)).value();
}

std::optional<double> Configuration::optional_number(std::string_view key) const {
  return parse_number(text_of(key, Kind::number));
}

int Configuration::integer(std::string_view key) const {
  return parse_integer(text_of(key, Kind::integer)).value();
}

std::uint64_t Configuration::seed(std::string_view key) const {
  return parse_seed(text_of(key, Kind::seed)).value();
}

double Configuration::length(std::string_view key) const {
  return parse_length(text_of(key, Kind::length)).value();
}

std::optional<double> Configuration::optional_length(std::string_view key) const {
  return parse_length(text_of(key, Kind::length));
}

std::vector<double> Configuration::lengths(std::string_view key) const {
  return parse_lengths(text_of(key, Kind::length_list)).value();
}

std::vector<Band> Configuration::bands(std::string_view key) const {
  return parse_bands(text_of(key, Kind::bands)).value_or(std::vector<Band>{});
}

std::optional<Domain> Configuration::domain(std::string_view key) const {
  return parse_domain(text_of(key, Kind::domain), key_named(key).element_parser());
}

std::optional<std::vector<double>> Configuration::axis(std::string_view key) const {
  return parse_axis(text_of(key, Kind::axis), key_named(key).element_parser());
}

std::vector<VisitingOrder> Configuration::orders(std::string_view key) const {
  return parse_orders(text_of(key, Kind::orders)).value_or(std::vector<VisitingOrder>{});
}

std::optional<double> Configuration::optional_time(std::string_view key) const {
  return parse_time(text_of(key, Kind::time));
}

std::pair<double, double> Configuration::ramp(std::string_view key) const {
  return parse_ramp(text_of(key, Kind::ramp)).value();
}

const std::string& Configuration::choice(std::string_view key) const {
  return text_of(key, Kind::choice);
}

const std::string& Configuration::text(std::string_view key) const {
  return text_of(key, Kind::text);
}

void Configuration::note_read(std::string_view key) const {
  if (reads_ == nullptr) return;
  static std::mutex lock;
  const std::scoped_lock held(lock);
  reads_->emplace(key);
}

bool Configuration::is_set(std::string_view key) const {
  note_read(key);
  return !value_text(key).empty();
}

const std::string& Configuration::source(std::string_view key) const {
  return values_.at(index_of(key)).source;
}

const std::string& Configuration::value_text(std::string_view key) const {
  return values_.at(index_of(key)).text;
}

std::string Configuration::dump() const {
  std::string text =
      "# nlcwfs configuration. A length or time may have a unit; without one it is in m or s.\n";
  std::string_view current_section;
  for (const ConfigurationKey& key : configuration_keys()) {
    const auto [section, name] = section_and_name(key);
    if (section != current_section) text += fmt::format("\n[{}]\n", section);
    current_section = section;
    text += fmt::format("# {}\n# ", key.description);
    if (!key.unit_text().empty()) text += fmt::format("Unit: {}. ", key.unit_text());
    text += fmt::format("Allowed: {}. Default: {}.\n", key.allowed(),
                        key.default_text.empty() ? "not set" : key.default_text);
    const std::string& value = value_text(key.name);
    text += value.empty() ? fmt::format("# {} =\n", name) : fmt::format("{} = {}\n", name, value);
  }
  return text;
}

bool Configuration::operator==(const Configuration& other) const {
  return std::ranges::equal(values_, other.values_, {}, &Value::text, &Value::text);
}

}  // namespace nlcwfs
