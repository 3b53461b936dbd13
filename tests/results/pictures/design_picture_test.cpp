// Tests: A design is drawn from the side.
#include "results/pictures/design_picture.hpp"

#include "tests/scratch_folder.hpp"

#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using DesignPicture = ScratchFolder;

/// The SVG of a design for r0 = 12.5 cm, whose Talbot distance is 58.74 km.
std::string drawn(const SensorDesign& design, const Telescope& telescope = {}) {
  EXPECT_EQ(write_design_picture("it's a design", design, telescope, 0.125, "design"),
            std::nullopt);
  return contents("design.svg");
}

SensorDesign design_of(std::vector<double> planes) {
  SensorDesign design;
  design.planes = std::move(planes);
  return design;
}

SensorDesign design_with(double window) {
  SensorDesign design;
  design.detector.window = window;
  return design;
}

TEST_F(DesignPicture, IsDrawnInBothFormatsWithPlanesOrderAndTalbotDistance) {
  const std::string svg = drawn(design_of({-180e3, 180e3, -47.25e3, 47.25e3}));
  EXPECT_THAT(names_in("."), ElementsAre("design.png", "design.svg"));
  EXPECT_THAT(contents("design.png"), StartsWith("\x89PNG"));
  for (const char* text : {"it's a design", ">-180 km<", ">180 km<", ">-47.25 km<", ">47.25 km<",
                           ">1<", ">2<", ">3<", ">4<", "Talbot distance of r0, 58.74 km",
                           "distance from the pupil, km", "across the beam, m"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, Not(HasSubstr("on the bench")));
}

TEST_F(DesignPicture, LeavesOutATalbotDistanceFarBeyondThePlanes) {
  EXPECT_THAT(drawn(design_of({-35e3, 35e3})), HasSubstr("Talbot"));
  EXPECT_THAT(drawn(design_of({-10e3, 10e3})), Not(HasSubstr("Talbot")));
}

TEST_F(DesignPicture, ShowsPlanesOfOneSideAndThoseThatAreVisitedTwice) {
  const std::string svg = drawn(design_of({50e3, 51e3, 50e3}));
  for (const char* text : {">1<", ">2<", ">3<", ">51 km<"}) EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr(">-50<"))) << "the axis begins near the pupil";
}

TEST_F(DesignPicture, BehindARelayItHasTheBenchsDistancesToo) {
  EXPECT_THAT(drawn(SensorDesign{}, {.central_obscuration = 0.3, .relay_beam_diameter = 10e-3}),
              HasSubstr(">on the bench, m<"));
  // 180 km (1 mm / 0.5 m)^2 = 0.72 m.
  EXPECT_THAT(drawn(SensorDesign{}, {.relay_beam_diameter = 1e-3}),
              HasSubstr(">on the bench, mm<"));
}

TEST_F(DesignPicture, DistancesOfLargeTelescopesHaveNoExponent) {
  EXPECT_THAT(drawn(design_of({-10893e3, 10893e3})),
              AllOf(HasSubstr(">-10893 km<"), Not(HasSubstr("e+"))));
}

TEST_F(DesignPicture, TheWindowDecidesHowHighThePlanesAre) {
  const std::string narrow = drawn(design_with(2.0));
  EXPECT_NE(narrow, drawn(design_with(4.0)));
}

}  // namespace
}  // namespace nlcwfs
