// Tests: Curves are drawn.
#include "results/pictures/curve_picture.hpp"

#include "tests/scratch_folder.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using CurvePictureTest = ScratchFolder;

CurvePicture two_curves() {
  return {.title = "error after each loop",
          .x_label = "loops",
          .y_label = "error, nm",
          .curves = {{.label = "it's one", .x = {1, 2, 3}, .y = {9, 4, 1}, .spread = {1, 1, 0.5}},
                     {.x = {1, 2, 3}, .y = {8, NAN, 2}, .colour = 1, .is_pale = true}}};
}

TEST_F(CurvePictureTest, IsDrawnInBothFormatsWithAllItsTexts) {
  ASSERT_EQ(write_picture(two_curves(), "curves"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("curves.png", "curves.svg"));
  EXPECT_THAT(contents("curves.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(contents("curves.svg"),
              AllOf(HasSubstr("</svg>"), HasSubstr("error after each loop"), HasSubstr("loops"),
                    HasSubstr("error, nm"), HasSubstr("one"), HasSubstr("0, 114, 178"),
                    HasSubstr("213,  94,   0")));
}

TEST_F(CurvePictureTest, LogarithmicAxesAreDrawnAsSuch) {
  CurvePicture picture = two_curves();
  ASSERT_EQ(write_picture(picture, "linear"), std::nullopt);
  picture.has_log_y = true;
  ASSERT_EQ(write_picture(picture, "logarithmic"), std::nullopt);
  EXPECT_NE(contents("linear.svg"), contents("logarithmic.svg"));
}

TEST_F(CurvePictureTest, PointsAreNotJoined) {
  CurvePicture picture = two_curves();
  ASSERT_EQ(write_picture(picture, "joined"), std::nullopt);
  for (Curve& curve : picture.curves) curve.is_points = true;
  ASSERT_EQ(write_picture(picture, "points"), std::nullopt);
  EXPECT_NE(contents("joined.svg"), contents("points.svg"));
}

TEST_F(CurvePictureTest, ABandIsShaded) {
  CurvePicture picture = two_curves();
  ASSERT_EQ(write_picture(picture, "without"), std::nullopt);
  picture.band = {1.5, 2.5};
  ASSERT_EQ(write_picture(picture, "with"), std::nullopt);
  const std::string shade = "rgb(220, 235, 245)";
  EXPECT_THAT(contents("with.svg"), HasSubstr(shade));
  EXPECT_THAT(contents("without.svg"), Not(HasSubstr(shade)));
}

TEST_F(CurvePictureTest, SeveralStandSideBySideEachWithItsAxes) {
  CurvePicture second = two_curves();
  second.title = "the second";
  second.x_label = "distance, km";
  second.has_log_y = true;
  CurvePicture nothing = second;
  nothing.title = "left out";
  nothing.curves.clear();
  ASSERT_EQ(write_picture("all of them", {two_curves(), nothing, second}, "panels"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("panels.png", "panels.svg"));
  EXPECT_THAT(
      contents("panels.svg"),
      AllOf(HasSubstr("all of them"), HasSubstr("error after each loop"), HasSubstr("the second"),
            HasSubstr("loops"), HasSubstr("distance, km"), Not(HasSubstr("left out"))));
  EXPECT_EQ(write_picture("none", {nothing}, "nothing"), "there is no value to draw");
  EXPECT_EQ(write_picture("none", {}, "nothing"), "there is no value to draw");
}

TEST_F(CurvePictureTest, SaysWhereThereIsNothingToDraw) {
  CurvePicture picture = two_curves();
  for (Curve& curve : picture.curves) curve.y = {NAN, NAN, NAN};
  EXPECT_EQ(write_picture(picture, "nothing"), "there is no value to draw");
  picture.curves.clear();
  EXPECT_EQ(write_picture(picture, "nothing"), "there is no value to draw");
  EXPECT_THAT(names_in("."), testing::IsEmpty());
}

}  // namespace
}  // namespace nlcwfs
