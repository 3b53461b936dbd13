// The files that runs leave, and what the page does with them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What the page of a run does with one of its files.
enum class FileRole {
  hidden,  ///< nothing
  design,  ///< shows it as the configuration of the design that the run ends in
  table,   ///< has its columns
  image,   ///< has its first slices
  picture  ///< shows it as it is
};

/// A file that a run leaves in its folder.
struct RunFile {
  std::string name;                  ///< "best.cfg"; a * stands for any characters
  FileRole role = FileRole::hidden;  ///< on the page
  bool is_certain = true;            ///< whether every such run leaves it: the page misses it
};

/// What every run leaves.
std::span<const RunFile> common_files();

/// Names of pictures as they are written: .svg and .png of each stem.
std::vector<RunFile> picture_files(std::initializer_list<std::string_view> stems);

/// The lists one after the other.
std::vector<RunFile> joined(std::initializer_list<std::vector<RunFile>> lists);

/// Whether a file has a name of these.
bool is_named(std::string_view name, std::span<const RunFile> files);

/// Whether a run makes a file of this name again when it is gone on with, or has left an unfinished
/// one: all of its files but config.cfg and archive.sqlite.
/// @param files  of its command
bool is_result(std::string_view name, std::span<const RunFile> files);

}  // namespace nlcwfs
