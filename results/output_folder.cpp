#include "results/output_folder.hpp"

#include "model/input_error.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {

OutputFolder::OutputFolder(const std::optional<std::filesystem::path>& requested,
                           std::string_view command) {
  const auto make_parents = [](const std::filesystem::path& path) {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  };
  try {
    if (requested) {
      path_ = *requested;
      make_parents(path_);
      // Fails where the folder exists, also if another run makes it at the same moment.
      if (!std::filesystem::create_directory(path_)) require_free(path_);
      return;
    }
    for (int number = 1;; ++number) {
      path_ = std::filesystem::path("results") / fmt::format("{}-{}", command, number);
      make_parents(path_);
      if (std::filesystem::create_directory(path_)) return;
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw std::runtime_error(fmt::format("cannot make the output folder {}: {}", path_.string(),
                                         error.code().message()));
  }
}

void OutputFolder::require_free(const std::filesystem::path& requested) {
  if (std::filesystem::exists(std::filesystem::symlink_status(requested))) {
    throw InputError("--output", requested.string(),
                     "exists; name a folder that does not, nothing is ever overwritten");
  }
}

void OutputFolder::write(std::string_view name, std::string_view text) const {
  const std::filesystem::path target = file(name);
  std::filesystem::path partial = target;
  partial += ".part";
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
