// An archive becomes flat tables.
#pragma once

#include "results/archive/archive.hpp"

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A cell of a table: nothing, a number or a text.
using TableCell = std::variant<std::monostate, double, std::string>;

/// What a cell has as text: of a number the shortest digits that read back as the same; of nothing
/// nothing.
std::string cell_text(const TableCell& cell);

/// A column of a table, with a cell of every row.
struct TableColumn {
  std::string name;  ///< without the unit, unless the member that it is of has one
  std::string unit;  ///< as FITS writes it, such as "m"; empty where the values have none
  std::vector<TableCell> cells;  ///< one for each row

  bool is_text() const;  ///< whether a cell is
};

/// A table of columns of one length.
struct FlatTable {
  std::vector<TableColumn> columns;  ///< in the order in which they first had a value
  std::size_t rows = 0;              ///< cells of each column

  /// As a file of comma-separated values, see CsvTable.
  std::string csv() const;
};

/// An archive's evaluations as a JSON array of objects: evaluation (its number), stage, key, cost,
/// failure and seconds, then the members of the design as summaries have them, with its performance
/// as `performance`. What an evaluation does not have is null.
/// @throws std::runtime_error naming the evaluation whose design or performance is no JSON object
nlohmann::ordered_json evaluation_list(const std::vector<ArchivedEvaluation>& evaluations);

/// The same as one flat table, a row for each evaluation. A member of a list has the list's name
/// and its place from 1 (`planes_m_1`), a mean has the metric's name (`residual_wfe_nm`), its
/// standard error `_standard_error` behind that. Designs of different numbers of planes share the
/// columns; the cells that an evaluation has no value for are empty.
/// @param list  of evaluation_list()
FlatTable evaluation_table(const nlohmann::ordered_json& list);

}  // namespace nlcwfs
