// A FITS file is opened, and CFITSIO's failures become exceptions.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <fitsio.h>

namespace nlcwfs {

// What those that read and write FITS share: the interface of CFITSIO with exceptions.

/// A failed CFITSIO call; what() is CFITSIO's message.
struct FitsFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @throws FitsFailure unless `status` is 0
void check_fits(int status);

/// Closes a file, whatever came of it.
struct CloseFits {
  /// Closes it, even after an error.
  void operator()(fitsfile* file) const;
};
/// An open file.
using FitsHandle = std::unique_ptr<fitsfile, CloseFits>;

/// The name of a file for CFITSIO, which expands a leading ~ even in literal names: absolute.
std::string literal_name(const std::filesystem::path& path);

/// Writes a file that must not exist. Until it is complete it has the name `path` with `.part`
/// appended. The path is taken literally.
/// @param write  writes what is in it; may throw
/// @throws std::runtime_error with the path and the cause where the file exists or cannot be
///         written
void write_new_fits_file(const std::filesystem::path& path,
                         const std::function<void(fitsfile*)>& write);

}  // namespace nlcwfs
