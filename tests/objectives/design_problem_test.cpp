// Tests: A design space and its trial become a problem that an optimizer sees.
#include "objectives/design_problem.hpp"

#include "optimizer/chained_search.hpp"
#include "tests/objectives/tiny_simulation.hpp"

#include <atomic>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

/// The cost in waves, so that it is the same for telescopes of all wavelengths.
DesignCost cost_in_waves(const Telescope& telescope) {
  return {.wfe_scale = telescope.wavelength / 50.0};
}

TEST(DesignProblem, CostsAreThoseOfTheTrial) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const SensorDesign design = tiny_design(telescope);
  const DesignSpace space(telescope, {.base = design});
  DesignProblem problem(space, trial);

  const Assessment found = problem.assess(space.point_of(design).value(), {});
  const std::vector<double> costs = trial.run(design).costs;
  ASSERT_EQ(found.costs.size(), costs.size());
  for (std::size_t i = 0; i < costs.size(); ++i) {
    EXPECT_NEAR(found.costs[i], costs[i], 1e-9 * costs[i]);
  }
  EXPECT_EQ(std::any_cast<TriedDesign>(found.detail).costs, found.costs);
  EXPECT_EQ(problem.key(space.point_of(design).value()), design_key(design));
}

TEST(DesignProblem, ObjectivesAreMeansToBeMinimised) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope, 4.0, 3), tiny_condition(telescope, 8.0, 3)},
                          {});
  const SensorDesign design = tiny_design(telescope);
  const DesignSpace space(telescope, {.base = design});
  const std::vector<DesignMetric> objectives{
      *find_design_metric("total_wfe_nm"), *find_design_metric("field_strehl"),
      *find_design_metric("detector_pixels"), *find_design_metric("captured_energy")};
  DesignProblem problem(space, trial, objectives);
  const Assessment found = problem.assess(space.point_of(design).value(), {});
  const auto& tried = std::any_cast<const TriedDesign&>(found.detail);
  ASSERT_EQ(found.objectives.size(), 4u);
  EXPECT_EQ(found.objectives[0], trial.mean_of(tried, objectives[0]).mean);
  EXPECT_EQ(found.objectives[1], -trial.mean_of(tried, objectives[1]).mean);
  EXPECT_LT(found.objectives[1], 0.0);
  EXPECT_EQ(found.objectives[2], 4.0 * 32 * 32);
  EXPECT_EQ(found.objectives[3], -trial.mean_of(tried, objectives[3]).mean);
}

TEST(DesignProblem, AsksWhetherToGoOnAfterTheFirstScreens) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope, 4.0, 9)}, {});
  const SensorDesign design = tiny_design(telescope);
  const DesignSpace space(telescope, {.base = design});
  DesignProblem problem(space, trial);
  std::vector<std::size_t> asked;
  const Assessment ended =
      problem.assess(space.point_of(design).value(), [&](std::span<const double> costs) {
        asked.push_back(costs.size());
        return costs.size() < 8;
      });
  EXPECT_EQ(asked, (std::vector<std::size_t>{4, 8}));
  EXPECT_EQ(ended.costs.size(), 8u);
}

/// The Fresnel numbers and costs of the designs that a search visits.
struct Visits {
  std::vector<double> fresnel_numbers;
  std::vector<double> costs;
};

Visits search_at(const Telescope& telescope) {
  const DesignTrial trial({tiny_condition(telescope)}, cost_in_waves(telescope));
  const DesignSpace space(telescope, {.base = tiny_design(telescope)});
  DesignProblem problem(space, trial);
  Visits visits;
  SearchOptions options;
  options.evaluation.budget = 40;
  options.evaluation.observer = [&](const EvaluationRecord& record) {
    for (const double plane : space.design(record.point).planes) {
      visits.fresnel_numbers.push_back(fresnel_number(telescope, plane));
    }
    visits.costs.push_back(record.cost);
  };
  search(problem, options);
  return visits;
}

TEST(DesignProblem, ASearchVisitsTheSameFresnelNumbersAtEveryTelescope) {
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

TEST(DesignProblem, EndsTheSearchWhereTheWatchEndsATrial) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope, 4.0, 9)}, {});
  const SensorDesign design = tiny_design(telescope);
  const DesignSpace space(telescope, {.base = design});
  std::atomic<int> done = 0;
  DesignProblem problem(space, trial, {}, [&] { return ++done < 9 + 2; });
  // With nine threads all screens would be begun at once.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  const SearchPoint point = space.point_of(design).value();
  EXPECT_EQ(problem.assess(point, {}).costs.size(), 9u) << "the first is done";
  EXPECT_THROW((void)problem.assess(point, {}), SearchStopped);
}

}  // namespace
}  // namespace nlcwfs
