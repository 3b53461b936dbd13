// A binary table is written as FITS.
#include "results/fits/fits_table.hpp"

#include "results/fits/fits_file.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// The texts of a column; empty ones for empty cells.
std::vector<std::string> texts_of(const TableColumn& column) {
  std::vector<std::string> texts;
  for (const TableCell& cell : column.cells) {
    texts.push_back(cell_text(cell));
    std::ranges::replace_if(
        texts.back(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }
  return texts;
}

std::vector<double> numbers_of(const TableColumn& column) {
  std::vector<double> numbers;
  for (const TableCell& cell : column.cells) {
    const auto* number = std::get_if<double>(&cell);
    numbers.push_back(number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN());
  }
  return numbers;
}

/// CFITSIO's interface takes texts and numbers as mutable, but only reads them.
char* mutable_text(const std::string& text) {
  return const_cast<char*>(text.c_str());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

template <class Texts>
std::vector<char*> mutable_texts(const Texts& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(mutable_text(text));
  return pointers;
}

void write_table(fitsfile* file, const FlatTable& table, const std::string& name) {
  std::vector<std::string> names;
  std::vector<std::string> forms;
  std::vector<std::string> units;
  for (const TableColumn& column : table.columns) {
    std::size_t width = 1;
    if (column.is_text()) {
      for (const std::string& text : texts_of(column)) width = std::max(width, text.size());
    }
    names.push_back(column.name);
    forms.push_back(column.is_text() ? fmt::format("{}A", width) : "D");
    units.push_back(column.unit);
  }
  int status = 0;
  fits_create_tbl(file, BINARY_TBL, static_cast<LONGLONG>(table.rows),
                  static_cast<int>(names.size()), mutable_texts(names).data(),
                  mutable_texts(forms).data(), mutable_texts(units).data(), name.c_str(), &status);
  check_fits(status);
  if (table.rows == 0) return;
  const auto rows = static_cast<LONGLONG>(table.rows);
  int number = 0;
  for (const TableColumn& column : table.columns) {
    ++number;
    if (column.is_text()) {
      const std::vector<std::string> texts = texts_of(column);
      fits_write_col_str(file, number, 1, 1, rows, mutable_texts(texts).data(), &status);
    } else {
      std::vector<double> numbers = numbers_of(column);
      fits_write_col_dbl(file, number, 1, 1, rows, numbers.data(), &status);
    }
    check_fits(status);
  }
}

}  // namespace

void write_fits_table(const std::filesystem::path& path, const FlatTable& table,
                      const std::string& name) {
  write_new_fits_file(path, [&](fitsfile* file) { write_table(file, table, name); });
}

}  // namespace nlcwfs
