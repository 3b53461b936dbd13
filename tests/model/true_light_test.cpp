// Tests: The light that reaches the detectors: extended, periodic or the reconstruction's own.
#include "model/true_light.hpp"

#include "model/seeing.hpp"
#include "model/turbulence_screen.hpp"

#include <array>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double nm = 1e-9;
constexpr int samples = 32;
constexpr std::array<std::size_t, 4> all_planes{0, 1, 2, 3};

/// With a truth of the detector's sampling, so that both models can make it.
SensorDesign design() {
  SensorDesign design;
  design.detector.pupil_pixels = samples;
  design.detector.window = 4.0;
  design.reconstruction.window = 4.0;
  return design;
}

PhaseScreen aberration() {
  return generate_screens(TurbulenceScreenGenerator({.fried_parameter = 0.125}, samples, 0.5, 3), 1)
      .front();
}

double greatest_difference(const std::vector<Image<double>>& a,
                           const std::vector<Image<double>>& b) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    greatest = std::max(greatest, (a[i] - b[i]).abs().maxCoeff());
  }
  return greatest;
}

class Light : public testing::TestWithParam<TruthModel> {
 protected:
  static std::vector<Image<double>> images(const LightSource& source = {}) {
    return images(Telescope(), design(), aberration(), source);
  }
  static std::vector<Image<double>> images(const Telescope& telescope, const SensorDesign& sensor,
                                           const PhaseScreen& phase, const LightSource& source) {
    return TrueLight(GetParam(), telescope, sensor, samples, source).images(phase, all_planes);
  }
};

TEST_P(Light, OfOnePhaseMakesTheSameImagesAtEveryWavelength) {
  // The planes stand at equal Fresnel numbers.
  for (const double wavelength : {400 * nm, 532 * nm, 1000 * nm}) {
    const std::vector<Image<double>> others =
        images({.bands = {{wavelength, wavelength}}, .aberration = ChromaticAberration::phase});
    EXPECT_EQ(greatest_difference(others, images()), 0.0) << wavelength;
  }
}

TEST_P(Light, OfOnePathMakesTheImagesOfATelescopeAtItsWavelength) {
  const double wavelength = 700 * nm;
  const std::vector<Image<double>> ours =
      images({.bands = {{wavelength, wavelength}}, .aberration = ChromaticAberration::path});
  Telescope red;
  red.wavelength = wavelength;
  const double ratio = Telescope().wavelength / wavelength;
  SensorDesign moved = design();
  for (double& plane : moved.planes) plane *= ratio;
  EXPECT_LT(greatest_difference(ours, images(red, moved, aberration() * ratio, {})), 1e-9);
  EXPECT_GT(greatest_difference(ours, images()), 0.1);
}

TEST_P(Light, OfABandIsTheMeanOfItsWavelengths) {
  for (const ChromaticAberration aberration_kind :
       {ChromaticAberration::phase, ChromaticAberration::path}) {
    const LightSource source{.bands = {{500 * nm, 600 * nm}},
                             .wavelengths = 2,
                             .weights = {1.0, 3.0},
                             .aberration = aberration_kind};
    std::vector<Image<double>> sum(4, Image<double>::Zero(4 * samples, 4 * samples));
    // Each in the middle of its half, where the whole band's middle stands at 550 nm.
    for (const auto& [wavelength, weight] :
         {std::pair(525 * nm, 0.25), std::pair(575 * nm, 0.75)}) {
      SensorDesign moved = design();
      for (double& plane : moved.planes) plane *= wavelength / (550 * nm);
      const double factor =
          aberration_kind == ChromaticAberration::path ? Telescope().wavelength / wavelength : 1.0;
      const auto part = images(Telescope(), moved, aberration() * factor, {});
      for (std::size_t plane = 0; plane < 4; ++plane) sum[plane] += weight * part[plane];
    }
    EXPECT_LT(greatest_difference(images(source), sum), 1e-9);
  }
}

TEST_P(Light, OfABandEachPlaneHasItsOwn) {
  LightSource source{.bands = {{400 * nm, 500 * nm},
                               {500 * nm, 600 * nm},
                               {600 * nm, 700 * nm},
                               {700 * nm, 800 * nm}},
                     .wavelengths = 3};
  const std::vector<Image<double>> of_all = images(source);
  const LightSource split{.bands = {{400 * nm, 800 * nm}}, .is_split = true, .wavelengths = 3};
  EXPECT_LT(greatest_difference(images(split), of_all), 1e-9);
  for (std::size_t plane = 0; plane < 4; ++plane) {
    const LightSource alone{.bands = {source.bands[plane]}, .wavelengths = 3};
    EXPECT_EQ((images(alone)[plane] - of_all[plane]).abs().maxCoeff(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Truths, Light, testing::Values(TruthModel::extended, TruthModel::matched),
                         [](const auto& truth) {
                           return truth.param == TruthModel::extended ? "extended" : "matched";
                         });

TEST(TrueLight, OfABandKeepsItsEnergyOnAPeriodicGrid) {
  const LightSource band{.bands = {{400 * nm, 800 * nm}}, .wavelengths = 5};
  const auto energies = [](const LightSource& source) {
    const TrueLight light(TruthModel::matched, Telescope(), design(), samples, source);
    std::vector<double> sums;
    for (const Image<double>& image : light.images(aberration(), all_planes)) {
      sums.push_back(image.sum());
    }
    return sums;
  };
  const std::vector<double> alone = energies({});
  const std::vector<double> together = energies(band);
  for (std::size_t plane = 0; plane < 4; ++plane) {
    EXPECT_NEAR(together[plane], alone[plane], 1e-9 * alone[plane]);
  }
}

}  // namespace
}  // namespace nlcwfs
