// Whole text files are read, of bounded size.
#include "results/tables/text_file.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {

std::string text_of_file(const std::filesystem::path& path, std::size_t most) {
  std::error_code failure;
  const bool is_file = std::filesystem::is_regular_file(path, failure);
  if (failure) throw std::runtime_error(failure.message());
  // A pipe or a device may never end.
  if (!is_file) throw std::runtime_error("it is no regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(std::generic_category().message(errno));
  const auto size = std::filesystem::file_size(path, failure);
  if (failure) throw std::runtime_error(failure.message());
  if (size > most) {
    throw std::runtime_error(fmt::format("it has {:.3g} MiB, and {:.3g} MiB are allowed",
                                         double(size) / (1U << 20U), double(most) / (1U << 20U)));
  }
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw std::runtime_error("reading failed");
  return text;
}

}  // namespace nlcwfs
