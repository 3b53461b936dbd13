// Tests: Images and maps are read and written as FITS.
#include "results/fits/fits_cube.hpp"

#include "model/input_error.hpp"
#include "tests/scratch_folder.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using FitsCubeFile = ScratchFolder;

int files() { return static_cast<int>(names_in(".").size()); }

void save(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string padded(std::string bytes, char fill) {
  bytes.resize((bytes.size() + 2879) / 2880 * 2880, fill);
  return bytes;
}

/// A FITS file from its cards after SIMPLE and its big-endian data, by the standard's own layout.
std::string fits_file(const std::vector<std::string>& cards, const std::string& data) {
  std::string header = fmt::format("{:<80}", "SIMPLE  =                    T");
  for (const std::string& card : cards) header += fmt::format("{:<80}", card);
  header += fmt::format("{:<80}", "END");
  return padded(header, ' ') + padded(data, '\0');
}

std::string card(const std::string& name, const std::string& value) {
  return fmt::format("{:<8}= {:>20}", name, value);
}

std::vector<std::string> image_cards(int bits, const std::vector<int>& shape) {
  std::vector<std::string> cards{card("BITPIX", std::to_string(bits)),
                                 card("NAXIS", std::to_string(shape.size()))};
  for (std::size_t i = 0; i < shape.size(); ++i) {
    cards.push_back(card(fmt::format("NAXIS{}", i + 1), std::to_string(shape[i])));
  }
  return cards;
}

template <class Unsigned>
std::string big_endian(Unsigned bits) {
  std::string bytes;
  for (int shift = 8 * sizeof(Unsigned) - 8; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(bits >> shift & 0xff);
  }
  return bytes;
}

std::string doubles(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) bytes += big_endian(std::bit_cast<std::uint64_t>(value));
  return bytes;
}

std::string shorts(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) bytes += big_endian(static_cast<std::uint16_t>(value));
  return bytes;
}

/// What read_fits_cube says of a file, or nothing where it accepts it.
std::string refusal(const std::filesystem::path& path) {
  try {
    read_fits_cube(path, "screens.file");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

FitsCube example() {
  Image<double> slice(3, 3);
  slice << 0.1, -2.0, 1e-300, 1e300, 5.0, 6.0, 7.0, 8.0, 1.0 / 3.0;
  return {"rad", {slice, 2.0 * slice.transpose()}};
}

TEST_F(FitsCubeFile, KeepsEveryBitOverARoundTrip) {
  write_fits_cube("cube.fits", example());
  const FitsCube cube = read_fits_cube("cube.fits", "screens.file");
  EXPECT_EQ(cube.unit, "rad");
  ASSERT_EQ(cube.slices.size(), 2u);
  for (int i : {0, 1}) EXPECT_TRUE((cube.slices[i] == example().slices[i]).all());
  EXPECT_EQ(files(), 1);
}

TEST_F(FitsCubeFile, WritesTheStandardsLayoutWithColumnsFastest) {
  write_fits_cube("cube.fits", example());
  const std::string bytes = contents("cube.fits");
  ASSERT_EQ(bytes.size(), 2u * 2880u);
  EXPECT_THAT(bytes, HasSubstr("BITPIX  =                  -64"));
  EXPECT_THAT(bytes, HasSubstr("NAXIS3  =                    2"));
  const FitsCube cube = example();
  std::vector<double> values;
  for (const auto& slice : cube.slices) {
    values.insert(values.end(), slice.data(), slice.data() + slice.size());
  }
  EXPECT_EQ(bytes.substr(2880, 18 * 8), doubles(values));
}

TEST_F(FitsCubeFile, WritesKeywordsOfEveryType) {
  write_fits_cube("cube.fits", example(),
                  {{"R0", 0.125, "m"},
                   {"SEED", std::numeric_limits<std::uint64_t>::max(), "of the screens"},
                   {"ORIGIN", "nlcwfs", "program"},
                   {"NOTE", std::string(100, 'x'), ""}});
  const std::string header = contents("cube.fits");
  EXPECT_THAT(header, HasSubstr("R0      =                0.125 / m"));
  EXPECT_THAT(header, HasSubstr("SEED    = 18446744073709551615 / of the screens"));
  EXPECT_THAT(header, HasSubstr("ORIGIN  = 'nlcwfs  '           / program"));
  EXPECT_THAT(header, HasSubstr("CONTINUE"));
}

TEST_F(FitsCubeFile, WritesAxesAsWorldCoordinates) {
  write_fits_cube(
      "cube.fits", example(),
      axis_keywords({centred_axis("X", 3, 0.5),
                     {.name = "Z_NEAR", .unit = "m", .reference_value = 5e3, .step = 1e3}}));
  const std::string header = contents("cube.fits");
  for (const std::string& expected :
       {card("CTYPE1", "'X       '          "), card("CUNIT1", "'m       '          "),
        card("CRPIX1", "2."), card("CRVAL1", "0."), card("CDELT1", "0.5"),
        card("CTYPE2", "'Z_NEAR  '          "), card("CUNIT2", "'m       '          "),
        card("CRPIX2", "1."), card("CRVAL2", "5000."), card("CDELT2", "1000.")}) {
    EXPECT_THAT(header, HasSubstr(expected));
  }
}

TEST_F(FitsCubeFile, WritesAMapWithTheValuesOfItsAxes) {
  Image<double> values(2, 3);
  values << 1.0, 2.0, 3.0, 4.0, std::numeric_limits<double>::quiet_NaN(), 6.0;
  write_fits_map("map.fits", {.unit = "nm",
                              .x = {"Z_FAR", "m", {1e3, 2e3, 3e3}},
                              .y = {"ORDER", "", {0.0, 1.0}, {"3412", "1234"}},
                              .values = values});
  const std::string bytes = contents("map.fits");
  ASSERT_EQ(bytes.size(), 6u * 2880u) << "three headers, each with its data";
  const std::string image = bytes.substr(0, 2880);
  for (const std::string& expected :
       {card("NAXIS", "2"), card("NAXIS1", "3"), card("NAXIS2", "2"),
        card("CTYPE1", "'Z_FAR   '          "), card("CRVAL1", "1000."), card("CDELT1", "1000."),
        card("AXIS1", "'Z_FAR   '          "), card("AXIS2", "'ORDER   '          "),
        card("BUNIT", "'nm      '          ")}) {
    EXPECT_THAT(image, HasSubstr(expected));
  }
  EXPECT_THAT(image, testing::Not(HasSubstr("CRVAL2"))) << "words have no coordinates";
  EXPECT_EQ(bytes.substr(2880, 4 * 8), doubles({1.0, 2.0, 3.0, 4.0}));
  const std::string far = bytes.substr(2u * 2880u, 2880);
  EXPECT_THAT(far, AllOf(HasSubstr("EXTNAME = 'Z_FAR   '"), HasSubstr(card("NAXIS", "1")),
                         HasSubstr("BUNIT   = 'm       '")));
  EXPECT_EQ(bytes.substr(3u * 2880u, 3 * 8), doubles({1e3, 2e3, 3e3}));
  EXPECT_THAT(bytes.substr(4u * 2880u, 2880),
              AllOf(HasSubstr("EXTNAME = 'ORDER   '"), HasSubstr("WORD0   = '3412    '"),
                    HasSubstr("WORD1   = '1234    '")));
}

TEST_F(FitsCubeFile, OnlyEvenAxesOfAMapHaveCoordinatesInItsHeader) {
  write_fits_map("map.fits", {.unit = "",
                              .x = {"Z_NEAR", "m", {1e3, 1e4, 1e5}},
                              .y = {"TOLERANCE", "m", {1e-9}},
                              .values = Image<double>::Ones(1, 3)});
  const std::string image = contents("map.fits").substr(0, 2880);
  EXPECT_THAT(image, AllOf(testing::Not(HasSubstr("CRVAL1")), testing::Not(HasSubstr("CRVAL2")),
                           HasSubstr("AXIS1"), HasSubstr("AXIS2")));
}

TEST_F(FitsCubeFile, CentresTheAxesOfEvenAndOddImages) {
  for (const int samples : {1, 4, 5}) {
    const FitsAxis axis = centred_axis("X", samples, 0.25);
    const auto coordinate = [&](double pixel) {
      return axis.reference_value + axis.step * (pixel - axis.reference_pixel);
    };
    // (i - (n - 1) / 2) dx of the first sample, i = 0, and of the last.
    EXPECT_DOUBLE_EQ(coordinate(1.0), -0.125 * (samples - 1));
    EXPECT_DOUBLE_EQ(coordinate(samples), 0.125 * (samples - 1));
  }
}

TEST_F(FitsCubeFile, WritesImagesThatAreNotSquareWithColumnsFastest) {
  Image<double> map(2, 3);
  map << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  write_fits_cube("map.fits", {"nm", {map}});
  const std::string bytes = contents("map.fits");
  EXPECT_THAT(bytes, HasSubstr(card("NAXIS1", "3")));
  EXPECT_THAT(bytes, HasSubstr(card("NAXIS2", "2")));
  EXPECT_EQ(bytes.substr(2880, 6 * 8), doubles({1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

TEST_F(FitsCubeFile, KeepsGapsWhereTheyAreAllowed) {
  FitsCube cube = example();
  cube.slices[1](2, 0) = std::numeric_limits<double>::quiet_NaN();
  write_fits_cube("gaps.fits", cube);
  EXPECT_THAT(refusal("gaps.fits"), HasSubstr("slice 2 has values that are not finite"));
  const FitsCube read = read_fits_cube("gaps.fits", "screens.file", FitsGaps::allowed);
  EXPECT_EQ(read.slices[1].isNaN().count(), 1);
  EXPECT_TRUE(std::isnan(read.slices[1](2, 0)));
  EXPECT_TRUE((read.slices[0] == example().slices[0]).all());
}

TEST_F(FitsCubeFile, ReadsAnImageAsOneSliceWithRowsAlongTheSecondAxis) {
  save("image.fits", fits_file(image_cards(-64, {2, 2}), doubles({1.0, 2.0, 3.0, 4.0})));
  const FitsCube cube = read_fits_cube("image.fits", "screens.file");
  ASSERT_EQ(cube.slices.size(), 1u);
  EXPECT_EQ(cube.unit, "");
  EXPECT_EQ(cube.slices[0](0, 1), 2.0);
  EXPECT_EQ(cube.slices[0](1, 0), 3.0);
}

TEST_F(FitsCubeFile, ReadsScaledIntegersAndTheUnit) {
  auto cards = image_cards(16, {2, 2, 1});
  cards.push_back(card("BSCALE", "0.5"));
  cards.push_back(card("BZERO", "10.0"));
  cards.emplace_back("BUNIT   = 'm       '");
  save("scaled.fits", fits_file(cards, shorts({0, 1, -1, 100})));
  const FitsCube cube = read_fits_cube("scaled.fits", "screens.file");
  EXPECT_EQ(cube.unit, "m");
  Image<double> expected(2, 2);
  expected << 10.0, 10.5, 9.5, 60.0;
  EXPECT_TRUE((cube.slices.at(0) == expected).all());
}

TEST_F(FitsCubeFile, TakesNamesLiterally) {
  int count = 0;
  for (const char* name : {"!cube.fits", "~cube.fits", "cube.fits[1:2,1:2]", "cube(copy).fits",
                           "cube.fits+1", "mem:", "cube.fits.gz", "two words.fits"}) {
    write_fits_cube(name, example());
    EXPECT_TRUE(std::filesystem::is_regular_file(name)) << name;
    EXPECT_EQ(files(), ++count) << name;
    EXPECT_EQ(read_fits_cube(name, "screens.file").slices.size(), 2u) << name;
  }
}

TEST_F(FitsCubeFile, RefusesAMissingFileEvenWhereACompressedOneHasItsName) {
  save("cube.fits.gz", "");
  EXPECT_THAT(refusal("cube.fits"), AllOf(StartsWith("screens.file = cube.fits: "),
                                          HasSubstr("no such file"), HasSubstr("n x n x count")));
  EXPECT_THAT(refusal("no/such/directory/cube.fits"), HasSubstr("no such file"));
}

TEST_F(FitsCubeFile, RefusesWhatIsNotAFitsFile) {
  std::filesystem::create_directory("folder");
  save("empty.fits", "");
  save("text.fits", "x, y\n1, 2\n");
  save("long_text.fits", std::string(10000, 'a'));
  EXPECT_THAT(refusal("folder"),
              AllOf(StartsWith("screens.file = folder: "), HasSubstr("directory")));
  for (const char* name : {"empty.fits", "text.fits", "long_text.fits"}) {
    EXPECT_THAT(refusal(name), AllOf(StartsWith(fmt::format("screens.file = {}: ", name)),
                                     HasSubstr("cannot be read: ")));
  }
}

TEST_F(FitsCubeFile, RefusesATruncatedFileAndItsHeaderAlone) {
  std::vector<double> values(20 * 20 * 2, 1.0);
  const std::string whole = fits_file(image_cards(-64, {20, 20, 2}), doubles(values));
  save("whole.fits", whole);
  save("half.fits", whole.substr(0, 2 * 2880));
  save("odd.fits", whole.substr(0, 2 * 2880 + 100));
  save("header.fits", whole.substr(0, 2880));
  save("part_of_header.fits", whole.substr(0, 400));
  EXPECT_EQ(refusal("whole.fits"), "");
  for (const char* name : {"half.fits", "odd.fits", "header.fits", "part_of_header.fits"}) {
    EXPECT_THAT(refusal(name), HasSubstr("cannot be read: ")) << name;
  }
}

TEST_F(FitsCubeFile, MakesNoRoomForWhatIsNotThere) {
  const auto refusal_of_header = [](const std::vector<int>& shape) {
    save("header.fits", fits_file(image_cards(8, shape), ""));
    return refusal("header.fits");
  };
  EXPECT_THAT(
      refusal_of_header({46341, 46341}),
      HasSubstr("its 46341 x 46341 x 1 values take 16 GiB of memory, and 16 GiB are allowed"));
  EXPECT_THAT(refusal_of_header({1 << 30, 1 << 30, 1 << 30}),
              HasSubstr("take 9.22e+18 GiB of memory"));
  EXPECT_THAT(refusal_of_header({46340, 46340}), HasSubstr("cannot be read: it is cut short"));
  EXPECT_THAT(refusal_of_header({1, 1, 200000000}), HasSubstr("cannot be read: it is cut short"));
  // Each slice is a block of its own.
  EXPECT_THAT(refusal_of_header({1, 1, 2147483647}), HasSubstr("take 144 GiB of memory"));
}

TEST_F(FitsCubeFile, RefusesCompressedFiles) {
  for (const char* start : {"\x1f\x8b\x08", "\x1f\x9d\x90", "\x1f\xa0", "PK\x03\x04", "BZh9"}) {
    save("packed.fits", start + std::string(5000, '\xff'));
    EXPECT_THAT(refusal("packed.fits"), HasSubstr("must be unpacked first"));
  }
}

TEST_F(FitsCubeFile, RefusesOtherShapes) {
  const auto refusal_of_shape = [](const std::vector<int>& shape) {
    save("shape.fits", fits_file(image_cards(-64, shape), doubles(std::vector<double>(24, 1.0))));
    return refusal("shape.fits");
  };
  EXPECT_THAT(refusal_of_shape({}), HasSubstr("NAXIS is 0"));
  EXPECT_THAT(refusal_of_shape({4}), HasSubstr("NAXIS is 1"));
  EXPECT_THAT(refusal_of_shape({2, 2, 2, 2}), HasSubstr("NAXIS is 4"));
  EXPECT_THAT(refusal_of_shape({3, 2}), HasSubstr("3 x 2, not square"));
  EXPECT_THAT(refusal_of_shape({2, 3, 4}), HasSubstr("2 x 3, not square"));
  EXPECT_THAT(refusal_of_shape({0, 0, 3}), HasSubstr("empty"));
  EXPECT_THAT(refusal_of_shape({2, 2, 0}), HasSubstr("empty"));
  EXPECT_EQ(refusal_of_shape({1, 1, 1}), "");
}

TEST_F(FitsCubeFile, RefusesValuesThatAreNotFiniteAndSaysWhere) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    save("bad.fits", fits_file(image_cards(-64, {1, 1, 3}), doubles({0.0, bad, 0.0})));
    EXPECT_THAT(refusal("bad.fits"), HasSubstr("slice 2 has values that are not finite"));
  }
  auto cards = image_cards(16, {2, 2});
  cards.push_back(card("BLANK", "-1"));
  save("blank.fits", fits_file(cards, shorts({0, 1, -1, 3})));
  EXPECT_THAT(refusal("blank.fits"), HasSubstr("slice 1 has values that are not finite"));
}

/// What writing says, or nothing where it succeeds.
std::string write_failure(const std::filesystem::path& path,
                          const std::vector<FitsKeyword>& keywords = {}) {
  try {
    write_fits_cube(path, example(), keywords);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(FitsCubeFile, NeverOverwrites) {
  save("cube.fits", "precious");
  EXPECT_EQ(write_failure("cube.fits"), "cannot write cube.fits: the file exists");
  EXPECT_EQ(contents("cube.fits"), "precious");
}

TEST_F(FitsCubeFile, NamesThePathAndTheCauseWhereItCannotWrite) {
  EXPECT_THAT(write_failure("no/such/cube.fits"),
              AllOf(StartsWith("cannot write no/such/cube.fits: "), HasSubstr("create")));
}

TEST_F(FitsCubeFile, LeavesNothingBehindWhenWritingFails) {
  EXPECT_THAT(write_failure("cube.fits", {{"R0", std::numeric_limits<double>::quiet_NaN(), ""}}),
              StartsWith("cannot write cube.fits: "));
  EXPECT_EQ(files(), 0);
}

TEST_F(FitsCubeFile, ReplacesWhatAKilledRunLeft) {
  save("cube.fits.part", "half a cube");
  EXPECT_EQ(write_failure("cube.fits"), "");
  EXPECT_EQ(refusal("cube.fits"), "");
  EXPECT_EQ(files(), 1);
}

TEST_F(FitsCubeFile, KeepsSetsOfFramesThatAreNotSquare) {
  FitsCube frames{.unit = "adu", .slices = {}, .sets = 2};
  for (int i = 0; i < 6; ++i) {
    Image<double> slice = Image<double>::Random(2, 5);
    slice(1, 3) = i == 4 ? std::nan("") : double(i);
    frames.slices.push_back(slice);
  }
  write_fits_cube("frames.fits", frames);
  EXPECT_THAT(contents("frames.fits"), HasSubstr("NAXIS4  =                    2"));
  const FitsCube read =
      read_fits_cube("frames.fits", "frames.file", FitsGaps::allowed, FitsShape::frames);
  EXPECT_EQ(read.sets, 2u);
  ASSERT_EQ(read.slices.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Image<double>& expected = frames.slices[i];
    EXPECT_TRUE((read.slices[i].isNaN() == expected.isNaN()).all());
    EXPECT_TRUE((expected.isNaN() || read.slices[i] == expected).all()) << i;
  }
  EXPECT_THAT(refusal("frames.fits"), HasSubstr("NAXIS is 4"));
}

}  // namespace
}  // namespace nlcwfs
