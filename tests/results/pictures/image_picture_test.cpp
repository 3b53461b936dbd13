// Tests: Square images are drawn in their colours.
#include "results/pictures/image_picture.hpp"

#include "tests/scratch_folder.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using ImagePictureTest = ScratchFolder;

Image<double> slope(int samples) {
  Image<double> image(samples, samples);
  for (int column = 0; column < samples; ++column) image.col(column) = column;
  return image;
}

ImagePicture two_images() {
  Image<double> gaps = slope(6) - 2.0;
  gaps(0, 0) = std::numeric_limits<double>::quiet_NaN();
  return {.title = "what it's like",
          .axis_unit = "mm",
          .panels = {{.title = "first", .value_label = "light", .values = slope(8), .pitch = 0.5},
                     {.title = "second",
                      .value_label = "path, nm",
                      .values = gaps,
                      .pitch = 1.0,
                      .is_signed = true}},
          .circle = 2.0};
}

TEST_F(ImagePictureTest, IsDrawnInBothFormatsWithAllItsTexts) {
  ASSERT_EQ(write_picture(two_images(), "it's two"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("it's two.png", "it's two.svg"))
      << "nothing of what was between is left";
  EXPECT_THAT(contents("it's two.png"), StartsWith("\x89PNG"));
  const std::string svg = contents("it's two.svg");
  for (const char* text :
       {"what it's like", "first", "second", "light", "path, nm", "x, mm", "y, mm", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST_F(ImagePictureTest, AnImageDecidesWhatIsDrawn) {
  ImagePicture picture = two_images();
  ASSERT_EQ(write_picture(picture, "one"), std::nullopt);
  picture.panels[0].values.transposeInPlace();
  ASSERT_EQ(write_picture(picture, "transposed"), std::nullopt);
  EXPECT_NE(contents("one.png"), contents("transposed.png"));
  EXPECT_NE(contents("one.svg"), contents("transposed.svg"));
}

TEST_F(ImagePictureTest, ColoursOfSignedImagesReachAsFarToBothSides) {
  ImagePicture picture = two_images();
  picture.panels.erase(picture.panels.begin());  // leaves -2 to 3
  picture.panels[0].pitch = 0.1;                 // so that the axes have other numbers
  ASSERT_EQ(write_picture(picture, "signed"), std::nullopt);
  EXPECT_THAT(contents("signed.svg"), AllOf(HasSubstr(">-3<"), HasSubstr(">3<")));
  picture.panels[0].is_signed = false;
  ASSERT_EQ(write_picture(picture, "unsigned"), std::nullopt);
  EXPECT_THAT(contents("unsigned.svg"), Not(HasSubstr(">-3<")));
  // The same colours as others.
  picture.panels[0].range = {-40.0, 40.0};
  ASSERT_EQ(write_picture(picture, "wide"), std::nullopt);
  EXPECT_THAT(contents("wide.svg"), AllOf(HasSubstr(">-40<"), HasSubstr(">40<")));
}

TEST_F(ImagePictureTest, APlainImageIsDrawn) {
  ImagePicture picture = two_images();
  for (ImagePanel& panel : picture.panels) panel.values.setZero();
  EXPECT_EQ(write_picture(picture, "plain"), std::nullopt);
}

TEST_F(ImagePictureTest, SaysWhereThereIsNothingToDraw) {
  ImagePicture picture = two_images();
  for (ImagePanel& panel : picture.panels) panel.values.setConstant(NAN);
  EXPECT_EQ(write_picture(picture, "nothing"), "there is no value to draw");
  EXPECT_THAT(names_in("."), IsEmpty());
}

}  // namespace
}  // namespace nlcwfs
