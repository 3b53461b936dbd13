// Tests: The designs of a grid, and which of its points share one.
#include "objectives/design_grid.hpp"

#include "tests/message_of.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::SizeIs;
using testing::StartsWith;

constexpr Telescope paper{.diameter = 0.5, .wavelength = 532e-9};

using Domains = std::map<std::string, Domain, std::less<>>;
using Values = std::vector<double>;

DesignGrid symmetric(Domains domains, const std::vector<std::string>& axes,
                     std::vector<int> counts = {4},
                     std::vector<VisitingOrder> orders = {{3, 4, 1, 2}}) {
  return {paper,
          {.plane_counts = std::move(counts),
           .orders = std::move(orders),
           .domains = std::move(domains),
           .section = "sweep"},
          axes};
}

TEST(DesignGrid, LastAxisRunsFastest) {
  const DesignGrid grid = symmetric({{"z_near", Values{10e3, 20e3}},
                                     {"z_far", Values{100e3, 150e3, 200e3}},
                                     {"relaxation", Values{0.0, 0.5}}},
                                    {"z_near", "z_far", "relaxation"});
  ASSERT_EQ(grid.size(), 12u);
  EXPECT_THAT(grid.places(0), ElementsAre(0, 0, 0));
  EXPECT_THAT(grid.places(1), ElementsAre(0, 0, 1));
  EXPECT_THAT(grid.places(7), ElementsAre(1, 0, 1));
  EXPECT_THAT(grid.places(11), ElementsAre(1, 2, 1));
  const auto design = grid.design(7);
  ASSERT_TRUE(design);
  EXPECT_THAT(design->planes, ElementsAre(-100e3, 100e3, -20e3, 20e3));
  EXPECT_EQ(design->reconstruction.relaxation_end, 0.5);
}

TEST(DesignGrid, EveryPointHasItsValues) {
  const Values near{10e3, 20e3, 35e3};
  const Values far{100e3, 150e3};
  const DesignGrid grid = symmetric({{"z_near", near}, {"z_far", far}}, {"z_far", "z_near"});
  for (std::size_t point = 0; point < grid.size(); ++point) {
    const std::vector<std::size_t> places = grid.places(point);
    const double z_far = far.at(places.at(0));
    const double z_near = near.at(places.at(1));
    EXPECT_THAT(grid.design(point)->planes, ElementsAre(-z_far, z_far, -z_near, z_near));
  }
}

TEST(DesignGrid, ExchangedPairsAreOneDesignWhereTheOrdersAllowIt) {
  const Values distances{10e3, 20e3, 40e3};
  const Domains domains{{"z_near", distances}, {"z_far", distances}};
  const std::vector<std::string> axes{"z_near", "z_far"};
  // One order: exchanging the pairs is another order of the same planes.
  EXPECT_THAT(symmetric(domains, axes).distinct_designs(), SizeIs(9));
  // With its exchanged order: all but those on the diagonal have their double.
  const DesignGrid grid =
      symmetric(domains, {"order", "z_near", "z_far"}, {4}, {{3, 4, 1, 2}, {1, 2, 3, 4}});
  const std::vector<GridDesign> designs = grid.distinct_designs();
  EXPECT_EQ(grid.size(), 18u);
  EXPECT_THAT(designs, SizeIs(9));

  std::set<std::string> keys;
  std::multiset<std::size_t> points;
  for (const GridDesign& design : designs) {
    keys.insert(design.key);
    EXPECT_TRUE(std::ranges::is_sorted(design.points));
    for (const std::size_t point : design.points) {
      points.insert(point);
      EXPECT_EQ(design_key(*grid.design(point)), design.key);
    }
  }
  EXPECT_THAT(keys, SizeIs(9));
  std::vector<std::size_t> all(18);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  EXPECT_THAT(points, ElementsAreArray(all)) << "every point has one design";
}

TEST(DesignGrid, WindowsOfTheSamePixelsAreOneDesign) {
  // 64 pixels: both are 128 wide.
  const DesignGrid grid = symmetric({{"z_near", Values{10e3}},
                                     {"z_far", Values{100e3}},
                                     {"detector_window", Values{2.0, 2.0001, 3.0}}},
                                    {"detector_window"});
  const std::vector<GridDesign> designs = grid.distinct_designs();
  ASSERT_THAT(designs, SizeIs(2));
  EXPECT_THAT(designs[0].points, ElementsAre(0, 1));
  EXPECT_THAT(designs[1].points, ElementsAre(2));
}

TEST(DesignGrid, DesignsDoNotDependOnAxesOfOtherPlaneCounts) {
  const DesignGrid grid =
      symmetric({{"z_near", Values{10e3, 20e3}}, {"z_far", Values{100e3, 200e3}}},
                {"plane_count", "z_near", "z_far"}, {2, 4}, {{1, 2}, {3, 4, 1, 2}});
  ASSERT_EQ(grid.size(), 8u);
  EXPECT_THAT(grid.design(0)->planes, ElementsAre(-10e3, 10e3));
  EXPECT_THAT(grid.design(1)->planes, ElementsAre(-10e3, 10e3));
  EXPECT_THAT(grid.design(4)->planes, ElementsAre(-100e3, 100e3, -10e3, 10e3));
  EXPECT_THAT(grid.distinct_designs(), SizeIs(2 + 4));
}

TEST(DesignGrid, HasNoDesignForTheOrderOfAnotherNumberOfPlanes) {
  const DesignGrid grid =
      symmetric({{"z_near", Values{10e3}}, {"z_far", Values{100e3}}}, {"plane_count", "order"},
                {2, 3, 4}, {{1, 2}, {3, 1, 2}, {4, 1, 2}, {3, 4, 1, 2}, {1, 2, 3, 4}});
  // Two planes have one order, whatever the axis says.
  for (std::size_t order = 0; order < 5; ++order) {
    EXPECT_THAT(grid.design(order)->planes, SizeIs(2));
    EXPECT_EQ(grid.design(5 + order).has_value(), order == 1 || order == 2);
    EXPECT_EQ(grid.design(10 + order).has_value(), order >= 3);
  }
  EXPECT_THAT(grid.design(5 + 2)->planes, ElementsAre(100e3, -10e3, 10e3));
  EXPECT_THAT(grid.design(10 + 4)->planes, ElementsAre(-10e3, 10e3, -100e3, 100e3));
  EXPECT_THAT(grid.distinct_designs(), SizeIs(1 + 2 + 2));
}

TEST(DesignGrid, LeavesOutCrossedPairsWhereItIsTold) {
  const Values values{20e3, 50e3, 120e3};
  const DesignSpaceOptions options{.plane_counts = {4},
                                   .orders = {{1, 2, 3, 4}},
                                   .domains = {{"z_near", values}, {"z_far", values}},
                                   .section = "sweep"};
  const DesignGrid grid(paper, options, {"z_near", "z_far"}, false);
  for (std::size_t point = 0; point < grid.size(); ++point) {
    const std::vector<std::size_t> places = grid.places(point);
    EXPECT_EQ(grid.design(point).has_value(), places[0] <= places[1]);
  }
  EXPECT_THAT(grid.distinct_designs(), SizeIs(6));
}

TEST(DesignGrid, PlacesFreePlanesOneByOne) {
  const DesignGrid grid(
      paper,
      {.layout = Layout::free,
       .plane_counts = {3},
       .domains = {{"z1", Values{-20e3}}, {"z2", Values{5e3, -5e3}}, {"z3", Values{40e3}}},
       .section = "sweep"},
      {"z2"});
  ASSERT_EQ(grid.size(), 2u);
  EXPECT_THAT(grid.design(1)->planes, ElementsAre(-20e3, -5e3, 40e3));
}

TEST(DesignGrid, RefusesMoreThanAMillionPoints) {
  const Values many(1000, 10e3);
  EXPECT_EQ(symmetric({{"z_near", many}, {"z_far", many}}, {"z_near", "z_far"}).size(), 1'000'000u);
  Values more = many;
  more.push_back(20e3);
  EXPECT_THAT(message_of([&] {
                symmetric({{"z_near", many}, {"z_far", more}}, {"z_near", "z_far"});
              }),
              StartsWith("sweep.z_far = 1001 values: with the other axes the grid has 1.001e+06 "
                         "points, and at most 1000000"));
}

TEST(DesignGrid, NamesTheKeysOfItsSection) {
  EXPECT_THAT(message_of([] {
                symmetric({{"z_near", Values{-1.0}}, {"z_far", Values{100e3}}}, {"z_near"});
              }),
              StartsWith("sweep.z_near = -1: "));
}

}  // namespace
}  // namespace nlcwfs
