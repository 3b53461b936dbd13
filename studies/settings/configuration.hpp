// Values of keys, layer upon layer: defaults, preset, files, command line.
#pragma once

#include "model/light_source.hpp"
#include "objectives/design_space.hpp"
#include "studies/settings/configuration_key.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

/// A value for every key, with where it came from. A later value replaces an earlier one, so the
/// layers are applied from the weakest to the strongest: defaults, preset, files, command line.
/// Values are checked as they are set; what holds between keys is the physics' business, except
/// that exactly one of seeing.d_over_r0, seeing.fried_parameter and seeing.fwhm is set at any time:
/// setting one unsets another that an earlier layer has set.
///
/// Two configurations are equal if their values are, wherever they came from.
/// Asking for a key that the table does not have, or with the getter of another kind, is a caller's
/// bug; so is asking for the value of a key that is not set, except through the optional getters.
class Configuration {
 public:
  /// All defaults.
  Configuration();

  /// @throws InputError for a name that is not in presets()
  void apply_preset(std::string_view name);

  /// Reads an INI file: [section], key = value, and # starts a comment anywhere in a line.
  /// @throws InputError naming the file and line; values before that line are already set
  void read_file(const std::filesystem::path& path);

  /// @param source  for messages: "in my.cfg, line 3", "on the command line"
  /// @throws InputError for an unknown key, a value that is not allowed, or a second measure of the
  ///         seeing from the same file or command line
  void set(std::string_view key, std::string_view value, std::string_view source);

  /// Of a key of Kind::number.
  double number(std::string_view key) const;
  /// Of a key of Kind::number_list.
  std::vector<double> numbers(std::string_view key) const;
  /// Nothing where not set.
  std::optional<double> optional_number(std::string_view key) const;
  /// Of a key of Kind::integer.
  int integer(std::string_view key) const;
  /// Of a key of Kind::seed.
  std::uint64_t seed(std::string_view key) const;
  /// m
  double length(std::string_view key) const;
  /// m, or nothing where not set
  std::optional<double> optional_length(std::string_view key) const;
  /// m
  std::vector<double> lengths(std::string_view key) const;
  /// Empty where not set.
  std::vector<Band> bands(std::string_view key) const;
  /// In SI, or nothing where not set.
  std::optional<Domain> domain(std::string_view key) const;
  /// In SI, or nothing where not set.
  std::optional<std::vector<double>> axis(std::string_view key) const;
  /// Empty for all, or where not set.
  std::vector<VisitingOrder> orders(std::string_view key) const;
  /// s, or nothing where not set
  std::optional<double> optional_time(std::string_view key) const;
  /// {start, end}, equal for a single number
  std::pair<double, double> ramp(std::string_view key) const;
  /// One of the key's choices.
  const std::string& choice(std::string_view key) const;
  /// As written; empty where not set.
  const std::string& text(std::string_view key) const;

  /// Whether the key has a value, its default or another.
  bool is_set(std::string_view key) const;
  /// "by default", "by --preset paper", "in my.cfg, line 3", "on the command line", ...
  const std::string& source(std::string_view key) const;
  /// The value as written, of any kind; empty where not set. For messages about values.
  const std::string& value_text(std::string_view key) const;

  /// Adds every key whose meaning is asked for from now on, here or in a copy, to a set: what a
  /// command reads. What only repeats values (value_text, source, dump) does not count.
  /// @param reads  outlives this configuration and its copies; not safe from several threads
  void note_reads_in(std::set<std::string, std::less<>>& reads) { reads_ = &reads; }

  /// Every key with its documentation and value, as a file for read_file that gives an equal
  /// configuration. Keys that are not set stand in a comment.
  std::string dump() const;

  /// Whether every key has the same text.
  bool operator==(const Configuration& other) const;

 private:
  struct Value {
    std::string text;
    std::string source;
  };
  const std::string& text_of(std::string_view key, Kind kind) const;
  void note_read(std::string_view key) const;

  std::vector<Value> values_;  // in the order of configuration_keys()
  std::set<std::string, std::less<>>* reads_ = nullptr;
};

}  // namespace nlcwfs
