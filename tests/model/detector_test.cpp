// Tests: Light becomes a plane's image: pixels, window, photons and noise.
#include "model/detector.hpp"

#include "model/pupil.hpp"
#include "tests/message_of.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Detector, WidthIsTheWindowInPixels) {
  EXPECT_EQ((Detector{.pupil_pixels = 64, .window = 4.0}.width()), 256);
  EXPECT_EQ((Detector{.pupil_pixels = 10, .window = 1.4}.width()), 14);
  EXPECT_EQ((Detector{.pupil_pixels = 6, .window = 10.0 / 3.0}.width()), 20);
}

TEST(Detector, NamesTheKeyAndTheValueOfWhatIsNotAllowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto message = [](const Detector& detector) {
    return message_of([&] { detector.validate(); });
  };
  EXPECT_EQ(message({}), "");
  EXPECT_EQ(message({.pupil_pixels = 4, .window = 1.0, .photons = 1e4, .read_noise = 3.0}), "");
  for (const int pixels : {-4, 0, 2, 7, 65, 8194, 1 << 30}) {
    EXPECT_THAT(message({.pupil_pixels = pixels}),
                StartsWith("detector.pupil_pixels = " + std::to_string(pixels) + ": "));
  }
  EXPECT_THAT(message({.window = 0.5}), StartsWith("detector.window = 0.5: at least 1"));
  EXPECT_THAT(message({.window = nan}), StartsWith("detector.window = nan: "));
  EXPECT_THAT(message({.pupil_pixels = 64, .window = 4.01}),
              StartsWith("detector.window = 4.01: window x detector.pupil_pixels must be"));
  EXPECT_THAT(message({.photons = -1.0}), StartsWith("detector.photons = -1: from 0"));
  EXPECT_THAT(message({.photons = nan}), StartsWith("detector.photons = nan: "));
  EXPECT_THAT(message({.photons = 2e18}), StartsWith("detector.photons = 2e+18: "));
  EXPECT_EQ(message({.photons = 1e15}), "");
  EXPECT_THAT(message({.photons = infinity}), StartsWith("detector.photons = inf: "));
  EXPECT_THAT(message({.photons = 1e5, .read_noise = -1.0}),
              StartsWith("detector.read_noise = -1: at least 0"));
  EXPECT_THAT(message({.photons = 1e5, .read_noise = nan}),
              StartsWith("detector.read_noise = nan: "));
  EXPECT_THAT(message({.read_noise = 3.0}),
              StartsWith("detector.read_noise = 3: needs detector.photons"));
}

TEST(Detector, RefusesALightThatIsNotOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto message = [](const Detector& detector) {
    return message_of([&] { detector.validate(); });
  };
  EXPECT_EQ(message({.read_noise = 3.0, .photon_rate = 1e8, .exposure = 1e-3}), "");
  EXPECT_EQ(message({.photons = 1e5, .exposure = 1e-3}), "");
  EXPECT_THAT(message({.photons = 1e5, .photon_rate = 1e8, .exposure = 1e-3}),
              StartsWith("detector.photon_rate = 100000000: set only one of it and "
                         "detector.photons, which is 100000"));
  EXPECT_THAT(message({.photon_rate = 1e8}),
              StartsWith("detector.photon_rate = 100000000: needs detector.exposure above 0"));
  EXPECT_THAT(message({.photon_rate = -1.0, .exposure = 1e-3}),
              StartsWith("detector.photon_rate = -1: at least 0"));
  EXPECT_THAT(message({.photon_rate = infinity, .exposure = 1e-3}),
              StartsWith("detector.photon_rate = inf: at least 0"));
  EXPECT_THAT(message({.exposure = -1.0}), StartsWith("detector.exposure = -1: a time"));
  EXPECT_THAT(message({.exposure = nan}), StartsWith("detector.exposure = nan: a time"));
  EXPECT_THAT(message({.photon_rate = 1e16, .exposure = 2.0}),
              StartsWith("detector.photon_rate = 1e+16: at most 1e+15 photons in"));
}

TEST(Detector, AFrameHasThePhotonsOfItsExposure) {
  EXPECT_EQ((Detector{.photons = 1e5, .exposure = 7.0}).photons_per_frame(), 1e5);
  EXPECT_EQ((Detector{.photon_rate = 3e7, .exposure = 0.5}).photons_per_frame(), 1.5e7);
  EXPECT_EQ(Detector().photons_per_frame(), 0.0);
}

TEST(Detector, IntegratesTheMeanIntensityOfEachPixel) {
  Field<double> field(4, 6);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) field(row, column) = {double(row), double(column)};
  }
  EXPECT_TRUE((integrate_pixels(field, 1) == field.abs2()).all());
  const Image<double> image = integrate_pixels(field, 2);
  ASSERT_EQ(image.rows(), 2);
  ASSERT_EQ(image.cols(), 3);
  // The mean over rows 0 and 1 of row^2 is 0.5, over 2 and 3 it is 6.5; columns 4 and 5: 20.5.
  EXPECT_NEAR(image(0, 0), 0.5 + 0.5, 1e-14);
  EXPECT_NEAR(image(1, 2), 6.5 + 20.5, 1e-14);
  EXPECT_NEAR(image.mean(), field.abs2().mean(), 1e-14);
}

/// Mean and variance of a flat image's pixels after noise.
struct Moments {
  double mean;
  double variance;
};

Moments noise_moments(double intensity, double photons_per_unit, double read_noise, int width) {
  Image<double> image = Image<double>::Constant(width, width, intensity);
  RandomStream stream = random_stream({1, 2, 3});
  add_noise(image, photons_per_unit, read_noise, stream);
  return {image.mean(), (image - image.mean()).square().mean()};
}

class PhotonNoise : public testing::TestWithParam<double> {};

TEST_P(PhotonNoise, HasThePoissonMeanAndVariance) {
  // In photons: mean m and variance m; of n pixels the mean's standard error is sqrt(m / n), that
  // of the variance sqrt((m + 2 m^2) / n), from the fourth central moment m + 3 m^2.
  const double photons = GetParam();
  const double intensity = 0.3;
  const double scale = photons / intensity;
  const int width = 200;
  const auto [mean, variance] = noise_moments(intensity, scale, 0.0, width);
  EXPECT_NEAR(mean * scale, photons, 4.0 * std::sqrt(photons) / width);
  EXPECT_NEAR(variance * scale * scale, photons,
              4.0 * std::sqrt(photons + 2.0 * photons * photons) / width);
}

TEST_P(PhotonNoise, AddsTheReadNoisesVariance) {
  // The sum's fourth central moment is m + 3 (m + r^2)^2.
  const double photons = GetParam();
  const double read_noise = 5.0;
  const double total = photons + read_noise * read_noise;
  const int width = 200;
  const auto [mean, variance] = noise_moments(1.0, photons, read_noise, width);
  EXPECT_NEAR(mean * photons, photons, 4.0 * std::sqrt(total) / width);
  EXPECT_NEAR(variance * photons * photons, total,
              4.0 * std::sqrt(photons + 2.0 * total * total) / width);
}

INSTANTIATE_TEST_SUITE_P(Photons, PhotonNoise, testing::Values(0.02, 1.0, 30.0, 1e4, 1e9, 1e12));

TEST(Detector, ADarkPixelHasReadNoiseOnly) {
  const auto [no_mean, no_variance] = noise_moments(0.0, 100.0, 0.0, 50);
  EXPECT_EQ(no_mean, 0.0);
  EXPECT_EQ(no_variance, 0.0);
  const int width = 200;
  const auto [mean, variance] = noise_moments(0.0, 100.0, 3.0, width);
  EXPECT_NEAR(mean * 100.0, 0.0, 4.0 * 3.0 / width);
  EXPECT_NEAR(variance * 1e4, 9.0, 4.0 * std::sqrt(2.0) * 9.0 / width);
}

TEST(Detector, NoiseIsThatOfItsStreamAndContinuesIt) {
  const auto noisy = [](RandomStream& stream) {
    Image<double> image = Image<double>::Constant(20, 20, 1.0);
    add_noise(image, 50.0, 2.0, stream);
    return image;
  };
  RandomStream first = random_stream({1, 5});
  RandomStream same = random_stream({1, 5});
  RandomStream other = random_stream({1, 6});
  const Image<double> image = noisy(first);
  EXPECT_TRUE((image == noisy(same)).all());
  EXPECT_FALSE((image == noisy(other)).any());
  EXPECT_FALSE((image == noisy(first)).any());
}

}  // namespace
}  // namespace nlcwfs
