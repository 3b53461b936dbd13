// Tests: A design is tried: simulated under each condition, judged and remembered.
#include "objectives/design_trial.hpp"

#include "model/input_error.hpp"
#include "tests/objectives/tiny_simulation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <numbers>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;

class DesignTrialTest : public testing::Test {
 protected:
  DesignTrial trial(int screen_count, const DesignCost& cost = {.loop_weight = 0.7}) const {
    return {{tiny_condition(telescope_, 4.0, screen_count)}, cost};
  }

  Telescope telescope_;
  SensorDesign design_ = tiny_design(telescope_);
};

TEST_F(DesignTrialTest, CostsEachScreen) {
  const TriedDesign tried = trial(3).run(design_);
  EXPECT_EQ(tried.design.planes, design_.planes);
  ASSERT_EQ(tried.performances.size(), 1u);
  ASSERT_EQ(tried.costs.size(), 3u);
  for (std::size_t screen : {0, 1, 2}) {
    const ScreenPerformance& performance = tried.performances.front().screens.at(screen);
    EXPECT_DOUBLE_EQ(tried.costs[screen], performance.wavefront.residual_wfe / 10e-9 +
                                              0.7 * performance.fractional_loops);
  }
  EXPECT_EQ(tried.violation, 0.0);
}

TEST_F(DesignTrialTest, GoesOnInBlocksThatDouble) {
  const DesignTrial twenty = trial(20);
  const std::vector<double> all = twenty.run(design_).costs;
  std::vector<std::size_t> asked;
  const TriedDesign tried = twenty.run(design_, [&](std::span<const double> costs) {
    asked.push_back(costs.size());
    EXPECT_TRUE(std::ranges::equal(costs, std::span(all).first(costs.size())));
    return true;
  });
  EXPECT_THAT(asked, ElementsAre(4, 8, 16)) << "not after the last screen";
  EXPECT_EQ(tried.costs, all) << "bit for bit";
  EXPECT_EQ(tried.performances.front().screens.size(), 20u);
}

TEST_F(DesignTrialTest, EndsWhereItIsNotToGoOn) {
  const DesignTrial twenty = trial(20);
  const TriedDesign tried =
      twenty.run(design_, [](std::span<const double> costs) { return costs.size() < 8; });
  EXPECT_EQ(tried.costs.size(), 8u);
  EXPECT_EQ(tried.performances.front().screens.size(), 8u);
  const TriedDesign all = twenty.run(design_);
  EXPECT_TRUE(std::ranges::equal(tried.costs, std::span(all.costs).first(8)));
}

TEST_F(DesignTrialTest, IsNotAskedWhereTheFirstBlockIsAllThereIs) {
  for (const int screens : {1, 4}) {
    const TriedDesign tried = trial(screens).run(design_, [](std::span<const double>) {
      ADD_FAILURE();
      return false;
    });
    EXPECT_EQ(tried.costs.size(), static_cast<std::size_t>(screens));
  }
}

TEST_F(DesignTrialTest, DoesNotDependOnTheNumberOfThreads) {
  design_.detector.photons = 1e4;
  const auto costs_on = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return trial(5).run(design_).costs; });
  };
  EXPECT_EQ(costs_on(1), costs_on(3));
}

TEST_F(DesignTrialTest, TriesEachConditionsLightInItsSeeing) {
  Condition bright = tiny_condition(telescope_, 4.0, 3);
  Condition dim = bright;
  dim.light = 1e3;
  Condition bad = tiny_condition(telescope_, 8.0, 3);
  const DesignTrial three({bright, dim, bad}, {});
  const TriedDesign tried = three.run(design_);
  ASSERT_EQ(tried.performances.size(), 3u);
  std::vector<double> sums(3, 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    SensorDesign lit = design_;
    if (k == 1) lit.detector.photons = 1e3;
    const std::vector<double> alone =
        DesignTrial({{.name = "alone", .simulation = three.conditions()[k].simulation}}, {})
            .run(lit)
            .costs;
    EXPECT_EQ(three.cost().per_screen(tried.performances[k], lit, 1.0), alone) << k;
    for (std::size_t i = 0; i < 3; ++i) sums[i] += alone[i];
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(tried.costs[i], sums[i] / 3.0);
}

TEST_F(DesignTrialTest, ReplacesThePhotonRateWhereThatIsInUse) {
  design_.detector.photon_rate = 1e6;
  design_.detector.exposure = 2e-3;
  Condition dim = tiny_condition(telescope_);
  dim.light = 5e5;
  SensorDesign counted = tiny_design(telescope_);
  counted.detector.photons = 1e3;
  EXPECT_EQ(DesignTrial({dim}, {}).run(design_).costs, trial(2, {}).run(counted).costs);
}

TEST_F(DesignTrialTest, TakesTheGreenwoodFrequencyOfEachConditionsSeeing) {
  DesignCost cost{.wfe_scale = 1.0, .loop_weight = 0.0};
  cost.terms = {{*find_design_metric("servo_wfe_nm"), 1.0}};
  cost.operation.time_per_loop = 1e-3;
  cost.operation.wind_speed = 10.0;
  const DesignTrial two({tiny_condition(telescope_, 4.0), tiny_condition(telescope_, 8.0)}, cost);
  const TriedDesign tried = two.run(design_);
  std::vector<double> expected(2, 0.0);
  for (std::size_t k : {0, 1}) {
    const double frequency = 0.427 * 10.0 / (0.5 / (k == 0 ? 4.0 : 8.0));
    for (std::size_t i : {0, 1}) {
      const double delay = 1e-3 * tried.performances[k].screens[i].fractional_loops;
      expected[i] += 0.5 * std::sqrt(28.4 * std::pow(delay * frequency, 5.0 / 3.0)) * 532.0 /
                     (2.0 * std::numbers::pi);
    }
  }
  for (std::size_t i : {0, 1}) EXPECT_NEAR(tried.costs[i], expected[i], 1e-6 * expected[i]);
}

TEST_F(DesignTrialTest, BreaksALimitByAsMuchAsInItsWorstCondition) {
  DesignCost cost;
  cost.limits = {{*find_design_metric("total_wfe_nm"), Side::above, 1.0}};
  const Condition good = tiny_condition(telescope_, 4.0);
  const Condition bad = tiny_condition(telescope_, 8.0);
  const auto violation = [&](const std::vector<Condition>& conditions) {
    return DesignTrial(conditions, cost).run(design_).violation;
  };
  EXPECT_GT(violation({bad}), violation({good}));
  EXPECT_EQ(violation({good, bad}), violation({bad}));
  EXPECT_EQ(violation({bad, good}), violation({bad}));
}

TEST_F(DesignTrialTest, AggregatesTheConditionsCosts) {
  const std::vector<Condition> conditions{tiny_condition(telescope_, 4.0, 6),
                                          tiny_condition(telescope_, 8.0, 6)};
  std::vector<std::vector<double>> alone;
  alone.reserve(conditions.size());
  for (const Condition& condition : conditions) {
    alone.push_back(DesignTrial({condition}, {}).run(design_).costs);
  }
  for (const AggregateKind kind :
       {AggregateKind::mean, AggregateKind::worst, AggregateKind::quantile, AggregateKind::cvar}) {
    const CostAggregate aggregate{kind, 0.8};
    const DesignTrial both(conditions, {.aggregate = aggregate});
    EXPECT_EQ(both.run(design_).costs, aggregate.per_screen(alone));
    int asked = 0;
    (void)both.run(design_, [&](std::span<const double>) { return ++asked > 0; });
    EXPECT_EQ(asked, kind == AggregateKind::mean ? 1 : 0) << "of six screens, after four";
  }
}

TEST_F(DesignTrialTest, ChecksADesignUnderEveryCondition) {
  const DesignTrial two = trial(2);
  EXPECT_EQ(two.checked(design_).planes, design_.planes);
  design_.detector.pupil_pixels = 12;
  EXPECT_THROW((void)two.checked(design_), InputError);
  EXPECT_THROW((void)two.run(design_), InputError);
}

TEST_F(DesignTrialTest, AMetricsMeanIsOverScreensAndConditionsItsErrorOverScreens) {
  const DesignTrial both({tiny_condition(telescope_, 4.0, 3), tiny_condition(telescope_, 8.0, 3)},
                         {});
  const TriedDesign tried = both.run(design_);
  const MeanAndError found = both.mean_of(tried, *find_design_metric("total_wfe_nm"));
  const MeanAndError expected =
      pooled(tried.performances).mean_of(performance_metric("total_wfe_nm"));
  EXPECT_DOUBLE_EQ(found.mean, expected.mean);
  EXPECT_DOUBLE_EQ(found.standard_error, expected.standard_error);
  EXPECT_GT(found.standard_error, 0.0);
}

TEST_F(DesignTrialTest, AMetricIsOfTheDesignInTheConditionsLight) {
  Condition bright = tiny_condition(telescope_);
  bright.light = 1e6;
  const DesignMetric photons{"photons", "", [](const ScreenPerformance&, const MetricContext& c) {
                               return c.design.detector.photons;
                             }};
  const DesignTrial lit({bright}, {});
  EXPECT_EQ(lit.mean_of(lit.run(design_), photons).mean, 1e6);
}

TEST_F(DesignTrialTest, EndsWithTheScreensThatAreDoneUnderAllConditions) {
  const DesignTrial two({tiny_condition(telescope_, 4.0, 9), tiny_condition(telescope_, 8.0, 9)},
                        {});
  const TriedDesign whole = two.run(design_);
  // With nine threads all screens would be begun at once.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  std::atomic<int> done = 0;
  // In the second condition.
  const TriedDesign ended = two.run(design_, {}, [&] { return ++done < 9 + 3; });
  ASSERT_GE(ended.costs.size(), 3u);
  ASSERT_LT(ended.costs.size(), 9u);
  EXPECT_TRUE(std::ranges::equal(ended.costs, std::span(whole.costs).first(ended.costs.size())));
  for (const Performance& performance : ended.performances) {
    EXPECT_EQ(performance.screens.size(), ended.costs.size());
  }
  const TriedDesign first = two.on_first_screens(whole, ended.costs.size());
  EXPECT_EQ(first.costs, ended.costs);
  EXPECT_EQ(first.performances[1].screens.size(), ended.costs.size());
}

/// Keeps trials in memory, and counts.
class MapMemory : public TrialMemory {
 public:
  std::optional<RememberedTrial> find(const std::string& trial,
                                      const std::string& design) override {
    const auto found = trials.find({trial, design});
    if (found == trials.end()) return std::nullopt;
    return found->second;
  }
  void keep(const std::string& trial, const std::string& design,
            const RememberedTrial& remembered) override {
    ++kept;
    trials[{trial, design}] = remembered;
  }

  std::map<std::pair<std::string, std::string>, RememberedTrial> trials;
  int kept = 0;
};

TEST_F(DesignTrialTest, SimulatesNoScreenThatItRemembers) {
  const auto memory = std::make_shared<MapMemory>();
  DesignTrial first = trial(20);
  first.remember_in(memory);
  const auto end_at_8 = [](std::span<const double> costs) { return costs.size() < 8; };
  const TriedDesign begun = first.run(design_, end_at_8);
  ASSERT_EQ(memory->kept, 1);

  DesignTrial again = trial(20);
  again.remember_in(memory);
  const TriedDesign same = again.run(design_, end_at_8);
  EXPECT_EQ(same.costs, begun.costs);
  EXPECT_EQ(memory->kept, 1) << "nothing new";
  // A clock would say where a screen was simulated anew.
  const auto seconds = [](const TriedDesign& tried) {
    return tried.performances.front().samples_of(performance_metric("seconds"));
  };
  EXPECT_EQ(seconds(same), seconds(begun));

  const TriedDesign whole = again.run(design_);
  EXPECT_EQ(memory->kept, 2);
  EXPECT_EQ(whole.costs, trial(20).run(design_).costs) << "bit for bit";
  std::vector<double> taken_over = seconds(whole);
  taken_over.resize(8);
  EXPECT_EQ(taken_over, seconds(begun));
  // A race that asks for fewer screens than are known sees these alone.
  EXPECT_EQ(again.run(design_, end_at_8).costs, begun.costs);
  EXPECT_EQ(memory->kept, 2);
}

TEST_F(DesignTrialTest, TakesNothingThatNoTrialOfTheDesignLeaves) {
  const auto memory = std::make_shared<MapMemory>();
  DesignTrial remembering = trial(3);
  remembering.remember_in(memory);
  const TriedDesign tried = remembering.run(design_);
  RememberedTrial& kept = memory->trials.begin()->second;
  const RememberedTrial whole = kept;
  const std::vector<std::function<void(std::vector<Performance>&)>> changes{
      [](auto& performances) { performances.clear(); },
      [](auto& performances) { performances.push_back(performances.front()); },
      [](auto& performances) { performances.back().screens[1].captured_energy.clear(); },
      [](auto& performances) { performances.back().screens[1].captured_energy.pop_back(); }};
  for (const auto& change : changes) {
    kept = whole;
    change(kept.performances);
    const int before = memory->kept;
    EXPECT_EQ(remembering.run(design_).costs, tried.costs);
    EXPECT_EQ(memory->kept, before + 1) << "simulated again";
  }
}

TEST_F(DesignTrialTest, RemembersWhatAnInterruptLeftOfADesign) {
  const auto memory = std::make_shared<MapMemory>();
  DesignTrial interrupted = trial(6);
  interrupted.remember_in(memory);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  int screens = 0;
  const TriedDesign part = interrupted.run(design_, {}, [&] { return ++screens < 2; });
  ASSERT_EQ(part.costs.size(), 2u);
  screens = 100;
  int simulated = 0;
  const TriedDesign whole = interrupted.run(design_, {}, [&] { return ++simulated > 0; });
  EXPECT_EQ(simulated, 4);
  EXPECT_EQ(whole.costs, trial(6).run(design_).costs);
}

TEST_F(DesignTrialTest, RemembersFailuresButNotBadInput) {
  const auto memory = std::make_shared<MapMemory>();
  DesignTrial remembering = trial(3);
  remembering.remember_in(memory);
  SensorDesign bad = design_;
  bad.detector.pupil_pixels = 15;
  EXPECT_THROW(remembering.run(bad), InputError);
  EXPECT_EQ(memory->kept, 0);

  const auto fail = [](std::span<const double>) -> bool { throw std::runtime_error("no light"); };
  DesignTrial racing = trial(8);
  racing.remember_in(memory);
  EXPECT_THROW(racing.run(design_, fail), std::runtime_error);
  EXPECT_EQ(memory->kept, 1);
  try {
    racing.run(design_);
    FAIL() << "it failed when it was tried";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no light");
  }
}

TEST_F(DesignTrialTest, KeepsThatMemoryWasShortOnlyWhereItsFailuresAreKept) {
  const auto no_memory = [](std::span<const double>) -> bool { throw std::bad_alloc(); };
  const auto memory = std::make_shared<MapMemory>();
  DesignTrial verification = trial(8);
  verification.remember_in(memory);
  verification.keeps_failures = false;
  EXPECT_THROW(verification.run(design_, no_memory), std::bad_alloc);
  EXPECT_EQ(memory->kept, 0);
  DesignTrial search = trial(8);
  search.remember_in(memory);
  EXPECT_THROW(search.run(design_, no_memory), std::bad_alloc);
  ASSERT_EQ(memory->kept, 1);
  EXPECT_EQ(memory->trials.begin()->second.failure, "std::bad_alloc");
}

TEST_F(DesignTrialTest, BlamesNoDesignForAMemoryThatFails) {
  class FullMemory : public MapMemory {
   public:
    void keep(const std::string& /*trial*/, const std::string& /*design*/,
              const RememberedTrial& /*remembered*/) override {
      ++kept;
      throw TrialMemoryFailed("disk full");
    }
  };
  const auto memory = std::make_shared<FullMemory>();
  DesignTrial remembering = trial(3);
  remembering.remember_in(memory);
  EXPECT_THROW(remembering.run(design_), TrialMemoryFailed);
  EXPECT_EQ(memory->kept, 1) << "not kept as the design's failure";
}

TEST_F(DesignTrialTest, HasANameOfWhatDecidesOnPerformances) {
  const std::string name = trial(3).identity();
  EXPECT_EQ(trial(3, {.loop_weight = 5.0}).identity(), name) << "costs are made of performances";
  std::set<std::string> others{name, trial(4).identity()};
  Condition weaker = tiny_condition(telescope_, 3.0, 3);
  Condition dim = tiny_condition(telescope_, 4.0, 3);
  dim.light = 1e5;
  others.insert(DesignTrial({weaker}, {}).identity());
  others.insert(DesignTrial({dim}, {}).identity());
  others.insert(DesignTrial({tiny_condition(telescope_, 4.0, 3), dim}, {}).identity());
  EXPECT_EQ(others.size(), 5u);
}

}  // namespace
}  // namespace nlcwfs
