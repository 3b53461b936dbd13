// An archive becomes flat tables.
#include "results/tables/evaluation_table.hpp"

#include "model/bound_text.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/json_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// The unit that a member's name ends with.
std::string unit_in(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> endings{
      {{"_nm", "nm"}, {"_m", "m"}, {"_s", "s"}, {"seconds", "s"}}};
  for (const auto& [ending, unit] : endings) {
    if (name.ends_with(ending)) return std::string(unit);
  }
  return "";
}

class FlatTableBuilder {
 public:
  /// @param names  of the columns that there are in any case
  explicit FlatTableBuilder(const std::vector<std::string>& names) {
    for (const std::string& name : names) column(name, unit_in(name));
  }

  void start_row() {
    ++table_.rows;
    require_memory();
  }

  /// Sets what is in a JSON value, by the names of its members.
  void set_all(const std::string& name, const std::string& unit, const Json& value) {
    if (value.is_object()) {
      for (const auto& [member, element] : value.items()) {
        if (member == "mean" || member == "metrics" || member == "performance") {
          set_all(name, unit, element);
          continue;
        }
        const std::string own_unit = unit_in(member);
        set_all(name.empty() ? member : fmt::format("{}_{}", name, member),
                own_unit.empty() ? unit : own_unit, element);
      }
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        set_all(fmt::format("{}_{}", name, i + 1), unit, value[i]);
      }
    } else if (value.is_string()) {
      set(name, unit, value.get<std::string>());
    } else if (value.is_number()) {
      set(name, unit, value.get<double>());
    } else if (value.is_boolean()) {
      set(name, unit, value.get<bool>() ? 1.0 : 0.0);
    }
  }

  FlatTable finished() && {
    for (TableColumn& column : table_.columns) column.cells.resize(table_.rows);
    return std::move(table_);
  }

 private:
  TableColumn& column(const std::string& name, const std::string& unit) {
    const auto [place, is_new] = places_.try_emplace(name, table_.columns.size());
    if (is_new) {
      table_.columns.push_back({name, unit, {}});
      require_memory();
    }
    return table_.columns[place->second];
  }

  /// Every column has a cell in every row.
  void require_memory() const {
    const double bytes = double(table_.rows) * double(table_.columns.size()) * sizeof(TableCell);
    if (bytes <= max_image_memory) return;
    throw std::runtime_error(fmt::format("a table of {} evaluations with {} columns takes {}",
                                         table_.rows, table_.columns.size(), memory_text(bytes)));
  }

  /// Of two values of one name the first counts: a sweep has some of a performance's metrics twice.
  void set(const std::string& name, const std::string& unit, TableCell value) {
    std::vector<TableCell>& cells = column(name, unit).cells;
    if (cells.size() == table_.rows) return;
    cells.resize(table_.rows - 1);
    cells.push_back(std::move(value));
  }

  FlatTable table_;
  std::map<std::string, std::size_t> places_;
};

/// @param what  "design" or "performance"
Json object_of(const std::string& text, std::string_view what, std::size_t number) {
  Json object = json_of(text);
  if (!object.is_object()) {
    throw std::runtime_error(
        fmt::format("the {} of evaluation {} is no JSON object", what, number));
  }
  return object;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

}  // namespace

std::string cell_text(const TableCell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : *text;
}

bool TableColumn::is_text() const {
  return std::ranges::any_of(
      cells, [](const TableCell& cell) { return std::holds_alternative<std::string>(cell); });
}

std::string FlatTable::csv() const {
  std::vector<std::string> names;
  for (const TableColumn& column : columns) names.push_back(column.name);
  CsvTable table(names);
  for (std::size_t row = 0; row < rows; ++row) {
    table.row();
    for (const TableColumn& column : columns) table.add(cell_text(column.cells[row]));
  }
  return table.text();
}

Json evaluation_list(const std::vector<ArchivedEvaluation>& evaluations) {
  Json list = Json::array();
  for (const ArchivedEvaluation& evaluation : evaluations) {
    const std::size_t number = list.size() + 1;
    Json row{{"evaluation", number},
             {"stage", evaluation.stage},
             {"key", text_or_null(evaluation.key)},
             {"cost", std::isfinite(evaluation.cost) ? Json(evaluation.cost) : Json(nullptr)},
             {"failure", text_or_null(evaluation.failure)},
             {"seconds", evaluation.seconds}};
    // What the row has itself stands.
    const Json design = object_of(evaluation.design, "design", number);
    for (const auto& [name, value] : design.items()) {
      if (!row.contains(name)) row[name] = value;
    }
    row["performance"] = evaluation.performance.empty()
                             ? Json(nullptr)
                             : object_of(evaluation.performance, "performance", number);
    list.push_back(std::move(row));
  }
  return list;
}

FlatTable evaluation_table(const Json& list) {
  FlatTableBuilder table({"evaluation", "stage", "key", "cost", "failure", "seconds"});
  for (const Json& evaluation : list) {
    table.start_row();
    table.set_all("", "", evaluation);
  }
  return std::move(table).finished();
}

}  // namespace nlcwfs
