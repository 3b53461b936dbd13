// Tests: The telescope, and what diffraction makes of its distances.
#include "model/telescope.hpp"

#include "model/input_error.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(Telescope, TalbotDistanceOfThePapersFriedParameterIs58Point7Kilometres) {
  EXPECT_NEAR(talbot_distance(0.125, 532e-9), 58740.6, 0.1);
}

TEST(Telescope, FresnelNumberIsDimensionlessAndInvertsToTheDistance) {
  const Telescope telescope;
  EXPECT_NEAR(fresnel_number(telescope, 47e3), 0.25 / (532e-9 * 47e3), 1e-12);
  EXPECT_NEAR(distance_at_fresnel_number(telescope, fresnel_number(telescope, -47e3)), -47e3, 1e-8);
}

TEST(Telescope, ScalingKeepsTheFresnelNumber) {
  const Telescope small;
  const Telescope large{.diameter = 8.2, .wavelength = 850e-9};
  const double scaled = scaled_distance(47e3, small, large);
  EXPECT_NEAR(fresnel_number(large, scaled), fresnel_number(small, 47e3), 1e-12);
}

TEST(Telescope, BenchDistanceKeepsTheFresnelNumberOfTheCompressedBeam) {
  const Telescope telescope{.relay_beam_diameter = 0.01};
  const Telescope bench{.diameter = 0.01, .wavelength = telescope.wavelength};
  EXPECT_NEAR(fresnel_number(bench, bench_distance(180e3, telescope)),
              fresnel_number(telescope, 180e3), 1e-12);
}

TEST(Telescope, NamesTheKeyAndTheValueOfWhatIsNotPhysical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message_of = [](const Telescope& telescope) -> std::string {
    try {
      telescope.validate();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message_of({.diameter = -1.0}), testing::StartsWith("telescope.diameter = -1: "));
  EXPECT_THAT(message_of({.diameter = nan}), testing::StartsWith("telescope.diameter = nan: "));
  EXPECT_THAT(message_of({.wavelength = 0.0}), testing::StartsWith("telescope.wavelength = 0: "));
  EXPECT_THAT(message_of({.central_obscuration = 1.0}),
              testing::StartsWith("telescope.central_obscuration = 1: "));
  EXPECT_THAT(message_of({.relay_beam_diameter = 0.0}),
              testing::StartsWith("telescope.relay_beam_diameter = 0: "));
  EXPECT_EQ(message_of({}), "");
}

}  // namespace
}  // namespace nlcwfs
