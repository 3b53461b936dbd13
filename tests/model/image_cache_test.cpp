// Tests: Noise-free images are kept for the next design that reads the same plane.
#include "model/image_cache.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr std::size_t image_bytes = sizeof(double) * 4 * 4;

ImageCache::SharedImage image(double value) {
  return std::make_shared<const Image<double>>(Image<double>::Constant(4, 4, value));
}

ImageCache::Key plane_key(double plane) {
  return {.screen = 0, .plane = plane, .width = 4, .pupil_pixels = 2, .band = {500e-9, 600e-9}};
}

TEST(ImageCache, GivesBackWhatItHoldsUnderEachPartOfTheKey) {
  ImageCache cache(10 * image_bytes);
  const ImageCache::Key key = plane_key(47e3);
  const auto held = image(1.0);
  cache.add(key, held);
  EXPECT_EQ(cache.find(key), held);
  ImageCache::Key other = key;
  other.screen = 1;
  EXPECT_EQ(cache.find(other), nullptr);
  EXPECT_EQ(cache.find(plane_key(-47e3)), nullptr);
  other = key;
  other.width = 8;
  EXPECT_EQ(cache.find(other), nullptr);
  other = key;
  other.pupil_pixels = 4;
  EXPECT_EQ(cache.find(other), nullptr);
  other = key;
  other.band.longest = 700e-9;
  EXPECT_EQ(cache.find(other), nullptr);
}

TEST(ImageCache, LetsGoOfWhatWasNotAskedForTheLongest) {
  ImageCache cache(3 * image_bytes);
  for (const double plane : {1.0, 2.0, 3.0}) cache.add(plane_key(plane), image(plane));
  EXPECT_NE(cache.find(plane_key(1.0)), nullptr);
  cache.add(plane_key(4.0), image(4.0));
  EXPECT_EQ(cache.find(plane_key(2.0)), nullptr);
  for (const double plane : {1.0, 3.0, 4.0}) EXPECT_NE(cache.find(plane_key(plane)), nullptr);
}

TEST(ImageCache, NeverHoldsMoreThanItMay) {
  ImageCache cache(3 * image_bytes + 1);
  const auto held = [&] {
    int count = 0;
    for (int plane = 0; plane < 20; ++plane) count += cache.find(plane_key(plane)) ? 1 : 0;
    return count;
  };
  for (int plane = 0; plane < 20; ++plane) {
    cache.add(plane_key(plane), image(plane));
    cache.add(plane_key(plane), image(plane));  // as another thread may
    EXPECT_EQ(held(), std::min(plane + 1, 3));
  }
  // One that is too large does not push out the others.
  cache.add(plane_key(30.0), std::make_shared<const Image<double>>(Image<double>::Zero(8, 8)));
  EXPECT_EQ(cache.find(plane_key(30.0)), nullptr);
  EXPECT_EQ(held(), 3);
}

}  // namespace
}  // namespace nlcwfs
