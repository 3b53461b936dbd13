// Tests: Costs are asked for: with budget, cache, races, and the best so far.
#include "optimizer/evaluator.hpp"

#include "test_problems.hpp"

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

SearchPoint at(double x0, double x1, int choice = 0) { return {choice, Eigen::Vector2d(x0, x1)}; }

/// x0 is the cost, over a box from -1000 to 1000.
TestProblem linear() {
  return {"linear", cube(2, -1000.0, 1000.0), [](int, const Eigen::VectorXd& x) { return x[0]; },
          -1000.0};
}

TEST(Evaluator, ReturnsTheCostAndRecordsIt) {
  TestProblem problem = rotated_bowl();
  std::vector<EvaluationRecord> records;
  Evaluator evaluator(problem,
                      {.observer = [&](const auto& record) { records.push_back(record); }});
  EXPECT_EQ(evaluator(at(4.0, 5.0)), rotated_bowl_cost(Eigen::Vector2d(4.0, 5.0)));
  EXPECT_NEAR(evaluator(at(4.4, 5.1)), 2.0, 1e-12);
  evaluator(at(4.1, 5.0));

  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[0].index, 1);
  EXPECT_EQ(records[2].index, 3);
  EXPECT_EQ(records[0].key, "0 4 5");
  EXPECT_EQ(records[0].best_cost, records[0].cost);
  EXPECT_EQ(records[2].best_cost, records[1].cost);
  EXPECT_EQ(records[2].failure, "");
  EXPECT_GE(records[0].seconds, 0.0);
  ASSERT_TRUE(evaluator.best());
  EXPECT_EQ(evaluator.best()->point.x, Eigen::Vector2d(4.4, 5.1));
  EXPECT_EQ(evaluator.best()->key, "0 4.4 5.1");
  EXPECT_EQ(evaluator.best()->cost, records[1].cost);
}

TEST(Evaluator, EvaluatesDesignsOfEqualKeysOnce) {
  TestProblem problem = rotated_bowl();
  problem.choices = 2;
  problem.key_of = [](const SearchPoint& point) { return fmt::format("{:.2f}", point.x[0]); };
  Evaluator evaluator(problem, {.budget = 1});
  const double cost = evaluator(at(4.0, 5.0));
  EXPECT_FALSE(evaluator.best_of_slice({1, {}}));
  EXPECT_EQ(evaluator(at(4.001, 5.5, 1)), cost);
  EXPECT_EQ(problem.calls, 1);
  EXPECT_EQ(evaluator.evaluations(), 1);
  EXPECT_EQ(evaluator.cache_hits(), 1);
  ASSERT_TRUE(evaluator.best_of_slice({1, {}}));
  EXPECT_EQ(evaluator.best_of_slice({1, {}})->cost, cost);
  EXPECT_EQ(evaluator.best_of_slice({1, {}})->point.x, Eigen::Vector2d(4.001, 5.5));
}

TEST(Evaluator, MovesPointsOutsideOntoTheBounds) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {});
  EXPECT_EQ(evaluator(at(1000.0 + 1e-9, 0.0)), 1000.0);
  EXPECT_EQ(evaluator(at(-1e30, -1e30)), -1000.0);
  EXPECT_EQ(evaluator.best()->point.x, Eigen::Vector2d(-1000.0, -1000.0));
}

TEST(Evaluator, StopsBeforeItOverrunsTheBudget) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {.budget = 2});
  EXPECT_EQ(evaluator.evaluations_left(), 2);
  evaluator(at(1.0, 0.0));
  evaluator(at(2.0, 0.0));
  EXPECT_EQ(evaluator.evaluations_left(), 0);
  try {
    evaluator(at(3.0, 0.0));
    FAIL() << "a third evaluation was allowed";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::budget_exhausted);
  }
  EXPECT_EQ(problem.calls, 2);
}

TEST(Evaluator, StopsWhereAStopWasRequested) {
  TestProblem problem = linear();
  std::stop_source source;
  Evaluator evaluator(problem, {.stop = source.get_token()});
  evaluator(at(1.0, 0.0));
  source.request_stop();
  EXPECT_EQ(evaluator(at(1.0, 0.0)), 1.0);  // known: needs no evaluation
  try {
    evaluator(at(2.0, 0.0));
    FAIL() << "an evaluation started after the stop";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::stop_requested);
  }
}

TEST(Evaluator, AllowsOneEvaluationWhateverTheTimeLimit) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {.time_limit = 0.0});
  EXPECT_EQ(evaluator(at(1.0, 0.0)), 1.0);
  EXPECT_EQ(evaluator.evaluations_left(), 0);
  try {
    evaluator(at(2.0, 0.0));
    FAIL() << "an evaluation started after the time limit";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::time_limit);
  }
}

TEST(Evaluator, AFarTimeLimitLeavesTheBudget) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {.budget = 10, .time_limit = 1e9});
  evaluator(at(1.0, 0.0));
  EXPECT_EQ(evaluator.evaluations_left(), 9);
}

TEST(Evaluator, AnswersFailuresWithAFinitePenaltyThatIsWorseThanAnyCost) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) -> double {
    if (x[1] == 1.0) return std::numeric_limits<double>::quiet_NaN();
    if (x[1] == 2.0) return -std::numeric_limits<double>::infinity();
    if (x[1] == 3.0) return -1e200;
    if (x[1] == 4.0) throw std::bad_alloc();
    if (x[1] == 5.0) throw std::runtime_error("no light");
    if (x[1] == 6.0) throw 42;
    return x[0];
  };
  std::vector<EvaluationRecord> records;
  Evaluator evaluator(problem,
                      {.observer = [&](const auto& record) { records.push_back(record); }});
  EXPECT_EQ(evaluator(at(0.0, 1.0)), 1e6);
  EXPECT_EQ(records.back().best_cost, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(evaluator.best());

  evaluator(at(-3.0, 0.0));  // one cost, negative: the scale is its size
  EXPECT_DOUBLE_EQ(evaluator(at(1.0, 1.0)), -3.0 + 10.0 * 3.0);
  evaluator(at(2.0, 0.0));  // costs from -3 to 2: the scale is their spread
  for (const double failing : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    EXPECT_DOUBLE_EQ(evaluator(at(2.0, failing)), 2.0 + 10.0 * 5.0);
    EXPECT_TRUE(std::isnan(records.back().cost));
    EXPECT_EQ(records.back().best_cost, -3.0);
  }
  EXPECT_EQ(evaluator(at(0.0, 1.0)), 1e6) << "a design's penalty must not change";
  EXPECT_EQ(evaluator.failures(), 8);
  EXPECT_EQ(evaluator.best()->cost, -3.0);

  std::vector<std::string> reasons;
  for (const auto& record : records) reasons.push_back(record.failure);
  EXPECT_THAT(reasons, testing::ElementsAre("the cost is nan", "", "the cost is nan", "",
                                            "the cost is nan", "the cost is -inf",
                                            "the cost is -1e+200", "exception: std::bad_alloc",
                                            "exception: no light", "exception of an unknown type"));
}

TEST(Evaluator, PenalisesFailuresWhereAllCostsAreZero) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) {
    return x[0] == 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  };
  Evaluator evaluator(problem, {});
  evaluator(at(0.0, 0.0));
  EXPECT_EQ(evaluator(at(1.0, 0.0)), 10.0);
}

TEST(Evaluator, GivesUpAfterTooManyFailuresInARow) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) -> double {
    if (x[0] < 0.0) throw std::runtime_error("no light");
    return x[0];
  };
  int records = 0;
  Evaluator evaluator(problem, {.budget = 1000, .observer = [&](const auto&) { ++records; }});
  const int allowed = FailureCount::allowed_in_a_row;
  for (int i = 1; i < allowed; ++i) evaluator(at(-i, 0.0));
  evaluator(at(1.0, 0.0));  // a success: the row begins again
  for (int i = 1; i < allowed; ++i) evaluator(at(-i, 1.0));
  try {
    evaluator(at(-1.0, 2.0));
    FAIL() << "the search went on";
  } catch (const SearchFailed& failed) {
    EXPECT_THAT(failed.what(), testing::EndsWith("20 evaluations in a row failed, the last with "
                                                 "exception: no light"));
  }
  EXPECT_EQ(records, 2 * allowed);
}

TEST(Evaluator, EndsWhereTheProblemCannotGoOn) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd&) -> double { throw SearchFailed("disk full"); };
  int records = 0;
  Evaluator evaluator(problem, {.observer = [&](const auto&) { ++records; }});
  EXPECT_THROW(evaluator(at(1.0, 0.0)), SearchFailed);
  EXPECT_EQ(records, 0) << "no design is to blame";
}

TEST(Evaluator, BearsFailuresInARowLateInASearch) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) -> double {
    if (x[0] < 0.0) throw std::runtime_error("no light");
    return x[0];
  };
  Evaluator evaluator(problem, {.budget = 1000});
  for (int i = 1; i <= 100; ++i) evaluator(at(i, 0.0));
  for (int i = 1; i < 100; ++i) EXPECT_NO_THROW(evaluator(at(-i, 0.0)));
  EXPECT_THROW(evaluator(at(-100.0, 0.0)), SearchFailed);
}

TEST(Evaluator, LetsTheObserversExceptionsThrough) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {.observer = [](const auto&) { throw std::domain_error("full"); }});
  EXPECT_THROW(evaluator(at(1.0, 0.0)), std::domain_error);
}

TEST(Evaluator, BestDesignsDiffer) {
  TestProblem problem = linear();  // 2 % of the range is 40
  problem.choices = 2;
  Evaluator evaluator(problem, {});
  evaluator(at(100.0, 0.0));
  evaluator(at(50.0, 0.0));
  evaluator(at(0.0, 0.0));
  evaluator(at(39.0, 39.0));   // the same as the one before
  evaluator(at(1.0, 41.0));    // differs in x1
  evaluator(at(2.0, 0.0, 1));  // differs in its choice
  std::vector<double> costs;
  for (const EvaluatedDesign& design : evaluator.best_designs(4)) costs.push_back(design.cost);
  EXPECT_THAT(costs, testing::ElementsAre(0.0, 1.0, 2.0, 50.0));
}

TEST(Evaluator, AnswersABatchAsOneByOne) {
  TestProblem problem = rotated_bowl();
  problem.function = [](int, const Eigen::VectorXd& x) {
    if (x[0] > 4.6 && x[0] < 4.7) throw std::runtime_error("no light");
    return rotated_bowl_cost(x);
  };
  problem.excess = [](const Eigen::VectorXd& x) { return std::max(0.0, 3.7 - x[0]); };
  std::vector<SearchPoint> points;
  points.reserve(23);
  for (int i = 0; i < 21; ++i) points.push_back(at(3.6 + 0.06 * i, 5.0 + 0.01 * i));
  points.push_back(points[3]);      // in an earlier batch
  points.push_back(points.back());  // in the same batch
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<std::string> keys;
    Evaluator together(problem,
                       {.observer = [&](const auto& record) { keys.push_back(record.key); }});
    Evaluator alone(problem, {});
    const std::vector<double> answers = together.evaluate(points);
    ASSERT_EQ(answers.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(answers[i], alone(points[i]));
    EXPECT_EQ(together.evaluations(), 21);
    EXPECT_EQ(together.cache_hits(), 2);
    EXPECT_EQ(together.failures(), alone.failures());
    EXPECT_GT(together.failures(), 0);
    EXPECT_EQ(together.best()->key, alone.best()->key);
    std::vector<std::string> requested;
    requested.reserve(21);
    for (int i = 0; i < 21; ++i)
      requested.push_back(exact_key(points[static_cast<std::size_t>(i)]));
    EXPECT_EQ(keys, requested);
  }
}

TEST(Evaluator, EvaluatesTheFirstOfABatchThatOverrunsTheBudget) {
  TestProblem problem = linear();
  std::vector<double> costs;
  Evaluator evaluator(problem, {.budget = 3, .observer = [&](const EvaluationRecord& record) {
                                  costs.push_back(record.cost);
                                }});
  evaluator(at(5.0, 0.0));
  try {
    evaluator.evaluate({at(5.0, 0.0), at(4.0, 0.0), at(3.0, 0.0), at(2.0, 0.0), at(1.0, 0.0)});
    FAIL() << "a fourth evaluation was allowed";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::budget_exhausted);
  }
  EXPECT_THAT(costs, testing::ElementsAre(5.0, 4.0, 3.0));
  EXPECT_EQ(evaluator.best()->cost, 3.0);
}

TEST(Evaluator, KnowsWhatItEvaluated) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) {
    return x[0] < 0.0 ? std::numeric_limits<double>::quiet_NaN() : x[0];
  };
  problem.excess = [](const Eigen::VectorXd& x) { return x[1]; };
  problem.objectives = [](const SearchPoint& point) {
    return std::vector{point.x[0], 2.0 * point.x[0]};
  };
  Evaluator evaluator(problem, {});
  evaluator(at(3.0, 0.5));
  evaluator(at(-3.0, 0.0));
  EXPECT_FALSE(evaluator.known(at(4.0, 0.0)));
  EXPECT_FALSE(evaluator.known(at(-3.0, 0.0))) << "it has no cost";
  const std::optional<EvaluatedDesign> known = evaluator.known(at(3.0, 0.5));
  ASSERT_TRUE(known);
  EXPECT_EQ(known->cost, 3.0);
  EXPECT_EQ(known->violation, 0.5);
  EXPECT_THAT(known->objectives, testing::ElementsAre(3.0, 6.0));
  EXPECT_EQ(evaluator.evaluations(), 2);
  EXPECT_EQ(evaluator.cache_hits(), 0);
}

TEST(Evaluator, PrefersDesignsThatKeepTheLimits) {
  TestProblem problem = linear();
  problem.excess = [](const Eigen::VectorXd& x) { return std::max(0.0, -x[1]); };
  Evaluator evaluator(problem, {});
  EXPECT_DOUBLE_EQ(evaluator(at(1.0, -0.5)), 1.0 + 100.0 * 2.0 * 0.5);
  EXPECT_DOUBLE_EQ(evaluator(at(-9.0, -0.1)), -9.0 + 100.0 * 10.0 * 0.1);
  EXPECT_EQ(evaluator.best()->cost, -9.0) << "it is closer to its limit";
  evaluator(at(-20.0, -0.2));
  EXPECT_EQ(evaluator.best()->cost, -9.0) << "cheaper, but farther from its limit";
  EXPECT_EQ(evaluator(at(50.0, 0.0)), 50.0);
  EXPECT_EQ(evaluator.best()->cost, 50.0) << "the first that keeps the limits";
  evaluator(at(40.0, 0.0));
  EXPECT_EQ(evaluator.best()->cost, 40.0);
  std::vector<double> costs;
  for (const EvaluatedDesign& design : evaluator.best_designs(9)) costs.push_back(design.cost);
  EXPECT_THAT(costs, testing::ElementsAre(40.0, -9.0));
}

TEST(Evaluator, StopsAtItsTarget) {
  TestProblem problem = linear();
  problem.excess = [](const Eigen::VectorXd& x) { return std::max(0.0, -x[1]); };
  Evaluator evaluator(problem, {.target = 2.0});
  evaluator(at(1.0, -1.0));  // does not keep the limits
  evaluator(at(2.5, 0.0));
  evaluator(at(2.0, 0.0));
  EXPECT_EQ(evaluator(at(2.5, 0.0)), 2.5);  // known
  try {
    evaluator(at(0.0, 0.0));
    FAIL() << "the search went on";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::target_reached);
  }
  EXPECT_EQ(evaluator.evaluations(), 3);
}

TEST(Evaluator, StopsWhereItStagnates) {
  TestProblem problem = linear();
  Evaluator evaluator(problem, {.stagnation = 3});
  for (const double x : {5.0, 6.0, 7.0, 4.0, 4.5, 4.6}) evaluator(at(x, 0.0));
  evaluator(at(5.0, 0.0));  // known: no evaluation
  evaluator(at(4.0, 1.0));  // the same cost is no improvement
  try {
    evaluator(at(0.0, 0.0));
    FAIL() << "the search went on";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::stagnated);
  }
  EXPECT_EQ(evaluator.evaluations(), 7);
}

/// The bowl on 16 screens, which scatter by 0.3 and of which each prefers another point a little;
/// asks after 2, 4 and 8 screens whether to go on.
struct SampledBowl : TestProblem {
  SampledBowl() : TestProblem(rotated_bowl()) {}

  Assessment assess(const SearchPoint& point, const GoesOn& goes_on) override {
    Assessment assessment{.costs = {}, .violation = 0.0};
    for (int screen = 0; screen < 16; ++screen) {
      boost::random::mt19937_64 generator(static_cast<std::uint64_t>(screen));
      boost::random::normal_distribution<double> normal;
      const double level = 0.3 * normal(generator);
      const double slope = 0.1 * normal(generator);
      assessment.costs.push_back(rotated_bowl_cost(point.x) + level + slope * (point.x[0] - 4.4));
      ++samples;
      const bool asks = screen == 1 || screen == 3 || screen == 7;
      if (asks && goes_on && !goes_on(assessment.costs)) break;
    }
    return assessment;
  }

  Counter samples;
};

TEST(Evaluator, RacesSaveSamplesAndKeepTheWinner) {
  std::vector<SearchPoint> points;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) points.push_back(at(3.9 + 0.13 * i, 4.6 + 0.13 * j));
  }
  SampledBowl raced;
  int given_up = 0;
  std::size_t samples_reported = 0;
  Evaluator with_races(raced, {.race_significance = 0.05, .observer = [&](const auto& record) {
                                 given_up += record.given_up;
                                 samples_reported += record.samples;
                                 EXPECT_EQ(record.given_up, record.samples < 16);
                               }});
  SampledBowl complete;
  Evaluator without(complete, {});
  with_races.evaluate(points);
  without.evaluate(points);
  EXPECT_EQ(complete.samples, 64 * 16);
  EXPECT_LT(raced.samples, complete.samples / 2);
  EXPECT_EQ(static_cast<std::size_t>(raced.samples), samples_reported);
  EXPECT_GT(given_up, 32);
  EXPECT_EQ(with_races.best()->key, without.best()->key);
  EXPECT_EQ(with_races.best()->cost, without.best()->cost);
  EXPECT_EQ(with_races.best_designs(64).size(), static_cast<std::size_t>(64 - given_up));
}

TEST(Termination, HasNames) {
  EXPECT_EQ(to_string(Termination::converged), "converged");
  EXPECT_EQ(to_string(Termination::target_reached), "target_reached");
  EXPECT_EQ(to_string(Termination::stagnated), "stagnated");
  EXPECT_EQ(to_string(Termination::budget_exhausted), "budget_exhausted");
  EXPECT_EQ(to_string(Termination::time_limit), "time_limit");
  EXPECT_EQ(to_string(Termination::stop_requested), "stop_requested");
}

TEST(Evaluator, KeepsWhatABatchHasBesideADesignThatEndsTheSearch) {
  TestProblem problem = linear();
  problem.function = [](int, const Eigen::VectorXd& x) {
    if (x[0] == 2.0) throw SearchStopped(Termination::stop_requested);
    return x[0];
  };
  std::vector<double> costs;
  Evaluator evaluator(
      problem, {.observer = [&](const EvaluationRecord& record) { costs.push_back(record.cost); }});
  try {
    evaluator.evaluate({at(3.0, 0.0), at(2.0, 0.0), at(1.0, 0.0)});
    FAIL() << "the search went on";
  } catch (const SearchStopped& stopped) {
    EXPECT_EQ(stopped.termination, Termination::stop_requested);
  }
  EXPECT_THAT(costs, testing::ElementsAre(3.0, 1.0));
  EXPECT_EQ(evaluator.evaluations(), 2);
  EXPECT_EQ(evaluator.failures(), 0);
  EXPECT_EQ(evaluator.best()->cost, 1.0);
}

}  // namespace
}  // namespace nlcwfs
