#include "results/output_folder.hpp"

#include "model/input_error.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Makes a folder and its parents; false where the name is taken, also if another run makes it at
/// the same moment.
bool make_folder(const std::filesystem::path& folder) {
  const auto check = [&](const std::error_code& failure) {
    if (!failure) return;
    throw InputError(
        "--output", folder.string(),
        fmt::format("cannot be made ({}); name a folder where you may write", failure.message()));
  };
  std::error_code failure;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), failure);
  check(failure);
  const bool made = std::filesystem::create_directory(folder, failure);
  if (failure != std::errc::file_exists) check(failure);
  return made;
}

[[noreturn]] void refuse(const std::filesystem::path& requested) {
  throw InputError("--output", requested.string(),
                   "exists; name a folder that does not, nothing is ever overwritten");
}

}  // namespace

OutputFolder::OutputFolder(const std::optional<std::filesystem::path>& requested,
                           std::string_view command) {
  if (requested) {
    // Without the slash that may end it, whose parent would be the folder itself.
    path_ = requested->has_filename() ? *requested : requested->parent_path();
    if (!make_folder(path_)) refuse(path_);
    return;
  }
  int number = 1;
  do {
    path_ = std::filesystem::path("results") / fmt::format("{}-{}", command, number++);
  } while (!make_folder(path_));
}

void OutputFolder::require_free(const std::filesystem::path& requested) {
  if (std::filesystem::exists(std::filesystem::symlink_status(requested))) {
    refuse(requested);
  }
}

OutputFolder OutputFolder::of_earlier_run(const std::filesystem::path& path) {
  OutputFolder folder;
  folder.path_ = path;
  return folder;
}

void OutputFolder::remove_results_except(const std::set<std::string, std::less<>>& kept) const {
  static const std::set<std::filesystem::path> endings{".cfg",  ".csv",  ".fits", ".html",
                                                       ".json", ".part", ".png",  ".svg"};
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    if (!entry.is_directory() && endings.contains(entry.path().extension()) &&
        !kept.contains(entry.path().filename().string())) {
      std::filesystem::remove(entry.path());
    }
  }
}

void OutputFolder::write(std::string_view name, std::string_view text) const {
  const std::filesystem::path target = file(name);
  std::filesystem::path partial = target;
  partial += ".part";
  std::filesystem::remove(partial);  // never written through a link
  std::ofstream stream(partial, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", partial.string(), std::strerror(errno)));
  }
  std::filesystem::rename(partial, target);
}

}  // namespace nlcwfs
