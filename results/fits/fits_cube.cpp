// Images and maps are read and written as FITS.
#include "results/fits/fits_cube.hpp"

#include "model/bound_text.hpp"
#include "model/input_error.hpp"
#include "results/fits/fits_file.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>
#include <span>
#include <system_error>
#include <utility>

#include <fitsio.h>
#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// What a slice takes beside its values: its place in the list, and a block of the heap.
constexpr double bytes_of_slice_itself = 64.0;

FitsHandle open_to_read(const std::filesystem::path& path) {
  fitsfile* file = nullptr;
  int status = 0;
  fits_open_diskfile(&file, literal_name(path).c_str(), READONLY, &status);
  check_fits(status);
  return FitsHandle(file);
}

/// Whether a file starts like FITS. CFITSIO would also unpack compressed files, of which a small
/// one may fill the memory.
bool is_plain_fits(const std::filesystem::path& path) {
  std::array<char, 6> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == "SIMPLE";
}

std::string read_unit(fitsfile* file) {
  std::array<char, FLEN_VALUE> unit{};
  int status = 0;
  fits_read_key(file, TSTRING, "BUNIT", unit.data(), nullptr, &status);
  if (status == KEY_NO_EXIST || status == VALUE_UNDEFINED) {
    fits_clear_errmsg();
    return "";
  }
  check_fits(status);
  return unit.data();
}

void write_keyword(fitsfile* file, const FitsKeyword& keyword) {
  const char* name = keyword.name.c_str();
  const char* comment = keyword.comment.c_str();
  int status = 0;
  if (const auto* text = std::get_if<std::string>(&keyword.value)) {
    fits_write_key_longstr(file, name, text->c_str(), comment, &status);
  } else if (const auto* real = std::get_if<double>(&keyword.value)) {
    fits_write_key_dbl(file, name, *real, -15, comment, &status);
  } else {
    ULONGLONG integer = std::get<std::uint64_t>(keyword.value);
    fits_write_key(file, TULONGLONG, name, &integer, comment, &status);
  }
  check_fits(status);
}

/// A length in m; none where the file has none of that name that is one.
std::optional<double> read_length(fitsfile* file, const char* name) {
  int status = 0;
  double length = 0.0;
  fits_read_key(file, TDOUBLE, name, &length, nullptr, &status);
  fits_clear_errmsg();
  return status == 0 && std::isfinite(length) && length > 0.0 ? std::optional(length)
                                                              : std::nullopt;
}

/// Moves on to the next slice: along the third axis, after its end along the fourth.
void next_slice(std::vector<LONGLONG>& first, const std::vector<LONGLONG>& shape) {
  for (std::size_t axis = 2; axis < shape.size(); ++axis) {
    if (first[axis]++ < shape[axis]) return;
    first[axis] = 1;
  }
}

/// @param shape   the lengths of the axes, axis 1 first
/// @param slices  of the image, in the order of its pixels
void write_image(fitsfile* file, std::vector<LONGLONG> shape, const std::string& unit,
                 const std::vector<FitsKeyword>& keywords, std::span<const Image<double>> slices) {
  int status = 0;
  fits_create_imgll(file, DOUBLE_IMG, static_cast<int>(shape.size()), shape.data(), &status);
  check_fits(status);
  write_keyword(file, {"BUNIT", unit, "unit of the values"});
  for (const FitsKeyword& keyword : keywords) write_keyword(file, keyword);

  std::vector<LONGLONG> first(shape.size(), 1);
  for (const Image<double>& slice : slices) {
    assert(slice.size() == slices.front().size());
    // CFITSIO's interface takes the values as mutable, but only reads them.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    auto* const values = const_cast<double*>(slice.data());
    fits_write_pixll(file, TDOUBLE, first.data(), slice.size(), values, &status);
    check_fits(status);
    next_slice(first, shape);
  }
}

/// Whether neighbours are as far apart everywhere, so that a pixel's number tells its coordinate.
bool is_even(const FitsMapAxis& axis) {
  if (axis.values.size() < 2 || !axis.words.empty()) return false;
  const double step = (axis.values.back() - axis.values.front()) / double(axis.values.size() - 1);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    const double expected = axis.values.front() + double(i) * step;
    if (std::abs(axis.values[i] - expected) > 1e-9 * std::abs(step)) return false;
  }
  return true;
}

/// The keywords of a map's axis.
/// @param number  of the axis, from 1
std::vector<FitsKeyword> keywords_of(const FitsMapAxis& axis, int number) {
  std::vector<FitsKeyword> keywords;
  if (is_even(axis)) {
    const auto last = axis.values.size() - 1;
    keywords = axis_keywords({{.name = axis.name,
                               .unit = axis.unit,
                               .reference_value = axis.values.front(),
                               .step = (axis.values.back() - axis.values.front()) / double(last),
                               .description = axis.description}},
                             number);
  }
  keywords.push_back({fmt::format("AXIS{}", number), axis.name, "EXTNAME of this axis' values"});
  return keywords;
}

void write_axis(fitsfile* file, const FitsMapAxis& axis) {
  const Image<double> values =
      Eigen::Map<const Image<double>>(axis.values.data(), 1, Eigen::Index(axis.values.size()));
  std::vector<FitsKeyword> keywords{{"EXTNAME", axis.name, axis.description}};
  for (std::size_t i = 0; i < axis.words.size(); ++i) {
    keywords.push_back({fmt::format("WORD{}", i), axis.words[i], ""});
  }
  write_image(file, {values.size()}, axis.unit, keywords, {&values, 1});
}

}  // namespace

FitsAxis centred_axis(std::string name, Eigen::Index samples, double pitch) {
  return {.name = std::move(name),
          .unit = "m",
          .reference_pixel = 0.5 * double(samples + 1),
          .step = pitch,
          .description = "from the middle"};
}

std::vector<FitsKeyword> axis_keywords(const std::vector<FitsAxis>& axes, int first) {
  std::vector<FitsKeyword> keywords;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const FitsAxis& axis = axes[i];
    const std::size_t number = static_cast<std::size_t>(first) + i;
    const auto add = [&](const char* name, const auto& value, const std::string& comment) {
      keywords.push_back({fmt::format("{}{}", name, number), value, comment});
    };
    add("CTYPE", axis.name, axis.description);
    add("CUNIT", axis.unit, "unit of this axis");
    add("CRPIX", axis.reference_pixel, "reference pixel");
    add("CRVAL", axis.reference_value, "coordinate there");
    add("CDELT", axis.step, "from pixel to pixel");
  }
  return keywords;
}

FitsCube read_fits_cube(const std::filesystem::path& path, std::string_view key, FitsGaps gaps,
                        FitsShape allowed, std::string_view what) {
  if (what.empty()) {
    what = allowed == FitsShape::square
               ? "a FITS file whose first image is n x n x count (or n x n)"
               : "a FITS file whose first image is columns x rows x planes (or with sets as fourth "
                 "axis)";
  }
  const auto refuse = [&](const std::string& why) {
    throw InputError(key, path.string(), fmt::format("{}; allowed is {}", why, what));
  };
  // Asked first, because CFITSIO would try the name with .gz and the like appended.
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) refuse("there is no such file");
  if (std::filesystem::is_directory(path, failure)) refuse("this is a directory");
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(path, failure)) refuse("it cannot be read: it is no file");
  if (!is_plain_fits(path)) {
    refuse("it cannot be read: it is no FITS file, or compressed and must be unpacked first");
  }
  FitsCube cube;
  try {
    const FitsHandle file = open_to_read(path);
    int status = 0;
    int dimensions = 0;
    int type = 0;
    std::vector<LONGLONG> shape{0, 0, 1, 1};
    fits_get_img_paramll(file.get(), 4, &type, &dimensions, shape.data(), &status);
    check_fits(status);
    const int most_dimensions = allowed == FitsShape::square ? 3 : 4;
    if (dimensions < 2 || dimensions > most_dimensions) {
      refuse(fmt::format("NAXIS is {}", dimensions));
    }
    if (allowed == FitsShape::square && shape[0] != shape[1]) {
      refuse(fmt::format("its slices are {} x {}, not square", shape[0], shape[1]));
    }
    if (std::ranges::min(shape) <= 0) refuse("it is empty");
    // As floating point: the product may be too large for an integer.
    double values = 1.0;
    for (const LONGLONG length : shape) values *= double(length);
    const double bytes =
        values * sizeof(double) + double(shape[2]) * double(shape[3]) * bytes_of_slice_itself;
    if (bytes > max_image_memory) {
      refuse(fmt::format("its {} x {} x {:.0f} values take {}", shape[0], shape[1],
                         double(shape[2]) * double(shape[3]), memory_text(bytes)));
    }
    const LONGLONG slices = shape[2] * shape[3];
    LONGLONG data_start = 0;
    fits_get_hduaddrll(file.get(), nullptr, &data_start, nullptr, &status);
    check_fits(status);
    // Before room is made for what is not there. BITPIX, CFITSIO's type, is below 0 for reals.
    if (double(data_start) + values * std::abs(type) / 8.0 >
        double(std::filesystem::file_size(path))) {
      refuse("it cannot be read: it is cut short");
    }
    cube.sets = static_cast<std::size_t>(shape[3]);
    cube.unit = read_unit(file.get());
    cube.diameter = read_length(file.get(), "DIAMETER");
    cube.wavelength = read_length(file.get(), "WAVELEN");

    std::vector<LONGLONG> first(shape.size(), 1);
    double undefined = std::numeric_limits<double>::quiet_NaN();  // also what BLANK stands for
    int any_undefined = 0;  // not asked for, but CFITSIO writes to it
    for (LONGLONG count = 1; count <= slices; ++count, next_slice(first, shape)) {
      Image<double> slice(shape[1], shape[0]);
      fits_read_pixll(file.get(), TDOUBLE, first.data(), slice.size(), &undefined, slice.data(),
                      &any_undefined, &status);
      check_fits(status);
      if (gaps == FitsGaps::refused && !slice.isFinite().all()) {
        refuse(fmt::format("slice {} has values that are not finite", count));
      }
      cube.slices.push_back(std::move(slice));
    }
  } catch (const FitsFailure& error) {
    refuse(
        fmt::format("it cannot be read: it is no FITS file, damaged or cut short; CFITSIO says: {}",
                    error.what()));
  }
  return cube;
}

void write_fits_cube(const std::filesystem::path& path, const FitsCube& cube,
                     const std::vector<FitsKeyword>& keywords) {
  assert(!cube.slices.empty() && cube.slices.front().size() > 0);
  const Image<double>& slice = cube.slices.front();
  std::vector<LONGLONG> shape{slice.cols(), slice.rows(),
                              static_cast<LONGLONG>(cube.slices.size() / cube.sets)};
  if (cube.sets > 1) shape.push_back(static_cast<LONGLONG>(cube.sets));
  write_new_fits_file(
      path, [&](fitsfile* file) { write_image(file, shape, cube.unit, keywords, cube.slices); });
}

void write_fits_map(const std::filesystem::path& path, const FitsMap& map) {
  assert(map.values.cols() == Eigen::Index(map.x.values.size()));
  assert(map.values.rows() == Eigen::Index(map.y.values.size()));
  std::vector<FitsKeyword> keywords = keywords_of(map.x, 1);
  const std::vector<FitsKeyword> of_y = keywords_of(map.y, 2);
  keywords.insert(keywords.end(), of_y.begin(), of_y.end());
  write_new_fits_file(path, [&](fitsfile* file) {
    write_image(file, {map.values.cols(), map.values.rows()}, map.unit, keywords, {&map.values, 1});
    write_axis(file, map.x);
    write_axis(file, map.y);
  });
}

}  // namespace nlcwfs
