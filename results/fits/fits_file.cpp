// A FITS file is opened, and CFITSIO's failures become exceptions.
#include "results/fits/fits_file.hpp"

#include <array>
#include <exception>
#include <system_error>

#include <fmt/format.h>

namespace nlcwfs {

void check_fits(int status) {
  if (status == 0) return;
  std::array<char, FLEN_STATUS> summary{};
  std::array<char, FLEN_ERRMSG> detail{};
  fits_get_errstatus(status, summary.data());
  fits_read_errmsg(detail.data());  // the oldest, which is nearest to the cause
  fits_clear_errmsg();
  std::string cause(detail.data());
  if (cause.ends_with(':')) cause.pop_back();  // what it announces is CFITSIO's next message
  throw FitsFailure(cause.empty() ? fmt::format("{}", summary.data())
                                  : fmt::format("{} ({})", summary.data(), cause));
}

void CloseFits::operator()(fitsfile* file) const {
  int status = 0;
  fits_close_file(file, &status);
  fits_clear_errmsg();
}

std::string literal_name(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).string();
}

void write_new_fits_file(const std::filesystem::path& path,
                         const std::function<void(fitsfile*)>& write) {
  if (std::filesystem::exists(path)) {
    throw std::runtime_error(fmt::format("cannot write {}: the file exists", path.string()));
  }
  const std::filesystem::path part = path.string() + ".part";
  std::filesystem::remove(part);  // left by a run that was killed
  try {
    fitsfile* created = nullptr;
    int status = 0;
    fits_create_diskfile(&created, literal_name(part).c_str(), &status);
    check_fits(status);
    FitsHandle file(created);
    write(file.get());
    fits_close_file(file.release(), &status);
    check_fits(status);
    std::filesystem::rename(part, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
}

}  // namespace nlcwfs
