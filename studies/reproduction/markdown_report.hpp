// report.md while it is made, and the pictures and tables beside it.
#pragma once

#include "results/archive/output_folder.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/pictures/curve_picture.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "studies/reproduction/study_setup.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

/// Cells of a Markdown table.
using Cells = std::vector<std::string>;

/// report.md and what it shows. All throw std::runtime_error with path and cause where a file
/// cannot be written.
class MarkdownReport {
 public:
  /// @param folder  of the reproduction, which outlives the report
  explicit MarkdownReport(const OutputFolder& folder) : folder_(folder) {}

  /// A paragraph or a heading.
  void add(std::string_view text) { text_.append(text).append("\n\n"); }
  /// A table.
  void add_table(const Cells& heads, const std::vector<Cells>& rows);
  /// A table of columns below the title of their set-up.
  /// @param columns  what stands below each head, all equally long
  void add_columns(StudySetup setup, const Cells& heads, const std::vector<Cells>& columns);
  /// A row with a cell of each set-up.
  void add_both(const std::function<std::string(StudySetup)>& cell);

  // These write files of a name without its extension, beside report.md; where they return a text
  // it is a cell that shows the picture.

  /// As comma-separated values.
  void write(const std::string& name, const CsvTable& table) const;
  /// As a FITS image.
  void write(const std::string& name, const FitsMap& map) const;
  /// As SVG and PNG.
  std::string draw(const std::string& name, const CurvePicture& picture);
  /// As SVG and PNG.
  std::string draw(const std::string& name, const MapPicture& picture);
  /// A picture, and a table where there is one, that a run has made.
  /// @param made  of its files: folder and name, below the reproduction's
  std::string copy(const std::string& made, const std::string& name, const std::string& title);

  /// A line for each picture that there is not, with the reason.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Writes report.md.
  void write() const { folder_.write("report.md", text_); }

 private:
  std::string shown(const std::string& name, const std::string& title,
                    const std::optional<std::string>& no_picture);

  const OutputFolder& folder_;
  std::string text_;
  std::vector<std::string> notes_;
};

}  // namespace nlcwfs
