// Tests of screens: phase screens as a FITS cube, with their statistics.
#include "results/fits/fits_cube.hpp"
#include "tests/studies/run_results.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using Json = nlohmann::json;

using Screens = Program;

TEST_F(Screens, LeavesItsFiles) {
  const ProgramRun finished = done("screens", "run");
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "report.html", "screens.fits",
                          "structure_function.csv", "summary.json"));
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("2 screens of 32 x 32 samples"), EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "screens");
  EXPECT_EQ(json.at("screens"), 2);
  EXPECT_EQ(json.at("samples"), 32);
  const FitsCube cube = read_fits_cube("run/screens.fits", "screens.file");
  EXPECT_EQ(cube.unit, "rad");
  EXPECT_EQ(cube.slices.size(), 2u);
  EXPECT_EQ(cube.slices.at(0).rows(), 32);
  // 0.5 m over 32 samples, about the middle.
  EXPECT_THAT(contents("run/screens.fits"), AllOf(HasSubstr("CRPIX1  =                 16.5"),
                                                  HasSubstr("CDELT2  =             0.015625"),
                                                  HasSubstr("CTYPE3  = 'SCREEN  '")));
  // Four directions of 31 separations.
  EXPECT_EQ(read_table("run/structure_function.csv").size(), 1u + 4 * 31);
}

}  // namespace
}  // namespace nlcwfs
