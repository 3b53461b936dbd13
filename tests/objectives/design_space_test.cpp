// Tests: What a search may choose becomes points, and points become sensors.
#include "objectives/design_space.hpp"

#include "tests/message_of.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;
using testing::SizeIs;
using testing::StartsWith;

constexpr Telescope paper{.diameter = 0.5, .wavelength = 532e-9};
constexpr Telescope large{.diameter = 8.2, .wavelength = 1.06e-6};
const double nan = std::numeric_limits<double>::quiet_NaN();

using Domains = std::map<std::string, Domain, std::less<>>;

DesignSpace symmetric(Domains domains, std::vector<int> counts = {4},
                      std::vector<VisitingOrder> orders = {}) {
  return {paper,
          {.plane_counts = std::move(counts),
           .orders = std::move(orders),
           .domains = std::move(domains)}};
}

DesignSpace free_layout(Domains domains, std::vector<int> counts = {4},
                        const Telescope& telescope = paper) {
  return {
      telescope,
      {.layout = Layout::free, .plane_counts = std::move(counts), .domains = std::move(domains)}};
}

SensorDesign with_planes(std::vector<double> planes) {
  SensorDesign design;
  design.planes = std::move(planes);
  return design;
}

/// Points of every sub-space: the corners, the centre and others of its box, in each discrete
/// value.
std::vector<SearchPoint> points_of(const DesignSpace& space) {
  std::vector<SearchPoint> points;
  const std::vector<SubSpace> sub_spaces = space.sub_spaces();
  for (int s = 0; s < static_cast<int>(sub_spaces.size()); ++s) {
    const std::vector<Variable>& variables = sub_spaces[static_cast<std::size_t>(s)].variables;
    for (int step = 0; step <= 24; ++step) {
      SearchPoint point{s, Eigen::VectorXd(variables.size())};
      for (std::size_t i = 0; i < variables.size(); ++i) {
        // Another position of each variable, so that no two planes agree by chance.
        const double share = i % 2 == 0 ? step / 24.0 : 1.0 - 0.9 * step / 24.0;
        double& x = point.x[Eigen::Index(i)];
        x = std::lerp(variables[i].lower, variables[i].upper, share);
        if (!variables[i].is_continuous()) x = std::round(x);
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

void expect_point_of_inverts_design(const DesignSpace& space) {
  for (const SearchPoint& point : points_of(space)) {
    const SensorDesign design = space.design(point);
    const auto found = space.point_of(design);
    ASSERT_TRUE(found.has_value()) << design_key(design);
    EXPECT_EQ(design_key(space.design(*found)), design_key(design));
    EXPECT_EQ(found->sub_space, point.sub_space);
  }
}

std::string refusal(Layout layout, Domains domains, std::vector<int> counts = {4}) {
  return message_of([&] {
    DesignSpace(
        paper,
        {.layout = layout, .plane_counts = std::move(counts), .domains = std::move(domains)});
  });
}

TEST(DefaultDistanceRange, IsTheSameInFresnelNumbersForEveryTelescope) {
  for (const Telescope& telescope : {paper, large}) {
    const auto [nearest, farthest] = default_distance_range(telescope);
    EXPECT_NEAR(fresnel_number(telescope, nearest), 200.0, 1e-9);
    EXPECT_NEAR(fresnel_number(telescope, farthest), 2.0, 1e-11);
  }
}

TEST(SymmetricPlanes, AreFoundWithTheirPairsAndOrder) {
  const auto papers = symmetric_planes({-180e3, 180e3, -47e3, 47e3});
  ASSERT_TRUE(papers);
  EXPECT_THAT(papers->pairs, ElementsAre(47e3, 180e3));
  EXPECT_THAT(papers->order, ElementsAre(3, 4, 1, 2));
  EXPECT_THAT(symmetric_planes({47e3, -47e3})->order, ElementsAre(2, 1));
  // The paper's figure 4, without P3 and without P1.
  EXPECT_THAT(symmetric_planes({-47e3, 47e3, 180e3})->order, ElementsAre(1, 2, 4));
  EXPECT_THAT(symmetric_planes({47e3, -180e3, 180e3})->order, ElementsAre(2, 3, 4));
  EXPECT_THAT(symmetric_planes({-1.0, 3.0, -3.0, 2.0, -2.0, 1.0})->order,
              ElementsAre(1, 6, 5, 4, 3, 2));
}

TEST(SymmetricPlanes, AreNotFoundInOtherLayouts) {
  for (const std::vector<double>& planes :
       std::vector<std::vector<double>>{{},
                                        {1.0},
                                        {1.0, 2.0},
                                        {-1.0, 1.0, -2.0, 3.0},
                                        {-1.0, 1.0, 1.0},
                                        {-1.0, 1.0, 0.0},
                                        {-1.0, 1.0, -1.0, 1.0},
                                        {1.0, 2.0, 3.0},
                                        {-1.0, 1.0, -2.0, 2.0, -3.0, 3.0, 4.0}}) {
    EXPECT_FALSE(symmetric_planes(planes)) << testing::PrintToString(planes);
  }
}

TEST(SymmetricNamings, GiveTheSamePlanesUnderEveryName) {
  const std::vector<SymmetricPlanes> two = symmetric_namings({-120.0, 120.0, -30.0, 30.0});
  ASSERT_THAT(two, SizeIs(2));
  EXPECT_THAT(two[0].pairs, ElementsAre(30.0, 120.0));
  EXPECT_THAT(two[0].order, ElementsAre(3, 4, 1, 2));
  EXPECT_THAT(two[1].pairs, ElementsAre(120.0, 30.0));
  EXPECT_THAT(two[1].order, ElementsAre(1, 2, 3, 4));
  const std::vector<double> five{1.0, -3.0, 3.0, -2.0, -1.0};
  const std::vector<SymmetricPlanes> three = symmetric_namings(five);
  EXPECT_THAT(three, SizeIs(6));
  for (const SymmetricPlanes& naming : three) {
    const DesignSpace space = symmetric({{"z_near", std::vector{naming.pairs[0]}},
                                         {"z_far", std::vector{naming.pairs[1]}},
                                         {"z_third", std::vector{naming.pairs[2]}}},
                                        {5}, {naming.order});
    EXPECT_EQ(space.design({0, Eigen::VectorXd()}).planes, five);
  }
  EXPECT_THAT(symmetric_namings({1.0, 2.0}), SizeIs(0));
}

TEST(SymmetricSpace, VisitsEveryNumberOfPlanesInAllOrdersOnce) {
  for (const auto& [planes, orders] : {std::pair{2, 2}, {3, 24}, {4, 24}, {5, 720}, {6, 720}}) {
    Domains domains{{"z_near", std::vector{5e3}}};
    if (planes > 2) domains["z_far"] = std::vector{200e3};
    if (planes > 4) domains["z_third"] = std::vector{400e3};
    const DesignSpace space = symmetric(domains, {planes});
    const std::vector<Variable> variables = space.sub_spaces().front().variables;
    ASSERT_THAT(variables, SizeIs(1));
    EXPECT_EQ(variables[0].name, "order");
    EXPECT_EQ(variables[0].kind, VariableKind::categorical);
    EXPECT_EQ(variables[0].upper, orders - 1);
    std::set<std::vector<double>> found;
    for (int order = 0; order < orders; ++order) {
      const SensorDesign design = space.design({0, Eigen::VectorXd::Constant(1, order)});
      EXPECT_TRUE(symmetric_planes(design.planes)) << order;
      EXPECT_THAT(design.planes, SizeIs(planes));
      found.insert(design.planes);
    }
    EXPECT_THAT(found, SizeIs(orders));
  }
}

TEST(SymmetricSpace, VisitsTheOrdersThatItIsGiven) {
  const DesignSpace space = symmetric(
      {{"z_near", std::vector{47e3}}, {"z_far", ValueRange{100e3, 200e3}}}, {4, 2}, {{3, 4, 1, 2}});
  ASSERT_THAT(space.sub_spaces(), SizeIs(2));
  EXPECT_THAT(space.sub_spaces()[0].variables, SizeIs(1));  // z_far alone
  EXPECT_THAT(
      space.design({0, Eigen::VectorXd::Constant(1, space.sub_spaces()[0].variables[0].upper)})
          .planes,
      Pointwise(RelativelyNear(1e-12), std::vector{-200e3, 200e3, -47e3, 47e3}));
  EXPECT_THAT(space.design({1, Eigen::VectorXd::Constant(1, 1.0)}).planes,
              ElementsAre(47e3, -47e3));
}

TEST(DesignSpace, PointOfInvertsDesign) {
  const ValueRange near{5e3, 60e3};
  const ValueRange far{80e3, 200e3};
  expect_point_of_inverts_design(symmetric({{"z_near", near}, {"z_far", far}}));
  // Overlapping and exchanged ranges: the pairs of a design do not say which is "near".
  expect_point_of_inverts_design(symmetric({}));
  expect_point_of_inverts_design(symmetric({{"z_near", far}, {"z_far", near}}));
  expect_point_of_inverts_design(
      symmetric({{"z_third", ValueRange{1e3, 4e3}}, {"z_near", near}, {"z_far", far}}, {2, 3, 6}));
  const Domains free{{"z1", ValueRange{5e3, 200e3}},
                     {"z2", ValueRange{-200e3, -5e3}},
                     {"z3", ValueRange{-100e3, 200e3}},
                     {"z4", ValueRange{-1e3, 1.5e3}}};
  expect_point_of_inverts_design(free_layout(free));
  expect_point_of_inverts_design(free_layout({{"z2", ValueRange{-3e3, 4e6}}}, {2}, large));
  expect_point_of_inverts_design(free_layout({{"z2", std::vector{0.0, 5e3}},
                                              {"z3", ValueRange{-10e3, 10e3, Scale::linear}},
                                              {"pupil_pixels", std::vector{16.0, 32.0}},
                                              {"detector_window", ValueRange{2.0, 6.0}},
                                              {"reconstruction_window", ValueRange{3.0, 8.0}},
                                              {"relaxation_start", ValueRange{-0.9, 0.9}},
                                              {"relaxation_end", ValueRange{-0.9, 0.9}},
                                              {"initial_guess", std::vector{1.0, 0.0}},
                                              {"reconstruction_oversampling", ValueRange{1.0, 4.0}},
                                              {"tolerance", ValueRange{1e-10, 1e-8}}},
                                             {2, 3, 5}));
}

TEST(DesignSpace, VariesWhatItIsToldAndNothingElse) {
  SensorDesign base;
  base.reconstruction.relaxation_start = 0.3;
  base.detector.photons = 1e5;
  const DesignSpace space(
      paper, {.base = base,
              .domains = {{"z_near", std::vector{47e3}}, {"tolerance", ValueRange{1e-10, 1e-8}}}});
  EXPECT_TRUE(space.varies("tolerance"));
  EXPECT_TRUE(space.varies("z_far"));
  EXPECT_FALSE(space.varies("z_near"));
  EXPECT_TRUE(space.decides("z_near"));
  EXPECT_FALSE(space.decides("z_far"));
  EXPECT_FALSE(space.varies("relaxation"));
  const std::vector<Variable> variables = space.sub_spaces().front().variables;
  ASSERT_THAT(variables, SizeIs(3));
  EXPECT_EQ(variables[0].name, "log z_far");
  EXPECT_EQ(variables[1].name, "order");
  EXPECT_EQ(variables[2].name, "log tolerance");
  const Eigen::Vector3d middle(-2.0, 0.0, 0.5 * (variables[2].lower + variables[2].upper));
  const SensorDesign varied = space.design({0, middle});
  EXPECT_NEAR(varied.reconstruction.tolerance, 1e-9, 1e-20);  // the geometric mean
  EXPECT_EQ(varied.reconstruction.relaxation_start, 0.3);
  EXPECT_EQ(varied.detector.photons, 1e5);
}

TEST(DesignSpace, KindsOfVariablesAreThoseOfTheirDomains) {
  const DesignSpace space = free_layout({{"z1", std::vector{-5e3, 5e3}},
                                         {"z2", ValueRange{5e3, 9e3}},
                                         {"pupil_pixels", std::vector{16.0, 32.0, 64.0}},
                                         {"initial_guess", std::vector{0.0, 1.0}},
                                         {"reconstruction_oversampling", ValueRange{1.0, 3.0}}},
                                        {2});
  std::map<std::string, VariableKind> kinds;
  const SubSpace sub_space = space.sub_spaces().front();
  for (const Variable& variable : sub_space.variables) {
    kinds[variable.name] = variable.kind;
  }
  EXPECT_EQ(kinds, (std::map<std::string, VariableKind>{
                       {"z1", VariableKind::integer},
                       {"log z2", VariableKind::continuous},
                       {"pupil_pixels", VariableKind::integer},
                       {"initial_guess", VariableKind::categorical},
                       {"reconstruction_oversampling", VariableKind::integer}}));
}

TEST(DesignSpace, RoundsWindowsToGridsThatAreValid) {
  const DesignSpace space = free_layout(
      {{"detector_window", ValueRange{1.0, 6.0}}, {"reconstruction_window", ValueRange{1.0, 6.0}}},
      {2});
  for (const SearchPoint& point : points_of(space)) {
    const SensorDesign design = space.design(point);
    EXPECT_NO_THROW(design.validate(paper)) << design_key(design);
    int rest = design.grid_width();
    for (const int prime : {2, 3, 5, 7}) {
      while (rest % prime == 0) rest /= prime;
    }
    EXPECT_EQ(rest, 1) << design.grid_width();
  }
}

TEST(DesignSpace, FindsTheDesignOfThePaper) {
  const DesignSpace space = symmetric({});
  const auto point = space.point_of(with_planes({-47e3, 47e3, -180e3, 180e3}));
  ASSERT_TRUE(point.has_value());
  EXPECT_THAT(space.design(*point).planes,
              Pointwise(RelativelyNear(1e-12), std::vector<double>{-47e3, 47e3, -180e3, 180e3}));
}

TEST(DesignSpace, HasNoPointForOtherDesigns) {
  const DesignSpace pairs =
      symmetric({{"z_near", ValueRange{5e3, 60e3}}, {"z_far", ValueRange{80e3, 200e3}}});
  for (const std::vector<double>& planes :
       std::vector<std::vector<double>>{{-47e3, 47e3},
                                        {-47e3, 47e3, -180e3, 180e3, 0.0},
                                        {-47e3, 48e3, -180e3, 180e3},
                                        {-47e3, 47e3, 180e3, 180e3},
                                        {0.0, 0.0, -180e3, 180e3},
                                        {-4e3, 4e3, -180e3, 180e3},    // nearer than near
                                        {-47e3, 47e3, -201e3, 201e3},  // farther than far
                                        {-70e3, 70e3, -180e3, 180e3}}) {
    EXPECT_FALSE(pairs.point_of(with_planes(planes))) << testing::PrintToString(planes);
  }
  const DesignSpace free =
      free_layout({{"z1", ValueRange{5e3, 200e3}}, {"z2", ValueRange{-200e3, -5e3}}}, {2});
  EXPECT_TRUE(free.point_of(with_planes({47e3, -47e3})));
  for (const std::vector<double>& planes : std::vector<std::vector<double>>{
           {47e3}, {47e3, -47e3, 180e3}, {-47e3, 47e3}, {4e3, -47e3}, {47e3, -201e3}}) {
    EXPECT_FALSE(free.point_of(with_planes(planes))) << testing::PrintToString(planes);
  }
  SensorDesign relaxed = with_planes({-47e3, 47e3, -180e3, 180e3});
  relaxed.reconstruction.relaxation_start = 0.5;
  EXPECT_FALSE(symmetric({{"relaxation_start", ValueRange{0.0, 0.4}}}).point_of(relaxed));
  EXPECT_FALSE(symmetric({{"relaxation_start", std::vector{0.4}}}).point_of(relaxed));
  EXPECT_TRUE(symmetric({{"relaxation_start", ValueRange{0.0, 0.6}}}).point_of(relaxed));
}

TEST(DesignSpace, DistancesSpanTheirRangesWithoutDimension) {
  for (const Telescope& telescope : {paper, large}) {
    const SubSpace sub_space = DesignSpace(telescope, {}).sub_spaces().front();
    for (const Variable& variable : sub_space.variables) {
      if (!variable.is_continuous()) continue;
      EXPECT_NEAR(variable.lower, -std::log(200.0), 1e-12);
      EXPECT_NEAR(variable.upper, -std::log(2.0), 1e-12);
    }
  }
}

TEST(FreeSpace, PlanesGrowWithTheirVariablesWithinTheirRanges) {
  const std::vector<ValueRange> ranges{
      {5e3, 200e3}, {-200e3, -5e3}, {-100e3, 200e3}, {-1e3, 1.5e3}};
  const DesignSpace space =
      free_layout({{"z1", ranges[0]}, {"z2", ranges[1]}, {"z3", ranges[2]}, {"z4", ranges[3]}});
  const std::vector<Variable> variables = space.sub_spaces().front().variables;
  ASSERT_EQ(variables.size(), ranges.size());
  constexpr int steps = 100;
  std::vector<double> first;
  std::vector<double> previous(ranges.size(), -HUGE_VAL);
  for (int step = 0; step <= steps; ++step) {
    SearchPoint point{0, Eigen::VectorXd(ranges.size())};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      point.x[Eigen::Index(i)] =
          std::lerp(variables[i].lower, variables[i].upper, double(step) / steps);
    }
    const std::vector<double> planes = space.design(point).planes;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      EXPECT_GT(planes[i], previous[i]) << "plane " << i + 1 << ", step " << step;
      EXPECT_GE(planes[i], ranges[i].lower - 1e-6);
      EXPECT_LE(planes[i], ranges[i].upper + 1e-6);
    }
    if (step == 0) first = planes;
    previous = planes;
  }
  ASSERT_EQ(first.size(), ranges.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(first[i], ranges[i].lower, 1e-6);
    EXPECT_NEAR(previous[i], ranges[i].upper, 1e-6);
  }
}

TEST(FreeSpace, ARangeOnBothSidesKeepsAwayFromThePupil) {
  const DesignSpace space =
      free_layout({{"z1", ValueRange{-100e3, 200e3}}, {"z2", std::vector{5e3}}}, {2});
  const double nearest = default_distance_range(paper).first;
  for (const double x : {-1e-9, 1e-9}) {
    const double z = space.design({0, Eigen::VectorXd::Constant(1, x)}).planes.front();
    EXPECT_NEAR(z, std::copysign(nearest, x), 1e-4);
  }
  EXPECT_FALSE(space.point_of(with_planes({0.5 * nearest, 5e3})));
  EXPECT_FALSE(space.point_of(with_planes({0.0, 5e3})));
}

TEST(DesignSpace, RefusesBadDistancesAndNamesTheirKey) {
  const Domain good = ValueRange{5e3, 60e3};
  for (const ValueRange& bad : std::vector<ValueRange>{
           {60e3, 5e3}, {5e3, 5e3}, {0.0, 5e3}, {-5e3, 5e3}, {-60e3, -5e3}, {nan, 5e3}}) {
    EXPECT_THAT(refusal(Layout::symmetric, {{"z_near", bad}}),
                AllOf(StartsWith("search.z_near = "), HasSubstr("0 < min < max")));
    EXPECT_THAT(refusal(Layout::symmetric, {{"z_near", good}, {"z_far", bad}}),
                StartsWith("search.z_far = "));
  }
  for (const ValueRange& bad : std::vector<ValueRange>{
           {60e3, 5e3}, {5e3, 5e3}, {0.0, 5e3}, {-5e3, 0.0}, {nan, 5e3}, {5e3, nan}}) {
    EXPECT_THAT(refusal(Layout::free, {{"z1", good}, {"z2", bad}}),
                AllOf(StartsWith("search.z2 = "), HasSubstr("min < max")));
  }
  EXPECT_EQ(refusal(Layout::symmetric, {{"z_near", good}, {"z_far", good}}), "");
  EXPECT_THAT(refusal(Layout::symmetric, {{"z_near", std::vector{5e3, -5e3}}}),
              StartsWith("search.z_near = -5000: above 0"));
}

TEST(DesignSpace, RefusesRangesWhereNoDesignIsValid) {
  // The Fresnel number is 0.1 at 4,699 km.
  EXPECT_THAT(refusal(Layout::symmetric, {{"z_far", ValueRange{80e3, 5e6}}}),
              AllOf(StartsWith("search.z_far = 80000:5e+06: "), HasSubstr("+-4699 km")));
  EXPECT_THAT(refusal(Layout::free, {{"z2", ValueRange{-5e6, 60e3}}}),
              StartsWith("search.z2 = -5e+06:60000: "));
  EXPECT_THAT(refusal(Layout::free, {{"z2", std::vector{0.0, 5e6}}}),
              StartsWith("search.z2 = 5e+06"));
  EXPECT_EQ(refusal(Layout::symmetric, {{"z_far", ValueRange{80e3, 4.6e6}}}), "");
}

TEST(DesignSpace, RefusesWhatDoesNotGoTogether) {
  const Domain range = ValueRange{5e3, 60e3};
  EXPECT_THAT(refusal(Layout::free, {{"z_near", range}}),
              AllOf(StartsWith("search.z_near = 5000:60000"), HasSubstr("layout = symmetric")));
  EXPECT_THAT(refusal(Layout::symmetric, {{"z1", range}}), HasSubstr("search.layout = free"));
  EXPECT_THAT(refusal(Layout::free, {{"z5", range}}), HasSubstr("at most 4 planes"));
  EXPECT_THAT(refusal(Layout::symmetric, {{"z_third", range}}), HasSubstr("at most 4 planes"));
  EXPECT_EQ(refusal(Layout::symmetric, {{"z_third", range}}, {4, 5}), "");
  EXPECT_THAT(refusal(Layout::free, {}, {1}), StartsWith("search.plane_count = 1"));
  EXPECT_THAT(refusal(Layout::free, {}, {7}), StartsWith("search.plane_count = 7"));
  EXPECT_THAT(refusal(Layout::free, {{"pupil_pixels", ValueRange{16, 64}}}), HasSubstr("a list"));
  EXPECT_THAT(refusal(Layout::free, {{"initial_guess", ValueRange{0, 1}}}), HasSubstr("a list"));
  EXPECT_THAT(refusal(Layout::free, {{"relaxation", ValueRange{0.0, 0.5, Scale::logarithmic}}}),
              HasSubstr("above 0 on a logarithmic scale"));
  EXPECT_THAT(refusal(Layout::free, {{"relaxation", ValueRange{0.0, 0.5}},
                                     {"relaxation_end", ValueRange{0.0, 0.5}}}),
              HasSubstr("either relaxation, or"));
}

TEST(DesignKey, TellsDesignsApartToSevenDigits) {
  const auto key_of = [](const std::vector<double>& planes) {
    return design_key(with_planes(planes));
  };
  EXPECT_THAT(key_of({-47e3, 47e3, -180e3, 180e3}), StartsWith("-47000,47000,-180000,180000;"));
  EXPECT_EQ(key_of({-47e3, 47e3, -180e3, 180e3}),
            key_of({-47e3, 47e3, -180e3 - 1e-5, 180e3 + 1e-5}));
  EXPECT_NE(key_of({-47e3, 47e3, -180e3, 180e3}), key_of({47e3, -47e3, -180e3, 180e3}));
  EXPECT_NE(key_of({-47e3, 47e3, -180e3, 180e3}), key_of({-47e3, 47e3, -180e3 - 1, 180e3 + 1}));
  for (const DesignField& property : design_properties()) {
    SensorDesign design;
    const std::string before = design_key(design);
    property.set(design, property.get(design) + 1.0);
    EXPECT_NE(design_key(design), before) << property.variable;
  }

  // The pairs exchanged: another point, and the same planes.
  const DesignSpace space = symmetric({});
  const std::string key = design_key(space.design({0, Eigen::Vector3d(-3.0, -1.5, 0.0)}));
  int same = 0;
  for (int order = 0; order < 24; ++order) {
    if (design_key(space.design({0, Eigen::Vector3d(-1.5, -3.0, order)})) == key) ++same;
  }
  EXPECT_EQ(same, 1);
}

TEST(ExactText, TellsEveryTwoDesignsApart) {
  std::vector<SensorDesign> designs(17);
  designs[1].planes[0] = std::nextafter(designs[0].planes[0], 0.0);
  designs[2].detector.pupil_pixels = 32;
  designs[3].detector.window = 3.0;
  designs[4].detector.photons = 1e5;
  designs[5].detector.read_noise = 1.0;
  designs[6].detector.photon_rate = 1e5;
  designs[7].detector.exposure = 1e-3;
  designs[8].reconstruction.max_loops = 21;
  designs[9].reconstruction.tolerance = 2e-9;
  designs[10].reconstruction.stopping = StoppingRule::rms_change;
  designs[11].reconstruction.relaxation_start = 0.1;
  designs[12].reconstruction.relaxation_end = 0.1;
  designs[13].reconstruction.initial_guess = InitialGuess::centroid;
  designs[14].reconstruction.window = 4.0;
  designs[15].reconstruction.outside = OutsideDetector::zero;
  designs[16].reconstruction.oversampling = 2;
  SensorDesign& last = designs.emplace_back();
  last.reconstruction.unwrapping = UnwrappingMethod::quality_guided;
  std::set<std::string> texts;
  for (const SensorDesign& design : designs) texts.insert(exact_text(design));
  EXPECT_EQ(texts.size(), designs.size());
  EXPECT_EQ(exact_text(SensorDesign()), exact_text(designs[0]));
}

}  // namespace
}  // namespace nlcwfs
