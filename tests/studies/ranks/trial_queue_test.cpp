// Tests: Trials are cut into pieces, which wait for whoever is free.
#include "studies/ranks/trial_queue.hpp"

#include "model/input_error.hpp"
#include "studies/settings/trials.hpp"
#include "tests/message_of.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

Configuration tiny() {
  Configuration configuration;
  for (const auto& [key, value] :
       {std::pair("detector.pupil_pixels", "16"), std::pair("detector.window", "2"),
        std::pair("reconstruction.window", "4"), std::pair("simulation.pupil_samples", "32"),
        std::pair("screens.count", "9"), std::pair("verify.screens", "3"),
        std::pair("seeing.d_over_r0", "4,6"), std::pair("detector.photons", "1e4,1e5")}) {
    configuration.set(key, value, "by the test");
  }
  return configuration;
}

DesignTrial tiny_trial() { return TrialSetup(tiny()).make_trial(false); }

/// Whether all but the clocks is equal.
void expect_same(const TriedDesign& one, const TriedDesign& other) {
  EXPECT_EQ(one.costs, other.costs);
  ASSERT_EQ(one.performances.size(), other.performances.size());
  for (std::size_t k = 0; k < one.performances.size(); ++k) {
    const auto& screens = one.performances[k].screens;
    ASSERT_EQ(screens.size(), other.performances[k].screens.size());
    for (std::size_t i = 0; i < screens.size(); ++i) {
      const ScreenPerformance& screen = other.performances[k].screens[i];
      EXPECT_EQ(screens[i].wavefront.total_wfe, screen.wavefront.total_wfe);
      EXPECT_EQ(screens[i].fractional_loops, screen.fractional_loops);
      EXPECT_EQ(screens[i].captured_energy, screen.captured_energy);
    }
  }
}

TEST(TrialQueue, SimulatesWhatTheTrialDoes) {
  const DesignTrial alone = tiny_trial();
  const SensorDesign design = design_of(tiny());
  const TriedDesign expected = alone.run(design);
  for (const int threads : {1, 2, 5}) {
    DesignTrial spread = tiny_trial();
    spread.run_on(std::make_shared<TrialQueue>(threads, std::vector<int>{}));
    expect_same(spread.run(design), expected);
    const auto twice = [](std::span<const double> costs) { return costs.size() < 8; };
    expect_same(spread.run(design, twice), alone.run(design, twice));
  }
}

TEST(TrialQueue, GivesPiecesToWhoeverTakesThem) {
  const DesignTrial alone = tiny_trial();
  const SensorDesign design = design_of(tiny());
  const auto queue = std::make_shared<TrialQueue>(0, std::vector{2});
  DesignTrial spread = tiny_trial();
  spread.run_on(queue);
  int pieces = 0;
  std::atomic<bool> is_over = false;
  std::jthread other([&] {
    while (!is_over) {
      const auto piece = queue->take(1);
      if (!piece) continue;
      EXPECT_EQ(&piece->trial(), &spread);
      piece->done(alone.simulate(piece->design(), piece->first(), piece->count()));
      ++pieces;
    }
  });
  const TriedDesign tried = spread.run(design);
  is_over = true;
  other.join();
  expect_same(tried, alone.run(design));
  EXPECT_EQ(pieces, 4) << "two for each thread, as there is one design alone";
}

TEST(TrialQueue, GivesEachProcessItsScreensOfEveryDesign) {
  const auto queue = std::make_shared<TrialQueue>(0, std::vector{1});
  DesignTrial spread = tiny_trial();
  spread.run_on(queue);
  const SensorDesign design = design_of(tiny());
  std::vector<std::jthread> designs;
  constexpr int count = 8;
  for (int i = 0; i < count; ++i) {
    designs.emplace_back([&] { (void)spread.run(design); });
  }
  std::map<std::size_t, std::set<int>> screens;
  std::vector<TrialQueue::Piece> pieces;
  while (queue->waiting() < 2 * count) std::this_thread::yield();
  for (const std::size_t process : {0U, 1U}) {
    for (int i = 0; i < count; ++i) {
      pieces.push_back(queue->take(process).value());
      screens[process].insert(pieces.back().first());
    }
  }
  EXPECT_EQ(screens[0], std::set{0});
  EXPECT_EQ(screens[1], std::set{4});
  EXPECT_FALSE(queue->take(0).has_value());
  const auto finish = [&](const TrialQueue::Piece& piece) {
    piece.done(spread.simulate(piece.design(), piece.first(), piece.count()));
  };
  std::ranges::for_each(pieces, finish);
  designs.clear();

  // What is left goes to whoever asks.
  std::jthread one([&] { (void)spread.run(design); });
  while (queue->waiting() < 2) std::this_thread::yield();
  for (int i = 0; i < 2; ++i) finish(queue->take(1).value());
}

TEST(TrialQueue, EndsWithTheFirstScreensWhereTheWatchSaysSo) {
  DesignTrial spread = tiny_trial();
  spread.run_on(std::make_shared<TrialQueue>(2, std::vector<int>{}));
  const SensorDesign design = design_of(tiny());
  const TriedDesign whole = spread.run(design);
  const TriedDesign ended = spread.run(design, {}, [] { return false; });
  ASSERT_GE(ended.costs.size(), 1U);
  ASSERT_LT(ended.costs.size(), 9U);
  expect_same(ended, spread.on_first_screens(whole, ended.costs.size()));
}

TEST(TrialQueue, ThrowsWhatTheSimulationDoes) {
  DesignTrial spread = tiny_trial();
  SensorDesign bad = design_of(tiny());
  bad.detector.pupil_pixels = 12;
  const std::string message = message_of([&] { (void)spread.run(bad); });
  spread.run_on(std::make_shared<TrialQueue>(2, std::vector<int>{}));
  EXPECT_EQ(message_of([&] { (void)spread.run(bad); }), message);
  EXPECT_THROW((void)spread.run(bad), InputError);

  const auto queue = std::make_shared<TrialQueue>(0, std::vector{1});
  DesignTrial failing = tiny_trial();
  failing.run_on(queue);
  std::jthread other([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (const auto piece = queue->take(1)) {
        piece->failed(std::make_exception_ptr(std::runtime_error("no light")));
      }
    }
  });
  try {
    (void)failing.run(design_of(tiny()));
    FAIL() << "the simulation failed";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no light");
  }
}

TEST(TrialSpec, MakesTheSameTrial) {
  const Configuration configuration = tiny();
  TrialSetup setup(configuration);
  for (const DesignTrial& trial :
       {setup.make_trial(true),
        trial_of(setup, setup.screen_source, setup.options.precision, setup.cost(false)),
        setup.make_scan(false), setup.make_verification(false)}) {
    const DesignTrial again = trial_from_spec(trial.spec);
    EXPECT_EQ(again.identity(), trial.identity()) << trial.spec;
    EXPECT_EQ(again.spec, trial.spec);
  }
}

}  // namespace
}  // namespace nlcwfs
