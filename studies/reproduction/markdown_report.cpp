// report.md while it is made, and the pictures and tables beside it.
#include "studies/reproduction/markdown_report.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

std::string table_row(const Cells& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

}  // namespace

void MarkdownReport::add_table(const Cells& heads, const std::vector<Cells>& rows) {
  text_ += table_row(heads) + table_row(Cells(heads.size(), "---"));
  for (const Cells& row : rows) text_ += table_row(row);
  text_ += '\n';
}

void MarkdownReport::add_columns(StudySetup setup, const Cells& heads,
                                 const std::vector<Cells>& columns) {
  std::vector<Cells> rows(columns.front().size());
  for (const Cells& column : columns) {
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(column[row]);
  }
  add(fmt::format("*{}*", title_of(setup)));
  add_table(heads, rows);
}

void MarkdownReport::add_both(const std::function<std::string(StudySetup)>& cell) {
  Cells heads;
  Cells cells;
  for (const StudySetup setup : setups) {
    heads.emplace_back(title_of(setup));
    cells.push_back(cell(setup));
  }
  add_table(heads, {cells});
}

void MarkdownReport::write(const std::string& name, const CsvTable& table) const {
  folder_.write(name + ".csv", table.text());
}

void MarkdownReport::write(const std::string& name, const FitsMap& map) const {
  const std::filesystem::path path = folder_.file(name + ".fits");
  std::filesystem::remove(path);  // of a report that was interrupted
  write_fits_map(path, map);
}

std::string MarkdownReport::draw(const std::string& name, const CurvePicture& picture) {
  return shown(name, fmt::format("{}, {}", picture.title, picture.y_label),
               write_picture(picture, folder_.file(name)));
}

std::string MarkdownReport::draw(const std::string& name, const MapPicture& picture) {
  return shown(name, fmt::format("{}, {}", picture.title, picture.value_label),
               write_picture(picture, folder_.file(name)));
}

std::string MarkdownReport::copy(const std::string& made, const std::string& name,
                                 const std::string& title) {
  for (const char* kind : {".png", ".svg", ".csv"}) {
    const std::filesystem::path from = folder_.file(made + kind);
    if (!std::filesystem::exists(from)) continue;  // no gnuplot, or no table of its own
    std::filesystem::copy_file(from, folder_.file(name + kind),
                               std::filesystem::copy_options::overwrite_existing);
  }
  return shown(name, title, std::nullopt);
}

std::string MarkdownReport::shown(const std::string& name, const std::string& title,
                                  const std::optional<std::string>& no_picture) {
  if (no_picture) notes_.push_back(fmt::format("there is no {}.svg: {}", name, *no_picture));
  if (!std::filesystem::exists(folder_.file(name + ".png"))) return "no picture";
  return fmt::format("![{}]({}.png)", title, name);
}

}  // namespace nlcwfs
