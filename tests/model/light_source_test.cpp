// Tests: Bands of light become wavelengths with weights, for each plane.
#include "model/light_source.hpp"

#include "tests/message_of.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;

constexpr double nm = 1e-9;

TEST(LightSource, HasTheTelescopesWavelengthWithoutABand) {
  const LightSource source;
  source.validate(4);
  const std::vector<SpectralLine> lines = source.lines(2, 4, 532 * nm);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines.front().wavelength, 532 * nm);
  EXPECT_EQ(lines.front().weight, 1.0);
  EXPECT_EQ(source.band(2, 4, 532 * nm).centre(), 532 * nm);
}

TEST(LightSource, SamplesABandAtTheMiddlesOfEqualParts) {
  const LightSource source{.bands = {{400 * nm, 500 * nm}}, .wavelengths = 4};
  const std::vector<SpectralLine> lines = source.lines(0, 4, 532 * nm);
  ASSERT_EQ(lines.size(), 4u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_NEAR(lines[i].wavelength, (412.5 + 25.0 * double(i)) * nm, 1e-6 * nm);
    EXPECT_DOUBLE_EQ(lines[i].weight, 0.25);
  }
}

TEST(LightSource, WeighsTheWavelengths) {
  const LightSource source{
      .bands = {{400 * nm, 500 * nm}}, .wavelengths = 3, .weights = {2.0, 0.0, 6.0}};
  source.validate(2);
  const std::vector<SpectralLine> lines = source.lines(1, 2, 532 * nm);
  EXPECT_DOUBLE_EQ(lines[0].weight, 0.25);
  EXPECT_DOUBLE_EQ(lines[1].weight, 0.0);
  EXPECT_DOUBLE_EQ(lines[2].weight, 0.75);
}

TEST(LightSource, SplitsOneBandEvenlyAmongThePlanes) {
  const LightSource source{.bands = {{400 * nm, 800 * nm}}, .is_split = true};
  double shortest = 400 * nm;
  for (std::size_t plane = 0; plane < 4; ++plane) {
    const Band band = source.band(plane, 4, 532 * nm);
    EXPECT_NEAR(band.shortest, shortest, 1e-6 * nm);
    shortest = band.longest;
    EXPECT_NEAR(band.longest - band.shortest, 100 * nm, 1e-6 * nm);
  }
  EXPECT_NEAR(shortest, 800 * nm, 1e-6 * nm);
}

TEST(LightSource, RefusesWhatDoesNotGoTogether) {
  const Band band{500 * nm, 600 * nm};
  const auto message = [](const LightSource& source) {
    return message_of([&] { source.validate(4); });
  };
  EXPECT_THAT(message({.is_split = true}), HasSubstr("source.bands must be set"));
  EXPECT_THAT(message({.bands = {band, band}, .is_split = true}), HasSubstr("must be one band"));
  EXPECT_THAT(message({.bands = {band, band}}), HasSubstr("one for each of the 4 planes"));
  EXPECT_THAT(message({.bands = {{600 * nm, 500 * nm}}}), HasSubstr("source.bands"));
  EXPECT_THAT(message({.bands = {{0.0, 500 * nm}}}), HasSubstr("above 0"));
  EXPECT_THAT(message({.bands = {band}, .wavelengths = 0}), HasSubstr("source.wavelengths"));
  EXPECT_THAT(message({.bands = {band}, .wavelengths = 2, .weights = {1.0}}),
              HasSubstr("one for each of the 2"));
  EXPECT_THAT(message({.bands = {band}, .wavelengths = 2, .weights = {1.0, -1.0}}),
              HasSubstr("source.weights"));
  EXPECT_THAT(message({.bands = {band}, .wavelengths = 2, .weights = {0.0, 0.0}}),
              HasSubstr("not all 0"));
}

TEST(LightSource, HasNoMoreWavelengthsThanAreBounded) {
  const LightSource source{.bands = {{500 * nm, 600 * nm}}, .wavelengths = 1000};
  EXPECT_EQ(message_of([&] { source.validate(100); }), "");
  EXPECT_EQ(message_of([&] { source.validate(101); }),
            "source.wavelengths = 1000: at most 990 with 101 planes");
}

}  // namespace
}  // namespace nlcwfs
