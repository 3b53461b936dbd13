// Tests: How much the wavefront changes from loop to loop, and when that is little enough.
#include "model/loop_change.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

const PupilMask mask = pupil_mask(32, 0.2);
const PhaseUnwrapper unwrapper(mask, UnwrappingMethod::quality_guided);

/// A defocus of an RMS of nearly `rms` rad.
PhaseScreen defocus(double rms) {
  return PhaseScreen::NullaryExpr(32, 32, [=](Eigen::Index row, Eigen::Index column) {
    const double y = (double(row) - 15.5) / 16.0;
    const double x = (double(column) - 15.5) / 16.0;
    return rms * std::numbers::sqrt3 * 2.0 * (x * x + y * y);
  });
}

double rms_over_mask(const PhaseScreen& phase) {
  const auto count = double(mask.count());
  const double mean = mask.select(phase, 0.0).sum() / count;
  return std::sqrt(mask.select((phase - mean).square(), 0.0).sum() / count);
}

Field<double> field_of(const PhaseScreen& phase) { return pupil_field(phase, mask); }

TEST(LoopChange, DifferenceIsTheRmsOfTheStepFromTheFieldBefore) {
  LoopChange change(StoppingRule::difference, mask, unwrapper, field_of(defocus(0.0)));
  const double unit = rms_over_mask(defocus(1.0));
  EXPECT_NEAR(change.update(field_of(defocus(0.4))), 0.4 * unit, 1e-3);
  EXPECT_NEAR(change.update(field_of(defocus(0.5))), 0.1 * unit, 1e-5);
  EXPECT_NEAR(change.update(field_of(defocus(0.3))), 0.2 * unit, 1e-4);
  EXPECT_NEAR(change.update(field_of(defocus(0.3))), 0.0, 1e-12);
}

TEST(LoopChange, RmsChangeIsThatOfTheUnwrappedWavefront) {
  // Strong enough to wrap.
  LoopChange change(StoppingRule::rms_change, mask, unwrapper, field_of(defocus(0.0)));
  const double unit = rms_over_mask(defocus(1.0));
  EXPECT_NEAR(change.update(field_of(defocus(3.0))), 3.0 * unit, 1e-9);
  EXPECT_NEAR(change.update(field_of(defocus(-2.5))), 0.5 * unit, 1e-9);
  EXPECT_NEAR(change.update(field_of(defocus(2.5))), 0.0, 1e-9);
}

TEST(LoopChange, RmsChangeIsBlindToAStepThatKeepsTheRms) {
  // Which is why `difference` is the default.
  LoopChange rms_change(StoppingRule::rms_change, mask, unwrapper, field_of(defocus(0.5)));
  LoopChange difference(StoppingRule::difference, mask, unwrapper, field_of(defocus(0.5)));
  EXPECT_NEAR(rms_change.update(field_of(defocus(-0.5))), 0.0, 1e-12);
  EXPECT_GT(difference.update(field_of(defocus(-0.5))), 0.9);
}

TEST(LoopChange, NeitherSeesAPistonOrABrightness) {
  for (const StoppingRule rule : {StoppingRule::difference, StoppingRule::rms_change}) {
    LoopChange change(rule, mask, unwrapper, field_of(defocus(0.5)));
    EXPECT_NEAR(change.update(field_of(defocus(0.5) + 3.0)), 0.0, 1e-12);
    EXPECT_NEAR(change.update(7.0 * field_of(defocus(0.5) + 3.0)), 0.0, 1e-12);
    EXPECT_NEAR(change.update(field_of(defocus(0.5) - 3.1)), 0.0, 1e-12);
  }
}

TEST(FractionalLoopCount, IsOneWhereTheFirstLoopIsBelowTheTolerance) {
  EXPECT_EQ(fractional_loop_count({1e-12}, 1e-9), 1.0);
  EXPECT_EQ(fractional_loop_count({0.0}, 1e-9), 1.0);
}

TEST(FractionalLoopCount, FindsTheCrossingOfAGeometricSequence) {
  // change = 100^-loop crosses 10^-k at loop k / 2.
  const std::vector<double> changes{1e-2, 1e-4, 1e-6};
  EXPECT_NEAR(fractional_loop_count(changes, 1e-5), 2.5, 1e-12);
  EXPECT_NEAR(fractional_loop_count(changes, std::pow(10.0, -4.2)), 2.1, 1e-12);
  EXPECT_NEAR(fractional_loop_count(changes, 1e-4), 2.0, 1e-12);
}

TEST(FractionalLoopCount, FallsWithTheLastChangeAndGrowsWithTheOneBefore) {
  const auto count = [](double before, double last) {
    return fractional_loop_count({1e-5, before, last}, 1e-9);
  };
  EXPECT_LT(count(1e-8, 1e-11), count(1e-8, 1e-10));
  EXPECT_LT(count(1e-8, 1e-10), count(1e-7, 1e-10));
  for (const double last : {0.0, 1e-30, 9.99e-10}) {
    EXPECT_GT(count(1e-8, last), 2.0);
    EXPECT_LE(count(1e-8, last), 3.0);
  }
}

}  // namespace
}  // namespace nlcwfs
