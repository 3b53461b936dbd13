#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// A table as comma-separated values (RFC 4180, lines end with \n): a header whose column names end
/// with their units, then rows of numbers and words.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);

  /// Starts the next row.
  CsvTable& row();
  CsvTable& add(double value);  ///< the shortest digits that read back as the same number
  CsvTable& add(std::string_view text);

  std::string text() const { return text_ + '\n'; }

 private:
  void separate();

  std::string text_;  ///< without the end of the last line
  bool row_is_empty_ = true;
};

}  // namespace nlcwfs
