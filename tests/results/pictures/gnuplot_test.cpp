// Tests: gnuplot is run: what all pictures share.
#include "results/pictures/gnuplot.hpp"

#include "tests/scratch_folder.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using Gnuplot = ScratchFolder;

std::optional<std::string> draw_line(const std::string& settings, const std::string& stem) {
  return draw("a title", 0, {settings, {"x"}}, stem);
}

TEST(GnuplotText, IsOneTextWhateverItHolds) {
  EXPECT_EQ(gnuplot_text("it's"), "'it''s'");
  EXPECT_EQ(gnuplot_text("\"`touch a`\" \\"), "'\"`touch a`\" \\'");
  EXPECT_EQ(gnuplot_text("a\nsystem \"touch b\"\r\t\x7f"), "'a?system \"touch b\"\?\?\?'");
  EXPECT_EQ(gnuplot_text("\xc2\xb5m"), "'\xc2\xb5m'");
}

TEST_F(Gnuplot, RunsNothingThatALabelHolds) {
  const std::string label = gnuplot_text("m\nsystem 'touch a'\n`touch b`");
  ASSERT_EQ(draw_line("set xlabel " + label + "\n", "picture"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("picture.png", "picture.svg"));
}

TEST_F(Gnuplot, TakesNamesLiterally) {
  for (const char* name : {"|touch a;x", "<touch b;x", "~", "%d", "`touch c`"}) {
    ASSERT_EQ(draw_line("", name), std::nullopt) << name;
    const std::string stem = name;
    EXPECT_THAT(names_in("."), ElementsAre(stem + ".png", stem + ".svg"));
    std::filesystem::remove(stem + ".png");
    std::filesystem::remove(stem + ".svg");
  }
}

TEST_F(Gnuplot, WritesThroughNoLink) {
  for (const char* part : {"picture.gnuplot.part", "picture.log.part", "picture.svg"}) {
    std::filesystem::create_symlink("target", part);
  }
  draw_line("", "picture");
  EXPECT_THAT(names_in("."), Not(testing::Contains("target")));
}

}  // namespace
}  // namespace nlcwfs
