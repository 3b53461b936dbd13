// A binary table is written as FITS.
#pragma once

#include "results/tables/evaluation_table.hpp"

#include <filesystem>
#include <string>

namespace nlcwfs {

/// Writes a binary table as the first extension of a new file: 64-bit floating-point columns, NaN
/// where a cell is empty, and columns of text, each as wide as its longest. FITS knows printable
/// ASCII alone: every other byte becomes a question mark. The path is taken literally.
/// @param name  of the table (EXTNAME)
/// @throws std::runtime_error with the path and the cause where the file exists or cannot be
/// written
void write_fits_table(const std::filesystem::path& path, const FlatTable& table,
                      const std::string& name);

}  // namespace nlcwfs
