#include "model/gerchberg_saxton.hpp"

#include "coma_reference.hpp"
#include "model/wavefront_metrics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

const Telescope telescope;

/// The reference's set-up: the whole periodic grid is measured.
SensorDesign coma_design(std::vector<double> planes) {
  SensorDesign design;
  design.planes = std::move(planes);
  design.detector.pupil_pixels = coma_pupil_samples;
  design.detector.window = double(coma_grid) / coma_pupil_samples;
  design.reconstruction.window = design.detector.window;
  design.reconstruction.tolerance = 0.0;
  return design;
}

/// The images that the design's own periodic grid makes of a comatic beam.
std::vector<Image<double>> periodic_images(const SensorDesign& design, double coefficient) {
  const FresnelPropagator<double> propagator(coma_grid, telescope.diameter / coma_pupil_samples,
                                             telescope.wavelength);
  std::vector<Image<double>> images;
  for (const double plane : design.planes) {
    Field<double> field = coma_field(coefficient);
    propagator.propagate(field, plane);
    images.push_back(field.abs2());
  }
  return images;
}

double wrapped_error(const Reconstruction& reconstruction, double coefficient) {
  const PupilMask mask = pupil_mask(coma_pupil_samples, 0.0);
  return wrapped_phase_rms(reconstruction.pupil_field, pupil_field(coma_phase(coefficient), mask),
                           mask);
}

TEST(GerchbergSaxton, MatchesTheIndependentTraceOfAComaticBeam) {
  const nlohmann::json reference = coma_reference();
  for (const auto& beam : reference["cases"]) {
    const double coefficient = beam["coefficient"];
    SensorDesign design = coma_design(beam["gs"]["order"]);
    const auto images = periodic_images(design, coefficient);
    for (const auto& step : beam["gs"]["trace"]) {
      design.reconstruction.max_loops = step["loops"];
      const Reconstruction result = GerchbergSaxton<double>(telescope, design).reconstruct(images);
      EXPECT_EQ(result.loops, step["loops"]);
      EXPECT_EQ(result.fft_count, 10 * result.loops);
      EXPECT_NEAR(wrapped_error(result, coefficient), step["residual_rms_rad"], 1e-9);
      EXPECT_NEAR(result.pupil_field.abs2().sum(), step["energy"],
                  1e-9 * step["energy"].get<double>());
      const int border = (coma_grid - coma_pupil_samples) / 2;
      for (const auto& pixel : step["pix"]) {
        const std::complex<double> sample =
            result.pupil_field(pixel["row"].get<int>() - border, pixel["col"].get<int>() - border);
        EXPECT_NEAR(sample.real(), pixel["re"], 1e-9);
        EXPECT_NEAR(sample.imag(), pixel["im"], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace nlcwfs
