// Tests: Generations of designs for several objectives: a genetic algorithm and a particle swarm.
#include "optimizer/pareto_algorithms.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::DoubleEq;
using testing::Each;
using testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();
using Objectives = std::vector<double> (*)(const std::vector<double>&);

std::vector<double> zdt1_of(const std::vector<double>& x) {
  const double g = 1.0 + 3.0 * (x[1] + x[2] + x[3]);
  return {x[0], g * (1.0 - std::sqrt(x[0] / g))};
}

/// Deb, Thiele, Laumanns & Zitzler 2002: three objectives whose front is an eighth of a sphere.
std::vector<double> dtlz2_of(const std::vector<double>& x) {
  const double g = (x[2] - 0.5) * (x[2] - 0.5) + (x[3] - 0.5) * (x[3] - 0.5);
  const double a = 0.5 * std::numbers::pi * x[0];
  const double b = 0.5 * std::numbers::pi * x[1];
  return {(1.0 + g) * std::cos(a) * std::cos(b), (1.0 + g) * std::cos(a) * std::sin(b),
          (1.0 + g) * std::sin(a)};
}

/// All designs that 15 generations propose.
std::vector<std::vector<double>> path(const std::string& algorithm, Objectives objectives,
                                      const std::vector<double>& flat) {
  const auto generation_of = [&](const std::vector<std::vector<double>>& x) {
    Generation generation{x, {}};
    for (const std::vector<double>& design : x) {
      generation.objectives.push_back(objectives(design));
      generation.objectives.back().insert(generation.objectives.back().begin(), flat.begin(),
                                          flat.end());
    }
    return generation;
  };
  std::vector<std::vector<double>> first;
  for (int i = 0; i < 16; ++i) {
    first.push_back({i / 15.0, i * 7 % 16 / 15.0, i * 11 % 16 / 15.0, i * 5 % 16 / 15.0});
  }
  const auto searched = pareto_algorithm(
      algorithm, {.bounds = {std::vector(4, 0.0), std::vector(4, 1.0)}}, generation_of(first), 7);
  std::vector<std::vector<double>> all;
  for (int i = 0; i < 15; ++i) {
    const std::vector<std::vector<double>> proposed = searched->propose();
    EXPECT_EQ(proposed.size(), first.size());
    all.insert(all.end(), proposed.begin(), proposed.end());
    searched->accept(generation_of(proposed));
  }
  return all;
}

TEST(CrowdingDistance, IsTheNeighboursDistanceInFractionsOfTheRanges) {
  EXPECT_THAT(
      crowding_distances({{1.0, 9.0}, {2.0, 7.0}, {4.0, 4.0}, {7.0, 3.0}, {9.0, 1.0}}),
      ElementsAre(infinity, DoubleEq(3.0 / 8.0 + 5.0 / 8.0), DoubleEq(5.0 / 8.0 + 4.0 / 8.0),
                  DoubleEq(5.0 / 8.0 + 3.0 / 8.0), infinity));
}

TEST(CrowdingDistance, AnObjectiveThatIsEqualThroughoutAddsNothing) {
  const auto crowding = crowding_distances(
      {{1.0, 9.0, 4.0}, {2.0, 7.0, 4.0}, {4.0, 4.0, 4.0}, {7.0, 3.0, 4.0}, {9.0, 1.0, 4.0}});
  EXPECT_EQ(crowding,
            crowding_distances({{1.0, 9.0}, {2.0, 7.0}, {4.0, 4.0}, {7.0, 3.0}, {9.0, 1.0}}));
}

TEST(CrowdingDistance, OfEqualDesignsIsNone) {
  EXPECT_THAT(crowding_distances({{3.0, 4.0}, {3.0, 4.0}, {3.0, 4.0}}), Each(0.0));
  EXPECT_THAT(crowding_distances({{3.0, 4.0}}), ElementsAre(0.0));
}

TEST(ParetoAlgorithms, AnObjectiveThatIsEqualThroughoutChangesNothing) {
  for (const std::string_view name : pareto_algorithms()) {
    const std::string algorithm(name);
    for (const Objectives objectives : {zdt1_of, dtlz2_of}) {
      EXPECT_EQ(path(algorithm, objectives, {4.0}), path(algorithm, objectives, {})) << name;
      EXPECT_EQ(path(algorithm, objectives, {4.0, -1e6}), path(algorithm, objectives, {})) << name;
    }
  }
}

TEST(ParetoAlgorithms, StayWithinTheirBounds) {
  for (const std::string_view name : pareto_algorithms()) {
    for (const std::vector<double>& x : path(std::string(name), zdt1_of, {})) {
      EXPECT_THAT(x, Each(testing::AllOf(testing::Ge(0.0), testing::Le(1.0)))) << name;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
