// Tests: Maps and lines over axes are drawn.
#include "results/pictures/map_picture.hpp"

#include "tests/scratch_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;
using testing::StartsWith;

using MapPictureTest = ScratchFolder;

const double nan = std::numeric_limits<double>::quiet_NaN();

PictureAxis near_axis() { return {.label = "near, km", .values = {10, 20, 40, 80}}; }
PictureAxis far_axis() { return {.label = "far, km", .values = {100, 150, 200}}; }

MapPicture bowl() {
  MapPicture picture{.title = "a 'title' with_underscores, D/r0 = 4",
                     .x = near_axis(),
                     .y = far_axis(),
                     .value_label = "cost",
                     .values = {}};
  for (const double x : picture.x.values) {
    picture.values.emplace_back();
    for (const double y : picture.y.values) {
      picture.values.back().push_back(1.0 + std::pow(std::log(x / 30), 2) + std::abs(y - 150) / 50);
    }
  }
  return picture;
}

/// How many rectangles, lines, ... an SVG picture has in a colour.
std::ptrdiff_t count_of(const std::string& svg, const std::string& pattern) {
  const std::regex regex(pattern);
  return std::distance(std::sregex_iterator(svg.begin(), svg.end(), regex), {});
}

void expect_pictures(const std::string& stem) {
  const std::string svg = contents(stem + ".svg");
  EXPECT_THAT(svg, AllOf(StartsWith("<?xml"), HasSubstr("</svg>")));
  EXPECT_THAT(contents(stem + ".png"), StartsWith("\x89PNG"));
}

TEST_F(MapPictureTest, ValuesMayDifferInTheirLastDigitsAlone) {
  MapPicture flat = bowl();
  for (auto& column : flat.values) column.assign(column.size(), 0.9403092732337204);
  flat.values[0][0] = std::nextafter(flat.values[0][0], 1.0);
  EXPECT_EQ(write_picture(flat, "flat"), std::nullopt);
  expect_pictures("flat");
}

TEST_F(MapPictureTest, AMapIsDrawnInBothFormats) {
  ASSERT_EQ(write_picture(bowl(), "it's a map"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("it's a map.png", "it's a map.svg"));
  expect_pictures("it's a map");
  const std::string svg = contents("it's a map.svg");
  for (const char* text : {"a 'title' with_underscores, D/r0 = 4", "near, km", "far, km", "cost"}) {
    EXPECT_THAT(svg, AnyOf(HasSubstr(text), HasSubstr(std::regex_replace(
                                                std::string(text), std::regex("'"), "&apos;"))));
  }
}

TEST_F(MapPictureTest, AGapIsNoCell) {
  ASSERT_EQ(write_picture(bowl(), "whole"), std::nullopt);
  MapPicture picture = bowl();
  picture.values[1][1] = nan;
  picture.values[2][0] = nan;
  ASSERT_EQ(write_picture(picture, "gaps"), std::nullopt);
  const std::string filled = "<polygon fill = 'rgb";
  EXPECT_EQ(count_of(contents("whole.svg"), filled) - count_of(contents("gaps.svg"), filled), 2);
}

TEST_F(MapPictureTest, TheOrderOfTheValuesDoesNotMatter) {
  ASSERT_EQ(write_picture(bowl(), "ascending"), std::nullopt);
  MapPicture picture = bowl();
  std::ranges::reverse(picture.x.values);
  std::ranges::reverse(picture.values);
  ASSERT_EQ(write_picture(picture, "descending"), std::nullopt);
  EXPECT_EQ(contents("ascending.svg"), contents("descending.svg"));
}

TEST_F(MapPictureTest, WordsStandAtTheirValues) {
  MapPicture picture = bowl();
  picture.y = {.label = "order", .values = {0, 1, 2}, .words = {"3412", "1234", "21'43"}};
  ASSERT_EQ(write_picture(picture, "words"), std::nullopt);
  EXPECT_THAT(contents("words.svg"), AllOf(HasSubstr("3412"), HasSubstr("1234")));
}

TEST_F(MapPictureTest, APathAndMarksAreNamed) {
  MapPicture picture = bowl();
  picture.overlay = {.path_label = "search",
                     .path = {{10, 100}, {300, 120}, {30, 150}},
                     .marks = {{"best of one", {30, 150}}, {"best of other", {40, 150}}}};
  ASSERT_EQ(write_picture(picture, "path"), std::nullopt);
  EXPECT_THAT(contents("path.svg"),
              AllOf(HasSubstr("search"), HasSubstr("best of one"), HasSubstr("best of other")));
  ASSERT_EQ(write_picture(bowl(), "plain"), std::nullopt);
  EXPECT_THAT(contents("plain.svg"), Not(HasSubstr("best of")));
}

TEST_F(MapPictureTest, ALineHasItsErrors) {
  LinePicture picture{.title = "line",
                      .x = near_axis(),
                      .value_label = "residual WFE, nm",
                      .values = {{3, 0.1}, {2, 0.1}, {nan, nan}, {4, 0.2}},
                      .overlay = {.path_label = "", .path = {}, .marks = {{"best", {20, 2}}}}};
  ASSERT_EQ(write_picture(picture, "line"), std::nullopt);
  expect_pictures("line");
  EXPECT_THAT(contents("line.svg"), AllOf(HasSubstr("residual WFE, nm"), HasSubstr("best")));
}

TEST_F(MapPictureTest, CurvesAreNamedAndLeaveAMapAsLargeAsItIs) {
  MapPicture picture = bowl();
  ASSERT_EQ(write_picture(picture, "plain"), std::nullopt);
  picture.overlay.curves = {{"steep", {{10, 1}, {80, 1e6}}},
                            {"flat", {{1, 150}, {1e3, 150}}},
                            {"none of it", {{1e5, 1e5}, {1e6, 1e6}}}};
  ASSERT_EQ(write_picture(picture, "curves"), std::nullopt);
  const std::string svg = contents("curves.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("steep"), HasSubstr("flat"), HasSubstr("none of it")));
  const std::string filled = "<polygon fill = 'rgb";
  EXPECT_EQ(count_of(svg, filled), count_of(contents("plain.svg"), filled));
  EXPECT_EQ(count_of(svg, "> ?200<"), 1);
  EXPECT_EQ(count_of(svg, "> ?1000<"), 0);
}

TEST_F(MapPictureTest, ALineStandsBesideCurvesThatItHasRoomFor) {
  LinePicture picture{.title = "line",
                      .x = near_axis(),
                      .value_label = "share",
                      .values = {{0.3, 0.01}, {0.2, 0.01}, {0.1, 0.01}, {0.4, 0.01}}};
  ASSERT_EQ(write_picture(picture, "alone"), std::nullopt);
  picture.overlay.curves = {{"predicted", {{10, 2}, {80, 7}}}};
  ASSERT_EQ(write_picture(picture, "beside"), std::nullopt);
  const std::string svg = contents("beside.svg");
  EXPECT_THAT(svg, HasSubstr("predicted"));
  // At its axis, and now beside its line in the key.
  EXPECT_EQ(count_of(contents("alone.svg"), ">share<"), 1);
  EXPECT_EQ(count_of(svg, ">share<"), 2);
  EXPECT_EQ(count_of(svg, "> ?7<"), 1);
}

TEST_F(MapPictureTest, SharesHaveEvenColours) {
  // On a logarithmic scale a wide range has more numbers below its middle than above.
  MapPicture picture = bowl();
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    for (double& value : picture.values[i]) value = i == 0 ? 0.001 : 1.0;
  }
  ASSERT_EQ(write_picture(picture, "logarithmic"), std::nullopt);
  picture.is_linear = true;
  ASSERT_EQ(write_picture(picture, "linear"), std::nullopt);
  EXPECT_EQ(count_of(contents("logarithmic.svg"), "> ?0\\.01<"), 1);
  EXPECT_EQ(count_of(contents("linear.svg"), "> ?0\\.01<"), 0);
  EXPECT_EQ(count_of(contents("linear.svg"), "> ?0\\.6<"), 1);
}

TEST_F(MapPictureTest, PlainsAndSmallGridsAreDrawn) {
  MapPicture picture = bowl();
  for (auto& row : picture.values) std::ranges::fill(row, 2.5);
  EXPECT_EQ(write_picture(picture, "plain"), std::nullopt);
  for (auto& row : picture.values) std::ranges::fill(row, 0.0);
  EXPECT_EQ(write_picture(picture, "zero"), std::nullopt);
  EXPECT_EQ(write_picture(LinePicture{.title = "",
                                      .x = {.label = "", .values = {1, 2}},
                                      .value_label = "",
                                      .values = {{0, 0}, {0, 0}}},
                          "flat line"),
            std::nullopt);
  EXPECT_EQ(write_picture(MapPicture{.title = "",
                                     .x = {.label = "", .values = {-1, 1}},
                                     .y = {.label = "", .values = {0}},
                                     .value_label = "",
                                     .values = {{1e-9}, {2e9}}},
                          "two"),
            std::nullopt);
}

TEST_F(MapPictureTest, SaysWhyThereIsNone) {
  MapPicture picture = bowl();
  for (auto& row : picture.values) std::ranges::fill(row, nan);
  EXPECT_THAT(write_picture(picture, "empty"), Optional(HasSubstr("no value")));
  EXPECT_THAT(write_picture(bowl(), "no/such/folder/map"), Optional(HasSubstr("cannot write")));

  std::filesystem::create_directories("map.svg/not-empty");
  EXPECT_THAT(write_picture(bowl(), "map"), Optional(StartsWith("gnuplot failed")));
  std::filesystem::remove_all("map.svg");

  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const auto reason = write_picture(bowl(), "map");
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(reason, Optional(AllOf(StartsWith("gnuplot: "), HasSubstr("No such file"))));
  EXPECT_THAT(names_in("."), IsEmpty()) << "no remains";
}

}  // namespace
}  // namespace nlcwfs
