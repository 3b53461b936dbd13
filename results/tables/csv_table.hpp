// CSV is written and read.
#pragma once

#include "model/statistics.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// A table as comma-separated values (RFC 4180, lines end with \n): a header whose column names end
/// with their units, then rows of numbers and words.
class CsvTable {
 public:
  /// Begins with the header.
  explicit CsvTable(const std::vector<std::string>& columns);

  /// Starts the next row.
  CsvTable& row();
  CsvTable& add(double value);  ///< the shortest digits that read back as the same number
  /// Quoted where it must be.
  CsvTable& add(std::string_view text);
  /// An empty cell where there is none.
  CsvTable& add(const std::optional<double>& value);
  /// Two cells: the mean and its standard error.
  CsvTable& add(const MeanAndError& value) { return add(value.mean).add(value.standard_error); }

  /// The table as a file has it.
  std::string text() const { return text_ + '\n'; }

 private:
  void separate();

  std::string text_;  ///< without the end of the last line
  bool row_is_empty_ = true;
};

/// A line of such a table: the cells by the names of their columns.
using CsvRow = std::map<std::string, std::string>;

/// Reads a table that CsvTable has written.
/// @throws std::runtime_error with the path where it cannot be read or a line has not as many cells
///         as the header
std::vector<CsvRow> read_csv(const std::filesystem::path& path);

}  // namespace nlcwfs
