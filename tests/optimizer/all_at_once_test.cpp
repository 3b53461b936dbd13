// Tests: Bodies are run in parallel, all of them even where one fails.
#include "optimizer/all_at_once.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

TEST(AllAtOnce, RunsEveryBodyOnce) {
  std::vector<int> runs(100);
  all_at_once(runs.size(), [&](std::size_t i) { ++runs[i]; });
  EXPECT_THAT(runs, testing::Each(1));
  all_at_once(0, [](std::size_t) { FAIL(); });
}

TEST(AllAtOnce, FinishesWhatWasBegunWhereABodyFails) {
  // Enough for the bodies that wait for each other here, on any machine.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  constexpr int wanted = 1000;
  std::atomic<bool> is_begun = false;
  std::atomic<bool> is_failing = false;
  std::atomic<int> done = 0;
  std::atomic<int> begun = 0;
  const auto body = [&](std::size_t i) {
    ++begun;
    if (i == 0) {
      is_begun.wait(false);
      is_failing = true;
      is_failing.notify_all();
      throw std::runtime_error("the disk is full");
    }
    is_begun = true;
    is_begun.notify_all();
    is_failing.wait(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // until the failure is known
    tbb::parallel_for(0, wanted, [&](int) { ++done; });
  };
  EXPECT_THROW(all_at_once(1000, body), std::runtime_error);
  EXPECT_LT(begun, 1000);
  EXPECT_EQ(done, (begun - 1) * wanted);
}

}  // namespace
}  // namespace nlcwfs
