// CSV is written and read.
#include "results/tables/csv_table.hpp"

#include "results/tables/text_file.hpp"

#include <algorithm>
#include <stdexcept>

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

CsvTable& CsvTable::add(const std::optional<double>& value) {
  return value ? add(*value) : add("");
}

namespace {

/// The cells of the next line; none at the end of the text.
std::vector<std::string> next_line(std::string_view& text) {
  std::vector<std::string> cells;
  if (text.empty()) return cells;
  cells.emplace_back();
  bool is_quoted = false;
  std::size_t at = 0;
  for (; at < text.size() && (is_quoted || text[at] != '\n'); ++at) {
    const char character = text[at];
    if (character == '"') {
      // A quote within quotes is doubled.
      if (is_quoted && text.substr(at + 1).starts_with('"')) {
        cells.back() += text[++at];
      } else {
        is_quoted = !is_quoted;
      }
    } else if (character == ',' && !is_quoted) {
      cells.emplace_back();
    } else {
      cells.back() += character;
    }
  }
  text.remove_prefix(std::min(at + 1, text.size()));
  return cells;
}

}  // namespace

std::vector<CsvRow> read_csv(const std::filesystem::path& path) {
  constexpr std::size_t most_csv = std::size_t{64} << 20U;  // as rows it takes 70 times as much
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), why));
  };
  std::string contents;
  try {
    contents = text_of_file(path, most_csv);
  } catch (const std::runtime_error& error) {
    refuse(error.what());
  }
  std::string_view rest = contents;
  const std::vector<std::string> columns = next_line(rest);
  if (columns.empty()) refuse("it is empty");
  std::vector<CsvRow> rows;
  while (!rest.empty()) {
    const std::vector<std::string> cells = next_line(rest);
    if (cells.size() != columns.size()) {
      refuse(fmt::format("line {} has {} cells, not {}", rows.size() + 2, cells.size(),
                         columns.size()));
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) rows.back()[columns[i]] = cells[i];
  }
  return rows;
}

void CsvTable::separate() {
  if (!row_is_empty_) text_ += ',';
  row_is_empty_ = false;
}

}  // namespace nlcwfs
