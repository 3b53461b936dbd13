// Whole text files are read, of bounded size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace nlcwfs {

/// The most that is read of a file of JSON, bytes: as a tree it takes ten times as much memory.
inline constexpr std::size_t most_json = std::size_t{256} << 20U;

/// Reads a file that may come from anywhere.
/// @param most  bytes that it may have
/// @throws std::runtime_error with the cause, without the path: it cannot be read, is no file or is
///         too large
std::string text_of_file(const std::filesystem::path& path, std::size_t most = most_json);

}  // namespace nlcwfs
