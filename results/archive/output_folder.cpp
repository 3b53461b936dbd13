// A run's folder is made, written to and cleared, and nothing is overwritten.
#include "results/archive/output_folder.hpp"

#include "model/input_error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Makes a folder and its parents; false where the name is taken, also if another run makes it at
/// the same moment.
bool make_folder(const std::filesystem::path& folder) {
  const auto check = [&](const std::error_code& failure) {
    if (!failure) return;
    throw InputError("--output", folder.string(),
                     fmt::format("cannot be made ({})", failure.message()),
                     "name a folder where you may write");
  };
  std::error_code failure;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), failure);
  check(failure);
  const bool made = std::filesystem::create_directory(folder, failure);
  if (failure != std::errc::file_exists) check(failure);
  return made;
}

/// Waits until what was written is on disk: a file's text, or the names in a folder. Nothing of a
/// run's is what it cannot open.
/// @return false where it cannot be
bool sync_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return true;
  const int result = fsync(file);
  const int error = errno;
  close(file);
  errno = error;
  return result == 0;
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

[[noreturn]] void refuse(const std::filesystem::path& requested) {
  throw InputError("--output", requested.string(), "exists",
                   "name a folder that does not, nothing is ever overwritten");
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

void OutputFolder::remove_results(std::span<const RunFile> files) const {
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    if (!entry.is_directory() && is_result(entry.path().filename().string(), files)) {
      std::filesystem::remove(entry.path());
    }
  }
}

void OutputFolder::sync() const {
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(entry.symlink_status(ignored))) continue;
    if (!sync_to_disk(entry.path())) fail_to_write(entry.path());
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
  // Before the name is there: a power cut leaves no file of it that is empty or cut.
  if (!stream || !sync_to_disk(partial)) fail_to_write(partial);
  std::filesystem::rename(partial, target);
  sync_to_disk(path_);  // where the file system can
}

}  // namespace nlcwfs
