// Tests: How long work will take, from how long it has taken.
#include "studies/run/time_left.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(TimeLeft, IsNotKnownBeforeAFirstPieceIsDone) {
  TimeLeft left(10.0);
  EXPECT_FALSE(left.seconds_left(5.0));
  left.at(0.0, 5.0, 1.0);
  EXPECT_FALSE(left.seconds_left(50.0));
}

TEST(TimeLeft, IsExactWhereThePaceIsSteady) {
  TimeLeft left(100.0);
  for (int done = 1; done <= 100; ++done) {
    left.at(done, 3.0 * done);
    EXPECT_NEAR(left.seconds_left(3.0 * done).value(), 3.0 * (100 - done), 1e-9);
  }
}

TEST(TimeLeft, ForgetsASlowStart) {
  TimeLeft left(100.0);
  double clock = 50.0;  // before the first piece is done
  for (int done = 1; done <= 40; ++done) left.at(done, clock += 1.0);
  EXPECT_NEAR(left.seconds_left(clock).value(), 60.0, 1.0) << "its mean pace says 135";
}

TEST(TimeLeft, FollowsAChangeOfPace) {
  TimeLeft left(1000.0);
  double clock = 0.0;
  for (int done = 1; done <= 800; ++done) left.at(done, clock += done <= 400 ? 1.0 : 5.0);
  EXPECT_NEAR(left.seconds_left(clock).value(), 1000.0, 10.0);
}

TEST(TimeLeft, IsSaneWhereThreadsFinishInBursts) {
  // Eight at a time, every 8 s: right within a factor of two from the first burst on, and within a
  // quarter when a quarter is done; one burst more or less is not held against it.
  TimeLeft left(400.0);
  for (int done = 1; done <= 400; ++done) {
    const int burst = (done + 7) / 8;
    const double clock = 8.0 * burst + 1e-3 * (done % 8);
    left.at(done, clock);
    if (done < 8) continue;
    const double truth = 400.0 - clock;
    const double factor = done < 100 ? 2.0 : 1.25;
    EXPECT_LE(left.seconds_left(clock).value(), factor * truth + 8.0) << done;
    EXPECT_GE(left.seconds_left(clock).value(), truth / factor - 8.0) << done;
  }
}

TEST(TimeLeft, DoesNotCountWhatWasDoneBefore) {
  TimeLeft left(100.0, 90.0);
  EXPECT_FALSE(left.seconds_left(1.0));
  left.at(92.0, 4.0);
  EXPECT_DOUBLE_EQ(left.seconds_left(4.0).value(), 16.0);
}

TEST(TimeLeft, RunsDownWithinAPieceButNotBeyondIt) {
  TimeLeft left(10.0);
  left.at(2.0, 20.0, 3.0);  // 10 s a piece, three are begun
  EXPECT_DOUBLE_EQ(left.seconds_left(20.0).value(), 80.0);
  EXPECT_DOUBLE_EQ(left.seconds_left(25.0).value(), 75.0);
  EXPECT_DOUBLE_EQ(left.seconds_left(1000.0).value(), 50.0) << "the other five are still to come";
}

TEST(TimeLeft, IsToldAsExactlyAsItIsKnown) {
  const std::vector<std::pair<double, const char*>> texts{
      {-3.0, "about 5 s"},          {0.0, "about 5 s"},           {7.0, "about 5 s"},
      {8.0, "about 10 s"},          {57.0, "about 55 s"},         {58.0, "about 1 min"},
      {89.0, "about 1 min"},        {91.0, "about 2 min"},        {3569.0, "about 59 min"},
      {3570.0, "about 1 h 00 min"}, {5000.0, "about 1 h 20 min"}, {360000.0, "about 100 h 00 min"}};
  for (const auto& [seconds, text] : texts) EXPECT_EQ(time_left_text(seconds), text) << seconds;
}

}  // namespace
}  // namespace nlcwfs
