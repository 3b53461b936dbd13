#include "objectives/plane_layout.hpp"

#include "tests/message_of.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;
using testing::StartsWith;

constexpr Telescope paper{.diameter = 0.5, .wavelength = 532e-9};
constexpr Telescope large{.diameter = 8.2, .wavelength = 1.06e-6};

/// Points of every choice: the corners, the centre and others of the layout's box.
std::vector<SearchPoint> points_of(const PlaneLayout& layout) {
  const std::vector<Variable> variables = layout.variables();
  std::vector<SearchPoint> points;
  for (int choice = 0; choice < layout.choice_count(); ++choice) {
    for (const double shift : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      SearchPoint point{choice, Eigen::VectorXd(variables.size())};
      for (std::size_t i = 0; i < variables.size(); ++i) {
        // Another position of each variable, so that no two planes agree by chance.
        const double fraction = i % 2 == 0 ? shift : 1.0 - 0.9 * shift;
        point.x[i] = std::lerp(variables[i].lower, variables[i].upper, fraction);
      }
      points.push_back(point);
    }
  }
  return points;
}

MATCHER_P(RelativelyNear, tolerance, "") {
  const auto& [actual, expected] = arg;
  return std::abs(actual - expected) <= tolerance * std::abs(expected);
}

void expect_point_of_inverts_planes(const PlaneLayout& layout) {
  for (const SearchPoint& point : points_of(layout)) {
    const std::vector<double> planes = layout.planes(point);
    const auto found = layout.point_of(planes);
    ASSERT_TRUE(found.has_value()) << testing::PrintToString(planes);
    EXPECT_THAT(layout.planes(*found), Pointwise(RelativelyNear(1e-12), planes));
  }
}

std::string symmetric_refusal(DistanceRange near, DistanceRange far) {
  return message_of([&] { SymmetricLayout(paper, near, far); });
}

std::string free_refusal(const std::vector<DistanceRange>& ranges) {
  return message_of([&] { FreeLayout(paper, ranges); });
}

TEST(DefaultDistanceRange, IsTheSameInFresnelNumbersForEveryTelescope) {
  for (const Telescope& telescope : {paper, large}) {
    const auto [nearest, farthest] = default_distance_range(telescope);
    EXPECT_NEAR(fresnel_number(telescope, nearest), 200.0, 1e-9);
    EXPECT_NEAR(fresnel_number(telescope, farthest), 2.0, 1e-11);
  }
}

TEST(DefaultDistanceRange, HoldsThePapersPlanes) {
  const auto [nearest, farthest] = default_distance_range(paper);
  EXPECT_NEAR(nearest, 2.35e3, 5.0);
  EXPECT_NEAR(farthest, 235e3, 500.0);
}

TEST(SymmetricLayout, HasAllOrdersOfItsFourPlanesOnce) {
  const SymmetricLayout layout(paper, {5e3, 60e3}, {80e3, 200e3});
  ASSERT_EQ(layout.choice_count(), 24);
  std::set<std::vector<double>> orders;
  for (int choice = 0; choice < layout.choice_count(); ++choice) {
    std::vector<double> planes =
        layout.planes({choice, Eigen::Vector2d(layout.variables()[0].lower,  //
                                               layout.variables()[1].upper)});
    EXPECT_TRUE(orders.insert(planes).second) << choice;
    std::ranges::sort(planes);
    EXPECT_THAT(planes, ElementsAre(DoubleNear(-200e3, 1e-6), DoubleNear(-5e3, 1e-6),
                                    DoubleNear(5e3, 1e-6), DoubleNear(200e3, 1e-6)));
  }
}

TEST(SymmetricLayout, PointOfInvertsPlanes) {
  expect_point_of_inverts_planes(SymmetricLayout(paper, {5e3, 60e3}, {80e3, 200e3}));
  // Overlapping and exchanged ranges: the pairs of a design do not say which is "near".
  expect_point_of_inverts_planes(SymmetricLayout(paper, {5e3, 200e3}, {5e3, 200e3}));
  expect_point_of_inverts_planes(SymmetricLayout(large, {80e3, 200e3}, {5e3, 60e3}));
}

TEST(SymmetricLayout, FindsTheDesignOfThePaper) {
  const SymmetricLayout layout(paper, default_distance_range(paper), default_distance_range(paper));
  const auto point = layout.point_of({-47e3, 47e3, -180e3, 180e3});
  ASSERT_TRUE(point.has_value());
  EXPECT_THAT(layout.planes(*point),
              Pointwise(RelativelyNear(1e-12), std::vector<double>{-47e3, 47e3, -180e3, 180e3}));
}

TEST(SymmetricLayout, HasNoPointForOtherDesigns) {
  const SymmetricLayout layout(paper, {5e3, 60e3}, {80e3, 200e3});
  EXPECT_FALSE(layout.point_of({-47e3, 47e3}).has_value());
  EXPECT_FALSE(layout.point_of({-47e3, 47e3, -180e3, 180e3, 0.0}).has_value());
  EXPECT_FALSE(layout.point_of({-47e3, 48e3, -180e3, 180e3}).has_value());
  EXPECT_FALSE(layout.point_of({-47e3, 47e3, 180e3, 180e3}).has_value());
  EXPECT_FALSE(layout.point_of({0.0, 0.0, -180e3, 180e3}).has_value());
  EXPECT_FALSE(layout.point_of({-4e3, 4e3, -180e3, 180e3}).has_value()) << "nearer than near";
  EXPECT_FALSE(layout.point_of({-47e3, 47e3, -201e3, 201e3}).has_value()) << "farther than far";
  EXPECT_FALSE(layout.point_of({-70e3, 70e3, -180e3, 180e3}).has_value()) << "between the ranges";
}

TEST(SymmetricLayout, VariablesSpanTheRangesWithoutDimension) {
  const auto variables_at = [](const Telescope& telescope) {
    return SymmetricLayout(telescope, default_distance_range(telescope),
                           default_distance_range(telescope))
        .variables();
  };
  for (const Telescope& telescope : {paper, large}) {
    for (const Variable& variable : variables_at(telescope)) {
      EXPECT_NEAR(variable.lower, -std::log(200.0), 1e-12);
      EXPECT_NEAR(variable.upper, -std::log(2.0), 1e-12);
    }
  }
}

TEST(SymmetricLayout, RefusesBadRangesAndNamesTheirKey) {
  const DistanceRange good{5e3, 60e3};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const DistanceRange& bad : std::vector<DistanceRange>{
           {60e3, 5e3}, {5e3, 5e3}, {0.0, 5e3}, {-5e3, 5e3}, {-60e3, -5e3}, {nan, 5e3}}) {
    EXPECT_THAT(symmetric_refusal(bad, good),
                AllOf(StartsWith("search.z_near = "), HasSubstr("0 < min < max")));
    EXPECT_THAT(symmetric_refusal(good, bad), StartsWith("search.z_far = "));
  }
  EXPECT_EQ(symmetric_refusal(good, good), "");
}

TEST(PlaneLayouts, RefuseRangesWhereNoDesignIsValid) {
  // The Fresnel number is 0.1 at 4,699 km.
  EXPECT_THAT(symmetric_refusal({5e3, 60e3}, {80e3, 5e6}),
              AllOf(StartsWith("search.z_far = 80000:5e+06: "), HasSubstr("4.69925e+06 m")));
  EXPECT_THAT(free_refusal({{5e3, 60e3}, {-5e6, 60e3}}), StartsWith("search.z2 = -5e+06:60000: "));
  EXPECT_EQ(symmetric_refusal({5e3, 60e3}, {80e3, 4.6e6}), "");
}

TEST(FreeLayout, PointOfInvertsPlanesOnBothSidesOfThePupil) {
  const std::vector<DistanceRange> ranges{
      {5e3, 200e3}, {-200e3, -5e3}, {-100e3, 200e3}, {-1e3, 1.5e3}};
  expect_point_of_inverts_planes(FreeLayout(paper, ranges));
  expect_point_of_inverts_planes(FreeLayout(large, {{-200e3, 200e3}, {-3e3, 4e6}}));
}

TEST(FreeLayout, PlanesGrowWithTheirVariablesWithinTheirRanges) {
  const std::vector<DistanceRange> ranges{
      {5e3, 200e3}, {-200e3, -5e3}, {-100e3, 200e3}, {-1e3, 1.5e3}};
  const FreeLayout layout(paper, ranges);
  ASSERT_EQ(layout.choice_count(), 1);
  const std::vector<Variable> variables = layout.variables();
  ASSERT_EQ(variables.size(), ranges.size());
  constexpr int steps = 100;
  std::vector<double> first;
  std::vector<double> previous(ranges.size(), -HUGE_VAL);
  for (int step = 0; step <= steps; ++step) {
    SearchPoint point{0, Eigen::VectorXd(ranges.size())};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      point.x[i] = std::lerp(variables[i].lower, variables[i].upper, double(step) / steps);
    }
    const std::vector<double> planes = layout.planes(point);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      EXPECT_GT(planes[i], previous[i]) << "plane " << i + 1 << ", step " << step;
      EXPECT_GE(planes[i], ranges[i].first - 1e-6);
      EXPECT_LE(planes[i], ranges[i].second + 1e-6);
    }
    if (step == 0) first = planes;
    previous = planes;
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_NEAR(first[i], ranges[i].first, 1e-6);
    EXPECT_NEAR(previous[i], ranges[i].second, 1e-6);
  }
}

TEST(FreeLayout, ARangeOnBothSidesKeepsAwayFromThePupil) {
  const FreeLayout layout(paper, {{-100e3, 200e3}});
  const double nearest = default_distance_range(paper).first;
  for (const double x : {-1e-9, 1e-9}) {
    const double z = layout.planes({0, Eigen::VectorXd::Constant(1, x)}).front();
    EXPECT_NEAR(z, std::copysign(nearest, x), 1e-4);
  }
  EXPECT_FALSE(layout.point_of({0.5 * nearest}).has_value());
  EXPECT_FALSE(layout.point_of({0.0}).has_value());
}

TEST(FreeLayout, HasNoPointForOtherDesigns) {
  const FreeLayout layout(paper, {{5e3, 200e3}, {-200e3, -5e3}});
  EXPECT_TRUE(layout.point_of({47e3, -47e3}).has_value());
  EXPECT_FALSE(layout.point_of({47e3}).has_value());
  EXPECT_FALSE(layout.point_of({47e3, -47e3, 180e3}).has_value());
  EXPECT_FALSE(layout.point_of({-47e3, 47e3}).has_value());
  EXPECT_FALSE(layout.point_of({4e3, -47e3}).has_value());
  EXPECT_FALSE(layout.point_of({47e3, -201e3}).has_value());
}

TEST(FreeLayout, RefusesBadRangesAndNamesTheirKey) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const DistanceRange& bad : std::vector<DistanceRange>{
           {60e3, 5e3}, {5e3, 5e3}, {0.0, 5e3}, {-5e3, 0.0}, {nan, 5e3}, {5e3, nan}}) {
    EXPECT_THAT(free_refusal({{5e3, 60e3}, bad}),
                AllOf(StartsWith("search.z2 = "), HasSubstr("min < max")));
  }
}

}  // namespace
}  // namespace nlcwfs
