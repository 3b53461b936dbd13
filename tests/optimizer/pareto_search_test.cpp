// Tests: Several objectives are minimised at once.
#include "optimizer/pareto_search.hpp"

#include "test_problems.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  return a != b && std::ranges::equal(a, b, std::ranges::less_equal{});
}

EvaluatedDesign design(std::vector<double> objectives) {
  EvaluatedDesign result;
  result.objectives = std::move(objectives);
  return result;
}

std::vector<std::vector<double>> objectives_of(const std::vector<EvaluatedDesign>& designs) {
  std::vector<std::vector<double>> all;
  all.reserve(designs.size());
  for (const EvaluatedDesign& each : designs) all.push_back(each.objectives);
  return all;
}

struct ParetoRun {
  ParetoResult result;
  std::vector<EvaluationRecord> records;

  std::vector<std::string> keys() const {
    std::vector<std::string> all;
    for (const EvaluationRecord& record : records) all.push_back(record.key);
    return all;
  }
};

ParetoRun run(TestProblem problem, ParetoOptions options) {
  ParetoRun done;
  options.evaluation.observer = [&](const auto& record) { done.records.push_back(record); };
  done.result = pareto_search(problem, options);
  return done;
}

/// The objectives of all designs that keep the limits and that none dominates, in order.
std::vector<std::vector<double>> front_of(const std::vector<EvaluationRecord>& records) {
  std::vector<std::vector<double>> all;
  for (const EvaluationRecord& record : records) {
    if (record.failure.empty() && record.violation == 0.0) all.push_back(record.objectives);
  }
  std::vector<std::vector<double>> front;
  for (const auto& one : all) {
    if (std::ranges::none_of(all, [&](const auto& other) { return dominates(other, one); })) {
      front.push_back(one);
    }
  }
  std::ranges::sort(front);
  front.erase(std::unique(front.begin(), front.end()), front.end());
  return front;
}

class EveryParetoAlgorithm : public testing::TestWithParam<std::string_view> {
 protected:
  static ParetoOptions options(int budget, std::uint64_t seed = 1) {
    return {.algorithm = std::string(GetParam()), .seed = seed, .evaluation = {.budget = budget}};
  }
};

TEST_P(EveryParetoAlgorithm, ReportsTheFrontOfAllThatItEvaluatedWithinTheBudget) {
  for (const TestProblem& problem : pareto_problems()) {
    SCOPED_TRACE(problem.name);
    for (const int budget : {1, 10, 100, 300}) {
      const auto [result, records] = run(problem, options(budget));
      EXPECT_EQ(result.evaluations, budget);
      EXPECT_EQ(result.termination, Termination::budget_exhausted);
      EXPECT_EQ(objectives_of(result.front), front_of(records));
      for (const EvaluatedDesign& each : result.front) {
        EXPECT_EQ(each.violation, 0.0);
        EXPECT_EQ(each.key, problem.key(each.point));
        EXPECT_EQ(each.objectives, problem.objectives(each.point));
      }
    }
  }
}

TEST_P(EveryParetoAlgorithm, TakesTheSamePathWithTheSameSeedInAnyThread) {
  for (const TestProblem& problem : pareto_problems()) {
    SCOPED_TRACE(problem.name);
    const ParetoRun first = run(problem, options(150, 3));
    ParetoRun second;
    std::thread([&] {
      const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
      second = run(problem, options(150, 3));
    }).join();
    EXPECT_EQ(first.keys(), second.keys());
    EXPECT_EQ(objectives_of(first.result.front), objectives_of(second.result.front));
    EXPECT_NE(first.keys(), run(problem, options(150, 4)).keys());
  }
}

TEST_P(EveryParetoAlgorithm, ComesCloseToAKnownFront) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const ParetoRun done = run(zdt1(), options(600, seed));
    // Under the front's curve lies 1/3 of the unit square.
    const double whole = 1.1 * 1.1 - 1.0 / 3.0;
    const double found = hypervolume(done.result.front, {1.1, 1.1});
    EXPECT_LT(found, whole);
    EXPECT_GT(found, 0.88 * whole);
    for (const EvaluatedDesign& each : done.result.front) {
      EXPECT_GE(each.objectives[1], 1.0 - std::sqrt(each.objectives[0]) - 1e-12);
    }
  }
}

TEST_P(EveryParetoAlgorithm, FindsTheWholeFrontOfAFewDesignsAndEnds) {
  TestProblem problem = with_size(whole_numbers());
  problem.box = {{"n", 18.0, 23.0, VariableKind::integer},
                 {"m", 3.0, 7.0, VariableKind::integer},
                 {"kind", 2.0, 3.0, VariableKind::categorical}};
  const ParetoRun done = run(problem, options(1000));
  EXPECT_EQ(done.result.termination, Termination::converged);
  std::vector<EvaluationRecord> all;
  for (int n = 18; n <= 23; ++n) {
    for (int m = 3; m <= 7; ++m) {
      for (int kind = 2; kind <= 3; ++kind) {
        EvaluationRecord record;
        record.objectives = problem.objectives({0, Eigen::Vector3d(n, m, kind)});
        all.push_back(record);
      }
    }
  }
  EXPECT_EQ(objectives_of(done.result.front), front_of(all));
}

TEST_P(EveryParetoAlgorithm, SharesTheBudgetAmongSubSpacesAndTakesTheStarts) {
  const TestProblem problem = with_size(sensors());
  ParetoOptions with_starts = options(300);
  Eigen::VectorXd x(6);
  x << 4.0, 4.1, 4.2, 4.3, 5.0, 1.0;
  with_starts.starts = {{2, x}, {0, problem.start()}};
  const ParetoRun done = run(problem, with_starts);
  std::vector<int> counts(3, 0);
  for (const EvaluationRecord& record : done.records) {
    ++counts[static_cast<std::size_t>(record.point.sub_space)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 100, with_starts.population);
  EXPECT_EQ(done.records[0].point.x, problem.start());
  EXPECT_EQ(done.records[32].point.x, x);
}

TEST_P(EveryParetoAlgorithm, EndsWithTheFrontSoFarWhereItIsStopped) {
  std::stop_source source;
  std::vector<EvaluationRecord> records;
  TestProblem problem = with_size(failing_sensors());
  ParetoOptions stopped = options(1000);
  stopped.evaluation.stop = source.get_token();
  stopped.evaluation.observer = [&](const EvaluationRecord& record) {
    records.push_back(record);
    if (record.index == 90) source.request_stop();
  };
  const ParetoResult result = pareto_search(problem, stopped);
  EXPECT_EQ(result.termination, Termination::stop_requested);
  EXPECT_LT(result.evaluations, 98);  // the rest of a batch
  EXPECT_EQ(objectives_of(result.front), front_of(records));
  EXPECT_EQ(result.failures, std::ranges::count_if(records, [](const EvaluationRecord& record) {
              return !record.failure.empty();
            }));
  EXPECT_GT(result.failures, 0);

  ParetoOptions timed = options(1000);
  timed.evaluation.time_limit = 0.0;
  EXPECT_EQ(pareto_search(problem, timed).termination, Termination::time_limit);
}

TEST_P(EveryParetoAlgorithm, LetsTheObserversExceptionsThrough) {
  for (const int index : {1, 20, 60, 100}) {
    TestProblem problem = with_size(sensors());
    ParetoOptions observed = options(200);
    observed.evaluation.observer = [&](const EvaluationRecord& record) {
      if (record.index == index) throw std::domain_error("disk full");
    };
    EXPECT_THROW(pareto_search(problem, observed), std::domain_error);
  }
}

TEST_P(EveryParetoAlgorithm, FailsWhereNoDesignHasACost) {
  TestProblem problem = all_failing();
  EXPECT_THROW(pareto_search(problem, options(100)), SearchFailed);
  problem.box = {{"n", 0.0, 4.0, VariableKind::integer}};
  problem.calls = 0;
  EXPECT_THROW(pareto_search(problem, options(100)), SearchFailed);
  EXPECT_LE(problem.calls, 5);
}

TEST_P(EveryParetoAlgorithm, TakesAnObjectiveThatIsNoNumberForAFailure) {
  TestProblem problem = zdt1();
  problem.objectives = [exact = problem.objectives](const SearchPoint& point) {
    std::vector<double> objectives = exact(point);
    if (point.x[1] < 0.3) objectives[1] = std::numeric_limits<double>::quiet_NaN();
    return objectives;
  };
  const ParetoRun done = run(problem, options(200));
  EXPECT_GT(done.result.failures, 0);
  ASSERT_FALSE(done.result.front.empty());
  for (const EvaluatedDesign& each : done.result.front) EXPECT_GE(each.point.x[1], 0.3);
}

INSTANTIATE_TEST_SUITE_P(ParetoSearch, EveryParetoAlgorithm, testing::ValuesIn(pareto_algorithms()),
                         [](const auto& test) { return std::string(test.param); });

TEST(ParetoSearch, RefusesWhatItCannotDoBeforeAnyEvaluation) {
  TestProblem problem = zdt1();
  const auto message_of = [&](const ParetoOptions& options) -> std::string {
    try {
      pareto_search(problem, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of({.algorithm = "moead"}),
            "moead is no optimizer for several objectives: there are nsga2, nspso");
  EXPECT_EQ(message_of({.population = 4}),
            "a population of 4 does not suit nsga2: take a multiple of 4, at least 8");
  EXPECT_EQ(message_of({.algorithm = "nspso", .population = 18}),
            "a population of 18 does not suit nspso: take a multiple of 4, at least 8");
  EXPECT_EQ(problem.calls, 0);
}

TEST(Hypervolume, IsTheVolumeBetweenTheFrontAndTheReference) {
  EXPECT_DOUBLE_EQ(hypervolume({design({1.0, 2.0}), design({2.0, 1.0})}, {3.0, 3.0}), 3.0);
  EXPECT_DOUBLE_EQ(hypervolume({design({0.0, 0.0, 0.0})}, {1.0, 2.0, 3.0}), 6.0);
  EXPECT_DOUBLE_EQ(
      hypervolume({design({0.0, 1.0, 1.0}), design({1.0, 0.0, 1.0}), design({1.0, 1.0, 0.0})},
                  {2.0, 2.0, 2.0}),
      4.0);
}

TEST(Hypervolume, LeavesOutWhatDoesNotDominateTheReference) {
  EXPECT_EQ(hypervolume({}, {1.0, 1.0}), 0.0);
  EXPECT_EQ(hypervolume({design({1.0, 0.0}), design({0.0, 5.0})}, {1.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(hypervolume({design({0.0, 5.0}), design({0.5, 0.5})}, {1.0, 1.0}), 0.25);
}

TEST(Knee, IsFarthestBelowTheChord) {
  // After division by the ranges, 10 and 1000: (0, 1), (0.2, 0.3), (0.5, 0.2), (1, 0).
  EXPECT_EQ(knee({design({0.0, 1000.0}), design({2.0, 300.0}), design({5.0, 200.0}),
                  design({10.0, 0.0})}),
            1u);
  EXPECT_EQ(knee({design({0.0, 1.0, 1.0}), design({1.0, 0.0, 1.0}), design({1.0, 1.0, 0.0}),
                  design({0.5, 0.4, 0.4})}),
            3u);
}

TEST(Knee, OfDegenerateFronts) {
  EXPECT_EQ(knee({design({3.0, 4.0})}), 0u);
  EXPECT_EQ(knee({design({0.0, 1.0}), design({1.0, 0.0})}), 0u);
  EXPECT_EQ(knee({design({1.0, 7.0, 3.0}), design({2.0, 7.0, 1.0}), design({1.2, 7.0, 1.3})}), 2u);
  // Bent away from the best point: an extreme design.
  EXPECT_EQ(knee({design({0.0, 1.0}), design({0.8, 0.8}), design({1.0, 0.0})}), 0u);
}

TEST(Dominated, IsWhatAnotherBettersInOneObjectiveAndEqualsInTheOthers) {
  EXPECT_THAT(dominated({{1.0, 2.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 3.0}, {0.5, 9.0}}),
              ElementsAre(false, false, true, true, false));
  EXPECT_TRUE(dominated({}).empty());
}

TEST(Dominated, AreAllButTheFirstOfEqualDesigns) {
  EXPECT_THAT(dominated({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}), ElementsAre(false, true, true));
  EXPECT_THAT(dominated({{1.0, 1.0}, {0.5, 1.0}, {0.5, 1.0}}), ElementsAre(true, false, true));
}

TEST(EvenlyChosen, TakesAllWhereAllFit) {
  EXPECT_THAT(evenly_chosen({"a", "b", "a"}, 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenly_chosen({"a", "b", "a"}, 99), ElementsAre(0, 1, 2));
  EXPECT_TRUE(evenly_chosen({}, 5).empty());
}

TEST(EvenlyChosen, SharesAmongGroupsAndSpreadsOverEach) {
  // 10 of a, 2 of b, 1 of c.
  std::vector<std::string> groups(10, "a");
  groups.insert(groups.end(), {"b", "b", "c"});
  EXPECT_THAT(evenly_chosen(groups, 7), ElementsAre(0, 3, 6, 9, 10, 11, 12));
  EXPECT_THAT(evenly_chosen(groups, 3), ElementsAre(0, 10, 12));
  EXPECT_THAT(evenly_chosen(groups, 2), ElementsAre(0, 10));
  for (std::size_t most = 0; most <= groups.size(); ++most) {
    const std::vector<std::size_t> chosen = evenly_chosen(groups, most);
    EXPECT_EQ(std::set<std::size_t>(chosen.begin(), chosen.end()).size(), most);
  }
}

}  // namespace
}  // namespace nlcwfs
