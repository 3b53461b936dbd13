// Tests: How far each variable of the best design may move.
#include "objectives/optimum_range.hpp"

#include "objectives/design_comparison.hpp"
#include "tests/objectives/tiny_simulation.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

DesignSpace space_of_two_pairs(const Telescope& telescope) {
  return {telescope,
          {.base = tiny_design(telescope),
           .orders = {{3, 4, 1, 2}},
           .domains = {{"relaxation", ValueRange{-0.5, 0.8}}}}};
}

TEST(OptimumRange, HoldsTheBestAndEndsWhereDesignsAreWorse) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope, 4.0, 12)}, {});
  const DesignSpace space = space_of_two_pairs(telescope);
  const SearchPoint best = space.point_of(tiny_design(telescope)).value();
  const OptimumScan scan = optimum_ranges(space, trial, best);
  const std::vector<OptimumRange>& ranges = scan.ranges;
  // The best itself, and on each side of each variable one step at least.
  EXPECT_GE(scan.designs, 7);
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_EQ(ranges[0].name, "z_near");
  EXPECT_EQ(ranges[1].name, "z_far");
  EXPECT_EQ(ranges[2].name, "relaxation");

  const TriedDesign reference = trial.run(space.design(best));
  const std::vector<Variable> variables = space.sub_spaces().front().variables;
  int ends_inside = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    SCOPED_TRACE(ranges[i].name);
    EXPECT_LE(ranges[i].least, ranges[i].best * (1.0 + 1e-12));
    EXPECT_GE(ranges[i].greatest, ranges[i].best * (1.0 - 1e-12));
    for (const bool upper : {false, true}) {
      if (upper ? ranges[i].greatest_is_bound : ranges[i].least_is_bound) continue;
      ++ends_inside;
      // The end is as good as the best; a third farther on it no longer is.
      const double end = upper ? ranges[i].greatest : ranges[i].least;
      SearchPoint point = best;
      double& x = point.x[Eigen::Index(i)];
      const double centre = x;
      const auto x_of = [&](double value) {
        return variables[i].name.starts_with("log")
                   ? std::log(value) - std::log(ranges[i].best) + centre
                   : value;
      };
      x = x_of(end);
      EXPECT_NE(improvement(trial.run(space.design(point)), reference).verdict, Verdict::worse);
      if (x == centre) continue;  // already the first step is worse
      x = centre + 1.34 * (x_of(end) - centre);
      if (x <= variables[i].lower || x >= variables[i].upper) continue;
      EXPECT_EQ(improvement(trial.run(space.design(point)), reference).verdict, Verdict::worse);
    }
  }
  EXPECT_GE(ends_inside, 3) << "the test shows little";
}

TEST(OptimumRange, KeepsEveryValueThatItTried) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope, 4.0, 12)}, {});
  const DesignSpace space = space_of_two_pairs(telescope);
  const SearchPoint best = space.point_of(tiny_design(telescope)).value();
  const OptimumScan scan = optimum_ranges(space, trial, best);
  const TriedDesign reference = trial.run(space.design(best));
  int tried = 1;
  int worse = 0;
  for (const OptimumRange& range : scan.ranges) {
    SCOPED_TRACE(range.name);
    EXPECT_TRUE(std::ranges::is_sorted(range.values, {}, &ScannedValue::value));
    tried += static_cast<int>(range.values.size()) - 1;
    int of_the_best = 0;
    for (const ScannedValue& scanned : range.values) {
      SCOPED_TRACE(scanned.value);
      worse += scanned.is_worse ? 1 : 0;
      // All that is worse is outside the range, all else inside.
      EXPECT_EQ(scanned.is_worse, scanned.value < range.least || scanned.value > range.greatest);
      SensorDesign design = space.design(best);
      if (range.name == "relaxation") {
        design.reconstruction.relaxation_start = scanned.value;
        design.reconstruction.relaxation_end = scanned.value;
      } else {
        const std::size_t pair = range.name == "z_near" ? 2 : 0;
        for (const std::size_t plane : {pair, pair + 1}) {
          design.planes[plane] = std::copysign(scanned.value, design.planes[plane]);
        }
      }
      if (scanned.value == range.best) {
        ++of_the_best;
        EXPECT_EQ(scanned.cost_difference.mean, 0.0);
        EXPECT_EQ(scanned.cost_difference.standard_error, 0.0);
        continue;
      }
      const MeanAndError gain = improvement(trial.run(design), reference).cost;
      EXPECT_NEAR(scanned.cost_difference.mean, -gain.mean, 1e-6);
      EXPECT_NEAR(scanned.cost_difference.standard_error, gain.standard_error, 1e-6);
      EXPECT_GT(gain.standard_error, 0.0);
    }
    EXPECT_EQ(of_the_best, 1);
  }
  EXPECT_EQ(scan.designs, tried) << "nothing is simulated that is not kept";
  EXPECT_GE(worse, 2) << "the test shows little";
}

TEST(OptimumRange, ReportsItsShareAndEndsWithTheVariablesThatAreDone) {
  const Telescope telescope;
  const DesignTrial trial({tiny_condition(telescope)}, {});
  const DesignSpace space = space_of_two_pairs(telescope);
  const SearchPoint best = space.point_of(tiny_design(telescope)).value();
  std::vector<double> shares;
  const OptimumScan whole =
      optimum_ranges(space, trial, best, [&](double share) { shares.push_back(share); });
  EXPECT_EQ(static_cast<int>(shares.size()), whole.designs);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GT(shares.front(), 0.0);
  EXPECT_LE(shares.back(), 1.0);

  // In the second of three variables.
  bool goes_on = true;
  const OptimumScan ended = optimum_ranges(
      space, trial, best, [&](double share) { goes_on = share < 0.4; }, [&] { return goes_on; });
  ASSERT_EQ(ended.ranges.size(), 1u);
  EXPECT_EQ(ended.ranges[0].least, whole.ranges[0].least);
  EXPECT_EQ(ended.ranges[0].greatest, whole.ranges[0].greatest);
  EXPECT_LT(ended.designs, whole.designs);

  const OptimumScan none = optimum_ranges(space, trial, best, {}, [] { return false; });
  EXPECT_TRUE(none.ranges.empty());
  EXPECT_EQ(none.designs, 1);
}

}  // namespace
}  // namespace nlcwfs
