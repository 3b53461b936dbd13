#pragma once

#include "model/array.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nlcwfs {

/// Square images of one size, such as phase screens.
struct FitsCube {
  std::string unit;  ///< BUNIT as the file has it; empty where it has none
  std::vector<Image<double>>
      slices;  ///< FITS axis 1 = column (x), axis 2 = row (y), axis 3 = slice
};

/// A card of a FITS header.
struct FitsKeyword {
  std::string name;
  std::variant<std::string, double, std::uint64_t> value;
  std::string comment;
};

/// Reads the image of a file's first HDU: n x n x count, or n x n, which is one slice. The path is
/// taken literally, without CFITSIO's extended file name syntax.
/// @param key  the configuration key that named the file, for the error
/// @throws InputError where the file is missing or unreadable, or its image has another shape or
///         values that are not finite
FitsCube read_fits_cube(const std::filesystem::path& path, std::string_view key);

/// Writes n x n x count 64-bit floating-point values with BUNIT and `keywords` in the header. Until
/// it is complete the file has the name `path` with `.part` appended; an existing file is never
/// overwritten. The path is taken literally.
/// @pre at least one slice, all square and of one size, not empty
/// @throws std::runtime_error with the path and the cause where the file exists or cannot be
/// written
void write_fits_cube(const std::filesystem::path& path, const FitsCube& cube,
                     const std::vector<FitsKeyword>& keywords = {});

}  // namespace nlcwfs
