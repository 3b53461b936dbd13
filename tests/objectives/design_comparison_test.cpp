// Tests: Two designs are told apart, screen by screen.
#include "objectives/design_comparison.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TriedDesign with_costs(std::vector<double> costs) { return {{}, {}, std::move(costs)}; }

TEST(Improvement, IsPairedScreenByScreen) {
  // The screens differ by 100, the designs by 1 +- 0.5 on each: only pairs see it.
  const Improvement found = improvement(with_costs({100.0, 200.5, 300.0, 400.5}),
                                        with_costs({101.5, 201.0, 301.5, 401.0}));
  EXPECT_DOUBLE_EQ(found.cost.mean, 1.0);
  // Differences 1.5, 0.5, 1.5, 0.5: variance 1/3 over n - 1, over 4 screens.
  EXPECT_DOUBLE_EQ(found.cost.standard_error, std::sqrt(1.0 / 12.0));
  EXPECT_EQ(found.verdict, Verdict::better);
}

TEST(Improvement, IsAntisymmetric) {
  const TriedDesign one = with_costs({1.0, 2.0, 3.5});
  const TriedDesign other = with_costs({2.0, 3.1, 4.4});
  const Improvement there = improvement(one, other);
  const Improvement back = improvement(other, one);
  EXPECT_DOUBLE_EQ(there.cost.mean, -back.cost.mean);
  EXPECT_DOUBLE_EQ(there.cost.standard_error, back.cost.standard_error);
  EXPECT_EQ(there.verdict, Verdict::better);
  EXPECT_EQ(back.verdict, Verdict::worse);
}

TEST(Improvement, WithinStudentsQuantileIsChance) {
  // Differences mean +- 1 on n screens; the quantiles are those of printed tables.
  const auto verdict_at = [](int screens, double standard_errors) {
    std::vector<double> reference(static_cast<std::size_t>(screens));
    const double mean = standard_errors / std::sqrt(screens - 1.0);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      reference[i] = mean + (i % 2 == 0 ? 1.0 : -1.0);
    }
    return improvement(with_costs(std::vector<double>(reference.size(), 0.0)),
                       with_costs(reference))
        .verdict;
  };
  for (const auto& [screens, quantile] : {std::pair{2, 12.706}, {4, 3.182}, {64, 1.998}}) {
    EXPECT_EQ(verdict_at(screens, 0.999 * quantile), Verdict::indistinguishable) << screens;
    EXPECT_EQ(verdict_at(screens, -0.999 * quantile), Verdict::indistinguishable) << screens;
    EXPECT_EQ(verdict_at(screens, 1.001 * quantile), Verdict::better) << screens;
    EXPECT_EQ(verdict_at(screens, -1.001 * quantile), Verdict::worse) << screens;
  }
}

TEST(Improvement, OfADesignOnItselfIsZeroAndIndistinguishable) {
  const TriedDesign design = with_costs({1.0, 5.0, 2.0});
  const Improvement found = improvement(design, design);
  EXPECT_EQ(found.cost.mean, 0.0);
  EXPECT_EQ(found.cost.standard_error, 0.0);
  EXPECT_EQ(found.verdict, Verdict::indistinguishable);
}

}  // namespace
}  // namespace nlcwfs
