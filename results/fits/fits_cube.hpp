// Images and maps are read and written as FITS.
#pragma once

#include "model/array.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nlcwfs {

/// Images of one size, such as phase screens.
struct FitsCube {
  std::string unit;  ///< BUNIT as the file has it; empty where it has none
  std::vector<Image<double>>
      slices;            ///< FITS axis 1 = column (x), axis 2 = row (y), axis 3 = slice
  std::size_t sets = 1;  ///< FITS axis 4: the slices are those of the first set, then those of the
                         ///< second, ..., as many in each
  std::optional<double> diameter = {};    ///< DIAMETER of the pupil, m; none where it has none
  std::optional<double> wavelength = {};  ///< WAVELEN of the light, m; none where it has none
};

/// A card of a FITS header.
struct FitsKeyword {
  std::string name;  ///< at most 8 capital letters, digits, - and _
  std::variant<std::string, double, std::uint64_t> value;  ///< a text, a real or an integer number
  std::string comment;  ///< with the unit in front, such as "[m] pupil diameter"
};

/// One axis of an image in world coordinates, whose pixels are evenly spaced (Greisen & Calabretta
/// 2002, A&A 395, 1061).
struct FitsAxis {
  std::string name;              ///< CTYPE, such as "X"
  std::string unit = {};         ///< CUNIT; empty for what has none
  double reference_pixel = 1.0;  ///< CRPIX; FITS counts the first pixel's centre as 1
  double reference_value = 0.0;  ///< CRVAL: the coordinate there, in the unit
  double step = 1.0;             ///< CDELT: from one pixel to the next, in the unit
  std::string description = {};  ///< for people
};

/// An axis across the pupil or a detector: m from its middle.
/// @param pitch  of its samples, m
FitsAxis centred_axis(std::string name, Eigen::Index samples, double pitch);

/// CTYPEn, CUNITn, CRPIXn, CRVALn and CDELTn of each axis.
/// @param first  n of the first
std::vector<FitsKeyword> axis_keywords(const std::vector<FitsAxis>& axes, int first = 1);

/// Whether samples may have no value, which is NaN.
enum class FitsGaps { refused, allowed };

/// What the images of a file may be.
enum class FitsShape {
  square,  ///< n x n x count
  frames   ///< columns x rows x count x sets
};

/// Reads the image of a file's first HDU: as `allowed` says, where axes that are missing at the end
/// count 1. The path is taken literally, without CFITSIO's extended file name syntax; the file is
/// not compressed. What there is no room for, or what is not in the file, is refused before memory
/// is asked for.
/// @param key   the configuration key that named the file, for the error
/// @param what  is allowed, for the error; empty for what `allowed` says
/// @throws InputError where the file is missing or unreadable, or its image has another shape or
///         values that are not finite
FitsCube read_fits_cube(const std::filesystem::path& path, std::string_view key,
                        FitsGaps gaps = FitsGaps::refused, FitsShape allowed = FitsShape::square,
                        std::string_view what = {});

/// Writes 64-bit floating-point values with BUNIT and `keywords` in the header, on three axes or,
/// where there are several sets, four. Until it is
/// complete the file has the name `path` with `.part` appended; an existing file is never
/// overwritten. The path is taken literally.
/// @pre at least one slice, all of one size, not empty; as many in each set
/// @throws std::runtime_error with the path and the cause where the file exists or cannot be
/// written
void write_fits_cube(const std::filesystem::path& path, const FitsCube& cube,
                     const std::vector<FitsKeyword>& keywords = {});

/// What stands along an axis of a map: quantities at any distances, or words.
struct FitsMapAxis {
  std::string name;                     ///< CTYPE, such as "Z_NEAR"
  std::string unit;                     ///< CUNIT; empty for what has none
  std::vector<double> values;           ///< of each pixel, in the unit; of words their numbers
  std::vector<std::string> words = {};  ///< one for each pixel, where these are no quantities
  std::string description = {};         ///< for people
};

/// A quantity over two others.
struct FitsMap {
  std::string unit;      ///< BUNIT; empty for what has none
  FitsMapAxis x;         ///< axis 1
  FitsMapAxis y;         ///< axis 2
  Image<double> values;  ///< row = y, column = x; NaN where there is none
};

/// Writes a map as an image of x by y, with the coordinates of evenly spaced axes in its header.
/// The values of each axis follow as an image of one dimension whose EXTNAME is the axis' name;
/// words stand there as numbers from 0, which the keywords WORD0, WORD1, ... spell out. Otherwise
/// as write_fits_cube().
/// @throws std::runtime_error with the path and the cause where the file exists or cannot be
/// written
void write_fits_map(const std::filesystem::path& path, const FitsMap& map);

}  // namespace nlcwfs
