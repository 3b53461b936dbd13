// Tests: Points of a front are drawn.
#include "results/pictures/scatter_picture.hpp"

#include "tests/scratch_folder.hpp"

#include <regex>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;
using testing::StartsWith;

using ScatterPictureTest = ScratchFolder;

ScatterPicture some_points() {
  return {.title = "error against time",
          .x_label = "time, ms",
          .y_label = "error, nm",
          .colours = {"two planes", "three planes"},
          .symbols = {"few pixels", "many pixels"},
          .points = {{.x = 1.0, .y = {30.0, 2.0}},
                     {.x = 10.0, .y = {10.0, 50.0}, .colour = 1, .symbol = 1},
                     {.x = 20.0, .y = {12.0, 0.0}, .colour = 1, .is_pale = true}},
          .marked = 1,
          .mark_label = "the knee"};
}

/// How many different colours an SVG picture has.
std::ptrdiff_t colour_count(const std::string& svg, const std::string& colour) {
  const std::regex regex(colour, std::regex::icase);
  return std::distance(std::sregex_iterator(svg.begin(), svg.end(), regex), {});
}

TEST_F(ScatterPictureTest, IsDrawnInBothFormatsWithAllItsTexts) {
  ASSERT_EQ(write_picture(some_points(), "it's points"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("it's points.png", "it's points.svg"));
  EXPECT_THAT(contents("it's points.png"), StartsWith("\x89PNG"));
  const std::string svg = contents("it's points.svg");
  EXPECT_THAT(svg, AllOf(StartsWith("<?xml"), HasSubstr("</svg>")));
  for (const char* text : {"error against time", "time, ms", "error, nm", "two planes",
                           "three planes", "few pixels", "many pixels", "the knee"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST_F(ScatterPictureTest, AGroupHasItsColour) {
  ASSERT_EQ(write_picture(some_points(), "all"), std::nullopt);
  ScatterPicture without = some_points();
  without.points = {without.points[0]};
  without.marked.reset();
  ASSERT_EQ(write_picture(without, "less"), std::nullopt);
  const std::string first = "0, 114, 178";
  const std::string second = "213,  94,   0";
  EXPECT_EQ(colour_count(contents("all.svg"), first), colour_count(contents("less.svg"), first));
  EXPECT_GT(colour_count(contents("all.svg"), second), colour_count(contents("less.svg"), second));
  EXPECT_THAT(contents("less.svg"), Not(HasSubstr("the knee")));
}

TEST_F(ScatterPictureTest, LeavesOutWhatALogarithmicAxisHasNoPlaceFor) {
  ScatterPicture picture = some_points();
  picture.points[0].x = 0.0;
  EXPECT_EQ(write_picture(picture, "some"), std::nullopt);
  for (ScatterPoint& point : picture.points) point.y.mean = 0.0;
  EXPECT_THAT(write_picture(picture, "none"), Optional(HasSubstr("no value to draw")));
  picture.points.clear();
  picture.marked.reset();
  EXPECT_THAT(write_picture(picture, "empty"), Optional(HasSubstr("no value to draw")));
}

TEST_F(ScatterPictureTest, SaysWhyThereIsNone) {
  EXPECT_THAT(write_picture(some_points(), "missing/folder"), Optional(HasSubstr("missing")));
}

}  // namespace
}  // namespace nlcwfs
