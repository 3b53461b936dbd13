#include "results/csv_table.hpp"

#include <fmt/format.h>

namespace nlcwfs {

CsvTable::CsvTable(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) add(column);
}

CsvTable& CsvTable::row() {
  text_ += '\n';
  row_is_empty_ = true;
  return *this;
}

CsvTable& CsvTable::add(double value) {
  separate();
  text_ += fmt::format("{}", value);
  return *this;
}

CsvTable& CsvTable::add(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char character : text) {
    if (character == '"') text_ += '"';
    text_ += character;
  }
  text_ += '"';
  return *this;
}

void CsvTable::separate() {
  if (!row_is_empty_) text_ += ',';
  row_is_empty_ = false;
}

}  // namespace nlcwfs
