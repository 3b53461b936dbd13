#include "results/curve_picture.hpp"

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
