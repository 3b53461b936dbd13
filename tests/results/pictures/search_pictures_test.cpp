// Tests: The path of a search and its sensitivity are drawn.
#include "results/pictures/search_pictures.hpp"

#include "results/tables/csv_table.hpp"
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

using SearchPictures = ScratchFolder;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<SearchStep> a_search() {
  return {{.evaluation = 1, .cost = NAN, .best_cost = infinity, .given_up = false},
          {.evaluation = 2, .cost = 3.0, .best_cost = 3.0, .given_up = false},
          {.evaluation = 3, .cost = 9.0, .best_cost = 3.0, .given_up = true},
          {.evaluation = 4, .cost = 1.0, .best_cost = 1.0, .given_up = false}};
}

std::vector<OptimumRange> two_ranges() {
  return {{.name = "z_near",
           .best = 30e3,
           .least = 28e3,
           .greatest = 30e3,
           .least_is_bound = false,
           .greatest_is_bound = false,
           .values = {{26e3, {0.5, 0.1}, true},
                      {28e3, {0.05, 0.1}, false},
                      {30e3, {0.0, 0.0}, false},
                      {32e3, {NAN, NAN}, true}}},
          {.name = "relaxation",
           .best = 0.25,
           .least = 0.25,
           .greatest = 0.5,
           .least_is_bound = false,
           .greatest_is_bound = true,
           .values = {{0.25, {0.0, 0.0}, false}, {0.5, {-0.01, 0.02}, false}}}};
}

TEST_F(SearchPictures, TheSearchHasItsDesignsAndTheLowestCost) {
  const PlannedPicture picture = search_picture("a telescope", a_search());
  EXPECT_EQ(picture.name, "search");
  ASSERT_EQ(picture.draw("search"), std::nullopt);
  EXPECT_THAT(names_in("."), ElementsAre("search.png", "search.svg"));
  EXPECT_THAT(contents("search.svg"),
              AllOf(HasSubstr("a telescope"), HasSubstr("designs tried"), HasSubstr("cost"),
                    HasSubstr("given up"), HasSubstr("the lowest so far")));
}

TEST_F(SearchPictures, CostsOfAnySignAreDrawn) {
  std::vector<SearchStep> steps = a_search();
  steps.back().cost = steps.back().best_cost = -2.0;
  EXPECT_EQ(search_picture("a telescope", steps).draw("negative"), std::nullopt);
  EXPECT_THAT(contents("negative.svg"), HasSubstr(">-2<"));
}

TEST_F(SearchPictures, ASearchOfFailuresAloneHasNone) {
  const PlannedPicture picture = search_picture("a telescope", {a_search().front()});
  EXPECT_EQ(picture.draw("search"), "there is no value to draw");
}

TEST_F(SearchPictures, TheSensitivityShowsEachVariableInItsUnit) {
  const PlannedPicture picture = sensitivity_picture("a telescope", two_ranges());
  EXPECT_EQ(picture.name, "sensitivity");
  ASSERT_EQ(picture.draw("sensitivity"), std::nullopt);
  EXPECT_THAT(contents("sensitivity.svg"),
              AllOf(HasSubstr("distance of the near pair, km"), HasSubstr("relaxation"),
                    HasSubstr("cost above the best design"), HasSubstr(" 28<")));
}

TEST_F(SearchPictures, TheSensitivityTableHasEveryValue) {
  EXPECT_EQ(sensitivity_table(two_ranges()),
            "variable,unit,value,cost_difference,cost_difference_standard_error,is_worse\n"
            "z_near,m,26000,0.5,0.1,1\n"
            "z_near,m,28000,0.05,0.1,0\n"
            "z_near,m,30000,0,0,0\n"
            "z_near,m,32000,,,1\n"
            "relaxation,,0.25,0,0,0\n"
            "relaxation,,0.5,-0.01,0.02,0\n");
}

TEST_F(SearchPictures, ReasonsWhyThereAreNoneAreToldOnce) {
  const auto fails = [](const char* reason) {
    return [reason](const auto&) { return std::optional<std::string>(reason); };
  };
  const auto succeeds = [](const auto&) { return std::optional<std::string>(); };
  const OutputFolder folder(std::filesystem::path("run"), "optimize");
  EXPECT_THAT(draw_pictures({{"a", fails("no program")},
                             {"b", succeeds},
                             {"c", fails("no value")},
                             {"d", fails("no program")}},
                            folder),
              ElementsAre("there is no a.svg, d.svg: no program", "there is no c.svg: no value"));
  EXPECT_THAT(draw_pictures({{"b", succeeds}}, folder), IsEmpty());
}

}  // namespace
}  // namespace nlcwfs
