// The files that runs leave, and what the page does with them.
#include "results/archive/run_files.hpp"

#include <algorithm>
#include <array>
#include <fnmatch.h>

namespace nlcwfs {
std::span<const RunFile> common_files() {
  static const std::array<RunFile, 4> files{
      {{"summary.json"}, {"config.cfg"}, {"archive.sqlite"}, {"report.html"}}};
  return files;
}

std::vector<RunFile> picture_files(std::initializer_list<std::string_view> stems) {
  std::vector<RunFile> files;
  for (const std::string_view stem : stems) {
    for (const char* kind : {".svg", ".png"}) files.push_back({std::string(stem) + kind});
  }
  return files;
}

std::vector<RunFile> joined(std::initializer_list<std::vector<RunFile>> lists) {
  std::vector<RunFile> all;
  for (const std::vector<RunFile>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

bool is_named(std::string_view name, std::span<const RunFile> files) {
  const std::string text(name);
  return std::ranges::any_of(files, [&](const RunFile& file) {
    return fnmatch(file.name.c_str(), text.c_str(), FNM_NOESCAPE) == 0;
  });
}

bool is_result(std::string_view name, std::span<const RunFile> files) {
  if (name == "config.cfg" || name == "archive.sqlite") return false;
  const auto is_whole = [&](std::string_view whole) {
    return is_named(whole, common_files()) || is_named(whole, files);
  };
  if (is_whole(name)) return true;
  // What was not finished, and what gnuplot was given for a picture.
  constexpr std::string_view part = ".part";
  if (!name.ends_with(part)) return false;
  name.remove_suffix(part.size());
  if (is_whole(name)) return true;
  const auto dot = name.rfind('.');
  const std::array<std::string_view, 3> of_pictures{".data", ".gnuplot", ".log"};
  return dot != std::string_view::npos && std::ranges::count(of_pictures, name.substr(dot)) > 0 &&
         is_whole(std::string(name.substr(0, dot)) + ".svg");
}

}  // namespace nlcwfs
