// Tests: NLopt's algorithms, global and local.
#include "optimizer/nlopt_backend.hpp"

#include "test_problems.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

bool can_search(std::string_view algorithm, const TestProblem& problem) {
  try {
    nlopt_scope(algorithm, static_cast<int>(problem.box.size()));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

struct BackendRun {
  StageResult stage;
  std::vector<EvaluationRecord> records;
  double best = std::numeric_limits<double>::infinity();
};

BackendRun run(std::string_view algorithm, TestProblem problem, const StageOptions& options) {
  BackendRun done;
  Evaluator evaluator(problem, {.budget = 1000, .observer = [&](const EvaluationRecord& record) {
                                  done.records.push_back(record);
                                }});
  done.stage = minimize(algorithm, evaluator, {0, problem.start()}, options);
  if (evaluator.best()) done.best = evaluator.best()->cost;
  return done;
}

/// Every algorithm on every problem that it can solve.
class EveryAlgorithm : public testing::TestWithParam<std::string_view> {
 protected:
  static std::vector<TestProblem> problems() {
    std::vector<TestProblem> problems = solvable_problems();
    std::erase_if(problems, [](const auto& problem) { return !can_search(GetParam(), problem); });
    return problems;
  }
};

class EveryGlobalAlgorithm : public EveryAlgorithm {};
class EveryLocalAlgorithm : public EveryAlgorithm {};

std::vector<std::string_view> algorithms(SearchScope scope) {
  std::vector<std::string_view> names = nlopt_algorithms();
  std::erase_if(names, [&](std::string_view name) { return nlopt_scope(name, 2) != scope; });
  return names;
}

TEST_P(EveryAlgorithm, KeepsWithinItsLimitAndLosesNoBestPoint) {
  for (const TestProblem& problem : problems()) {
    SCOPED_TRACE(problem.name);
    for (const int limit : {1, 2, 7, 80, 300}) {
      const BackendRun result = run(GetParam(), problem, {.max_evaluations = limit});
      EXPECT_LE(result.stage.evaluations, limit);
      EXPECT_EQ(result.stage.evaluations, static_cast<int>(result.records.size()));
      EXPECT_TRUE(result.stage.finished || result.stage.evaluations == limit);
      double lowest = std::numeric_limits<double>::infinity();
      for (const EvaluationRecord& record : result.records) {
        if (record.failure.empty()) lowest = std::min(lowest, record.cost);
        for (std::size_t i = 0; i < problem.box.size(); ++i) {
          EXPECT_GE(record.point.x[i], problem.box[i].lower);
          EXPECT_LE(record.point.x[i], problem.box[i].upper);
        }
      }
      EXPECT_EQ(result.best, lowest);
      EXPECT_GE(result.best, problem.minimum - 1e-5);
    }
  }
}

TEST_P(EveryAlgorithm, TakesTheSamePathWithTheSameSeedInAnyThread) {
  for (const TestProblem& problem : problems()) {
    SCOPED_TRACE(problem.name);
    const BackendRun first = run(GetParam(), problem, {.max_evaluations = 80, .seed = 3});
    BackendRun second;
    std::thread([&] {
      second = run(GetParam(), problem, {.max_evaluations = 80, .seed = 3});
    }).join();
    ASSERT_EQ(first.records.size(), second.records.size());
    for (std::size_t i = 0; i < first.records.size(); ++i) {
      ASSERT_EQ(first.records[i].key, second.records[i].key);
    }
  }
}

TEST_P(EveryAlgorithm, IsResumedByAHigherLimit) {
  TestProblem problem = nan_region();
  std::vector<std::string> keys;
  Evaluator evaluator(problem,
                      {.observer = [&](const auto& record) { keys.push_back(record.key); }});
  for (const int limit : {20, 15}) {
    minimize(GetParam(), evaluator, {0, problem.start()}, {.max_evaluations = limit});
  }
  std::vector<std::string> keys_at_once;
  for (const auto& record : run(GetParam(), problem, {.max_evaluations = 35}).records) {
    keys_at_once.push_back(record.key);
  }
  EXPECT_EQ(keys, keys_at_once);
}

TEST_P(EveryAlgorithm, FindsTheBottomOfABowl) {
  // Evolution strategies do not narrow in on it.
  const bool coarse = GetParam() == "isres" || GetParam() == "esch";
  const BackendRun result = run(GetParam(), rotated_bowl(), {.max_evaluations = 400});
  EXPECT_NEAR(result.best, 2.0, coarse ? 0.1 : 1e-3);
}

TEST_P(EveryAlgorithm, FindsALowestPointOnTheBounds) {
  const bool coarse = GetParam() == "isres" || GetParam() == "esch";
  for (const TestProblem& problem : {lowest_on_a_bound(), lowest_in_a_corner()}) {
    SCOPED_TRACE(problem.name);
    const BackendRun result = run(GetParam(), problem, {.max_evaluations = 400});
    EXPECT_NEAR(result.best, problem.minimum, coarse ? 0.6 : 5e-3);
  }
}

TEST_P(EveryGlobalAlgorithm, FindsTheRegionOfTheLowestPoint) {
  struct Goal {
    TestProblem problem;
    double gap;  // of the order of a hundredth of the costs' range in the box
  };
  const std::vector<Goal> goals{{one_variable(), 0.02}, {branin(), 0.5},    {rastrigin(), 0.05},
                                {rosenbrock(), 1.0},    {levy(4), 1.0},     {hartmann(), 0.6},
                                {nan_region(), 0.2},    {noisy_bowl(), 0.2}};
  for (const Goal& goal : goals) {
    SCOPED_TRACE(goal.problem.name);
    for (const std::uint64_t seed : {1, 2, 3}) {
      const BackendRun result =
          run(GetParam(), goal.problem, {.max_evaluations = 1000, .seed = seed});
      EXPECT_LT(result.best - goal.problem.minimum, goal.gap) << "seed " << seed;
    }
  }
}

TEST_P(EveryLocalAlgorithm, EndsByItsTolerance) {
  for (const TestProblem& problem : problems()) {
    SCOPED_TRACE(problem.name);
    const BackendRun result = run(GetParam(), problem, {.max_evaluations = 600});
    EXPECT_TRUE(result.stage.finished);
    const BackendRun longer = run(GetParam(), problem, {.max_evaluations = 900});
    EXPECT_EQ(longer.stage.evaluations, result.stage.evaluations);
  }
}

TEST_P(EveryAlgorithm, EndsWhereEveryDesignIsKnown) {
  TestProblem problem = rotated_bowl();
  problem.key_of = [](const SearchPoint& point) { return fmt::format("{:.1f}", point.x[0]); };
  Evaluator evaluator(problem, {.budget = 1000});
  minimize(GetParam(), evaluator, {0, problem.start()}, {.max_evaluations = 50});
  EXPECT_LE(evaluator.evaluations(), 16);  // 3.5 to 5.0
}

TEST_P(EveryAlgorithm, LetsTheEvaluatorsExceptionsThrough) {
  TestProblem problem = rotated_bowl();
  const Eigen::VectorXd start = problem.start();
  Evaluator observed(problem, {.observer = [](const EvaluationRecord& record) {
                       if (record.index == 5) throw std::domain_error("disk full");
                     }});
  EXPECT_THROW(minimize(GetParam(), observed, {0, start}, {}), std::domain_error);
  EXPECT_EQ(problem.calls, 5);

  Evaluator limited(problem, {.budget = 5});
  EXPECT_THROW(minimize(GetParam(), limited, {0, start}, {}), SearchStopped);
  EXPECT_EQ(limited.evaluations(), 5);
}

TEST_P(EveryAlgorithm, SurvivesAProblemWithoutAnyCost) {
  TestProblem problem = all_failing();
  Evaluator evaluator(problem, {});
  try {
    minimize(GetParam(), evaluator, {0, problem.start()}, {});
  } catch (const SearchFailed&) {
    EXPECT_EQ(problem.calls, FailureCount::allowed_in_a_row);
  }
  EXPECT_LE(problem.calls, FailureCount::allowed_in_a_row);
  EXPECT_EQ(evaluator.failures(), problem.calls);
  EXPECT_FALSE(evaluator.best());
}

TEST_P(EveryAlgorithm, StartsFromCornersOfTheBox) {
  for (const double corner : {0.0, 1.0}) {
    TestProblem problem = choices();
    Evaluator evaluator(problem, {});
    minimize(GetParam(), evaluator, {7, Eigen::Vector2d(corner, corner)}, {.max_evaluations = 60});
    ASSERT_TRUE(evaluator.best_of_slice({7, {}}));
    EXPECT_FALSE(evaluator.best_of_slice({0, {}}));
    EXPECT_LT(evaluator.best_of_slice({7, {}})->cost,
              problem.function(7, Eigen::Vector2d(corner, corner)));
  }
}

constexpr auto name_of = [](const auto& test) { return std::string(test.param); };
INSTANTIATE_TEST_SUITE_P(Nlopt, EveryAlgorithm, testing::ValuesIn(nlopt_algorithms()), name_of);
INSTANTIATE_TEST_SUITE_P(Nlopt, EveryGlobalAlgorithm,
                         testing::ValuesIn(algorithms(SearchScope::global)), name_of);
INSTANTIATE_TEST_SUITE_P(Nlopt, EveryLocalAlgorithm,
                         testing::ValuesIn(algorithms(SearchScope::local)), name_of);

TEST(NloptBackend, DrawsOtherRandomNumbersWithAnotherSeed) {
  for (const auto* algorithm : {"direct_l_rand", "crs2", "isres", "esch"}) {
    SCOPED_TRACE(algorithm);
    const auto keys = [&](std::uint64_t seed) {
      std::vector<std::string> path;
      const BackendRun done = run(algorithm, hartmann(), {.max_evaluations = 100, .seed = seed});
      for (const EvaluationRecord& record : done.records) path.push_back(record.key);
      return path;
    };
    EXPECT_NE(keys(1), keys(2));
  }
}

TEST(NloptBackend, SpendsAllItIsGivenWhereTheAlgorithmHasNoTolerance) {
  for (const auto* algorithm : {"mlsl", "isres", "esch"}) {
    SCOPED_TRACE(algorithm);
    for (const TestProblem& problem : {one_variable(), rotated_bowl(), hartmann()}) {
      SCOPED_TRACE(problem.name);
      const BackendRun result = run(algorithm, problem, {.max_evaluations = 900});
      EXPECT_FALSE(result.stage.finished);
      EXPECT_EQ(result.stage.evaluations, 900);
    }
  }
}

TEST(NloptBackend, KnowsTheScopeOfItsAlgorithms) {
  for (const auto* global : {"direct_l", "direct_l_rand", "crs2", "mlsl", "isres", "esch"}) {
    EXPECT_EQ(nlopt_scope(global, 1), SearchScope::global);
  }
  for (const auto* local : {"sbplx", "nelder_mead", "bobyqa", "cobyla", "praxis"}) {
    EXPECT_EQ(nlopt_scope(local, 2), SearchScope::local);
  }
}

TEST(NloptBackend, RefusesWhatItCannotSolveBeforeItStarts) {
  const auto message_of = [](const std::string& algorithm) -> std::string {
    TestProblem problem = one_variable();
    Evaluator evaluator(problem, {});
    try {
      minimize(algorithm, evaluator, {0, Eigen::VectorXd::Zero(1)}, {});
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(problem.calls, 0);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of("bobyqa"),
            "bobyqa needs at least 2 continuous variables, this problem has 1: take sbplx");
  EXPECT_EQ(message_of("praxis"),
            "praxis needs at least 2 continuous variables, this problem has 1: take sbplx");
  EXPECT_EQ(
      message_of("newuoa"),
      "newuoa is no optimizer: there are dlib, direct_l, direct_l_rand, crs2, mlsl, isres, esch, "
      "sbplx, nelder_mead, bobyqa, cobyla, praxis");
  EXPECT_EQ(message_of("sbplx"), "");
}

}  // namespace
}  // namespace nlcwfs
