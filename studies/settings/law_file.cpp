// Scaling laws are read from files, and written.
#include "studies/settings/law_file.hpp"

#include "model/input_error.hpp"
#include "results/tables/design_summary.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// What the configuration gives as the source of a file's conditions.
constexpr std::string_view conditions_source = "among the conditions";

/// A value of a file with its name there, such as `data[2].d_over_r0`.
struct JsonField {
  std::string name;
  const Json& json;

  [[noreturn]] void refuse(std::string_view allowed) const {
    throw InputError(name, one_line(json.dump()), allowed);
  }

  /// Demands an object with no other members.
  const JsonField& with_members(const std::vector<std::string_view>& members) const {
    const std::string allowed = fmt::format("an object with {}", fmt::join(members, ", "));
    if (!json.is_object()) refuse(allowed);
    for (const auto& item : json.items()) {
      if (std::ranges::count(members, item.key()) == 0) {
        throw InputError(member_name(one_line(item.key())), one_line(item.value().dump()),
                         "unknown; " + allowed);
      }
    }
    return *this;
  }

  JsonField operator[](std::string_view member) const {
    const auto found = json.find(member);
    if (found == json.end()) throw InputError(member_name(member), one_line(""), "is missing");
    return {member_name(member), *found};
  }

  /// Demands a list, of `size` elements unless that is 0.
  std::vector<JsonField> elements(std::size_t size = 0) const {
    if (!json.is_array() || (size != 0 && json.size() != size)) {
      refuse(size == 0 ? "a list" : fmt::format("a list of {}", size));
    }
    std::vector<JsonField> fields;
    for (const Json& element : json) {
      fields.push_back({fmt::format("{}[{}]", name, fields.size()), element});
    }
    return fields;
  }

  double number() const {
    if (!json.is_number()) refuse("a number");
    return json.get<double>();
  }

  int integer() const {
    if (!json.is_number_integer() || json != json.get<int>()) refuse("a whole number");
    return json.get<int>();
  }

  std::string text() const {
    if (!json.is_string()) refuse("text in quotes");
    return json.get<std::string>();
  }

 private:
  std::string member_name(std::string_view member) const {
    return name.empty() ? std::string(member) : fmt::format("{}.{}", name, member);
  }
};

/// `first` and the name of every quantity.
std::vector<std::string_view> quantities_and(std::vector<std::string_view> first) {
  for (const ScalingQuantity& quantity : scaling_quantities()) first.push_back(quantity.name);
  return first;
}

Configuration conditions_of(const JsonField& field) {
  if (!field.json.is_object()) field.refuse("an object of configuration keys and their values");
  Configuration conditions;
  for (const auto& item : field.json.items()) {
    const JsonField value{fmt::format("{}.{}", field.name, one_line(item.key())), item.value()};
    conditions.set(item.key(), value.text(), conditions_source);
  }
  return conditions;
}

ScalingDatum datum_of(const JsonField& field) {
  field.with_members(quantities_and({"d_over_r0"}));
  ScalingDatum datum;
  datum.d_over_r0 = field["d_over_r0"].number();
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    const JsonField value = field[quantity.name].with_members({"mean", "standard_error"});
    datum.*quantity.datum = {value["mean"].number(), value["standard_error"].number()};
  }
  return datum;
}

LawLine line_of(const JsonField& field) {
  field.with_members({"intercept", "slope", "covariance", "scatter"});
  LawLine line{.intercept = field["intercept"].number(),
               .slope = field["slope"].number(),
               .covariance = {},
               .scatter = field["scatter"].number()};
  if (!(line.scatter >= 0.0)) field["scatter"].refuse("at least 0");
  const JsonField covariance = field["covariance"];
  Eigen::Index row = 0;
  for (const JsonField& values : covariance.elements(2)) {
    const std::vector<JsonField> columns = values.elements(2);
    line.covariance.row(row++) << columns[0].number(), columns[1].number();
  }
  const Eigen::Matrix2d& matrix = line.covariance;
  if (!(matrix(0, 0) >= 0.0 && matrix(1, 1) >= 0.0 && matrix(0, 1) == matrix(1, 0) &&
        matrix(0, 1) * matrix(0, 1) <= matrix(0, 0) * matrix(1, 1))) {
    covariance.refuse("[[a, b], [b, c]], with a and c at least 0 and b^2 at most a c");
  }
  return line;
}

std::array<int, 4> order_of(const JsonField& field) {
  std::vector<int> order;
  for (const JsonField& plane : field.elements()) order.push_back(plane.integer());
  validate_order(order);
  return {order[0], order[1], order[2], order[3]};
}

/// Replaces what was fitted by the file's own lines and range.
void read_lines(const JsonField& field, ScalingLaw& law) {
  law.least_d_over_r0 = field["least_d_over_r0"].number();
  law.greatest_d_over_r0 = field["greatest_d_over_r0"].number();
  if (!(law.least_d_over_r0 > 0.0)) field["least_d_over_r0"].refuse("above 0");
  if (!(law.greatest_d_over_r0 > law.least_d_over_r0)) {
    field["greatest_d_over_r0"].refuse("above least_d_over_r0");
  }
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    const LawLine& line = law.*quantity.line = line_of(field[quantity.name]);
    for (const double end : {law.least_d_over_r0, law.greatest_d_over_r0}) {
      const auto [mean, standard_error] = line.predict(end);
      if (!(mean > 0.0 && std::isfinite(mean) && std::isfinite(standard_error))) {
        field[quantity.name].refuse(fmt::format(
            "a line with values above 0, but its value at D/r0 = {:g} is {}", end, mean));
      }
    }
  }
}

LawFile law_file_of(const Json& json) {
  const JsonField root{"", json};
  root.with_members({"conditions", "data", "law"});
  LawFile file;
  file.conditions = conditions_of(root["conditions"]);
  for (const JsonField& datum : root["data"].elements()) file.data.push_back(datum_of(datum));
  const JsonField law =
      root["law"].with_members(quantities_and({"order", "least_d_over_r0", "greatest_d_over_r0"}));
  file.law = fit_scaling_law(file.data, order_of(law["order"]));
  if (law.json.size() > 1) read_lines(law, file.law);
  return file;
}

}  // namespace

Json to_json(const ScalingLaw& law) {
  Json json{{"order", law.order},
            {"least_d_over_r0", law.least_d_over_r0},
            {"greatest_d_over_r0", law.greatest_d_over_r0}};
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    const LawLine& line = law.*quantity.line;
    const Eigen::Matrix2d& matrix = line.covariance;
    json[std::string(quantity.name)] = {
        {"intercept", line.intercept},
        {"slope", line.slope},
        {"covariance", {{matrix(0, 0), matrix(0, 1)}, {matrix(1, 0), matrix(1, 1)}}},
        {"scatter", line.scatter}};
  }
  return json;
}

Configuration law_conditions(const Configuration& configuration) {
  Configuration conditions;
  for (const ConfigurationKey& key : configuration_keys()) {
    const std::string_view section = std::string_view(key.name).substr(0, key.name.find('.'));
    constexpr std::array searched{"telescope", "source",         "screens",
                                  "detector",  "reconstruction", "simulation",
                                  "objective", "search",         "verify"};
    const bool counts =
        std::ranges::count(searched, section) != 0 || key.name == "seeing.outer_scale";
    if (!counts || !configuration.is_set(key.name)) continue;
    conditions.set(key.name, configuration.value_text(key.name), conditions_source);
  }
  return conditions;
}

Json to_json(const LawFile& file) {
  Json conditions = Json::object();
  for (const ConfigurationKey& key : configuration_keys()) {
    if (file.conditions.source(key.name) != conditions_source) continue;
    conditions[key.name] = file.conditions.value_text(key.name);
  }
  Json data = Json::array();
  for (const ScalingDatum& datum : file.data) {
    Json& row = data.emplace_back(Json{{"d_over_r0", datum.d_over_r0}});
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      row[std::string(quantity.name)] = to_json(datum.*quantity.datum);
    }
  }
  return {{"conditions", conditions}, {"data", data}, {"law", to_json(file.law)}};
}

LawFile parse_law_file(std::string_view text, const std::string& name) {
  const Json json = json_of(text);
  if (!json.is_object() || !(json.contains("conditions") || json.contains("data"))) {
    throw InputError("advise.law", one_line(name), "is no law file",
                     "give the law.json that a run of law or advise left");
  }
  try {
    return law_file_of(json);
  } catch (const InputError& error) {
    throw InputError("advise.law", one_line(name), error.what());
  }
}

LawFile read_law_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError("advise.law", one_line(path.string()), "a directory",
                     "give a law file's path");
  }
  std::string text;
  try {
    text = text_of_file(path);
  } catch (const std::runtime_error& error) {
    throw InputError("advise.law", one_line(path.string()),
                     fmt::format("cannot be read ({})", error.what()),
                     "give the path of a law file");
  }
  return parse_law_file(text, path.string());
}

}  // namespace nlcwfs
