// Tests: Which samples lie in the pupil, and the light that enters there.
#include "model/pupil.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(Pupil, FourSamplesAcrossLoseTheirCorners) {
  PupilMask expected(4, 4);
  expected << false, true, true, false,  //
      true, true, true, true,            //
      true, true, true, true,            //
      false, true, true, false;
  EXPECT_TRUE((pupil_mask(4, 0.0) == expected).all());
}

TEST(Pupil, ObscurationTakesTheMiddle) {
  PupilMask expected(4, 4);
  expected << false, true, true, false,  //
      true, false, false, true,          //
      true, false, false, true,          //
      false, true, true, false;
  EXPECT_TRUE((pupil_mask(4, 0.5) == expected).all());
}

TEST(Pupil, HasTheSymmetriesOfTheSquareForEvenAndOddSamples) {
  for (const int samples : {1, 2, 3, 31, 64}) {
    for (const double obscuration : {0.0, 0.3}) {
      const PupilMask mask = pupil_mask(samples, obscuration);
      EXPECT_TRUE((mask == mask.transpose()).all());
      EXPECT_TRUE((mask == mask.rowwise().reverse()).all());
    }
  }
}

TEST(Pupil, AreaIsTheAnnulus) {
  for (const double obscuration : {0.0, 0.14, 0.5, 0.9}) {
    const double area = std::numbers::pi / 4.0 * (1.0 - obscuration * obscuration);
    EXPECT_NEAR(static_cast<double>(pupil_mask(1000, obscuration).count()) / 1e6, area, 2e-4);
  }
}

}  // namespace
}  // namespace nlcwfs
