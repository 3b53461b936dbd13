#include "objectives/placement_problem.hpp"

#include "optimizer/chained_search.hpp"
#include "tests/objectives/tiny_simulation.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

SymmetricLayout default_layout(const Telescope& telescope) {
  return {telescope, default_distance_range(telescope), default_distance_range(telescope)};
}

/// The cost in waves, so that it is the same for telescopes of all wavelengths.
DesignCost cost_in_waves(const Telescope& telescope) {
  return {.wfe_scale = telescope.wavelength / 50.0};
}

TEST(PlacementProblem, CostIsTheMeanOfTheScreensCosts) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const SymmetricLayout layout = default_layout(telescope);
  const SensorDesign design = tiny_design(telescope);
  PlacementProblem problem(trial, layout, design);

  const SearchPoint point = layout.point_of(design.planes).value();
  const double found = problem.cost(point);
  const std::vector<double> costs = trial.run(problem.design(point)).costs;
  EXPECT_DOUBLE_EQ(found, (costs.at(0) + costs.at(1)) / 2.0);
  EXPECT_EQ(problem.last_tried().costs, costs);
  EXPECT_EQ(problem.last_tried().performances.front().screens.size(), 2u);
}

TEST(PlacementProblem, VariesThePlanesAlone) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const SymmetricLayout layout = default_layout(telescope);
  SensorDesign design = tiny_design(telescope);
  design.reconstruction.relaxation_start = 0.3;
  design.detector.photons = 1e5;
  const PlacementProblem problem(trial, layout, design);
  const SearchPoint point{5, Eigen::Vector2d(-3.0, -1.5)};
  const SensorDesign varied = problem.design(point);
  EXPECT_EQ(varied.planes, layout.planes(point));
  EXPECT_EQ(varied.reconstruction.relaxation_start, 0.3);
  EXPECT_EQ(varied.detector.photons, 1e5);
  EXPECT_EQ(varied.detector.pupil_pixels, design.detector.pupil_pixels);
}

TEST(PlacementProblem, EqualDesignsHaveEqualKeysAndOthersDoNot) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const SymmetricLayout layout = default_layout(telescope);
  const PlacementProblem problem(trial, layout, tiny_design(telescope));
  const auto key_of = [&](const std::vector<double>& planes) {
    return problem.key(layout.point_of(planes).value());
  };
  EXPECT_EQ(key_of({-47e3, 47e3, -180e3, 180e3}), "-47000,47000,-180000,180000");
  EXPECT_EQ(key_of({-47e3, 47e3, -180e3, 180e3}),
            key_of({-47e3, 47e3, -180e3 - 1e-5, 180e3 + 1e-5}));
  EXPECT_NE(key_of({-47e3, 47e3, -180e3, 180e3}), key_of({47e3, -47e3, -180e3, 180e3}));
  EXPECT_NE(key_of({-47e3, 47e3, -180e3, 180e3}), key_of({-47e3, 47e3, -180e3 - 1, 180e3 + 1}));

  // The pairs exchanged: another point of another choice, and the same planes.
  const SearchPoint point{0, Eigen::Vector2d(-3.0, -1.5)};
  int same = 0;
  for (int choice = 0; choice < layout.choice_count(); ++choice) {
    if (problem.key({choice, Eigen::Vector2d(-1.5, -3.0)}) == problem.key(point)) ++same;
  }
  EXPECT_EQ(same, 1);
}

/// The Fresnel numbers and costs of the designs that a search visits.
struct Visits {
  std::vector<double> fresnel_numbers;
  std::vector<double> costs;
};

Visits search_at(const Telescope& telescope) {
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const SymmetricLayout layout = default_layout(telescope);
  PlacementProblem problem(trial, layout, tiny_design(telescope));
  Visits visits;
  SearchOptions options;
  options.evaluation.budget = 40;
  options.evaluation.observer = [&](const EvaluationRecord& record) {
    for (const double plane : layout.planes(record.point)) {
      visits.fresnel_numbers.push_back(fresnel_number(telescope, plane));
    }
    visits.costs.push_back(record.cost);
  };
  search(problem, options);
  return visits;
}

TEST(PlacementProblem, ASearchVisitsTheSameFresnelNumbersAtEveryTelescope) {
  const Visits small = search_at({.diameter = 0.5, .wavelength = 532e-9});
  const Visits large = search_at({.diameter = 8.2, .wavelength = 1.06e-6});
  ASSERT_EQ(small.costs.size(), 40u);
  ASSERT_EQ(large.costs.size(), 40u);
  for (std::size_t i = 0; i < small.fresnel_numbers.size(); ++i) {
    EXPECT_NEAR(large.fresnel_numbers[i] / small.fresnel_numbers[i], 1.0, 1e-6) << i;
  }
  for (std::size_t i = 0; i < small.costs.size(); ++i) {
    EXPECT_NEAR(large.costs[i] / small.costs[i], 1.0, 1e-6) << i;
  }
}

}  // namespace
}  // namespace nlcwfs
