// Tests: The loop: a wavefront is reconstructed from the images of several planes.
#include "model/gerchberg_saxton.hpp"

#include "coma_reference.hpp"
#include "model/random_stream.hpp"
#include "model/turbulence_screen.hpp"
#include "model/wavefront_metrics.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include <boost/random/uniform_real_distribution.hpp>
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
    images.emplace_back(field.abs2());
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

/// Turbulence of D/r0 = 3 over a coarsely sampled pupil.
PhaseScreen turbulence(int samples) {
  const Seeing seeing{.fried_parameter = telescope.diameter / 3.0};
  return TurbulenceScreenGenerator(seeing, samples, telescope.diameter, 5).screen(0);
}

SensorDesign small_design() {
  SensorDesign design;
  design.planes = {-60e3, 60e3, -20e3, 20e3};
  design.detector = {.pupil_pixels = 16, .window = 3.0};
  design.reconstruction.window = 4.0;
  design.reconstruction.max_loops = 4;
  design.reconstruction.tolerance = 0.0;
  return design;
}

/// What the design's detectors see of a phase that is propagated on the reconstruction's own grid.
std::vector<Image<double>> matched_images(const Telescope& beam, const SensorDesign& design,
                                          const PhaseScreen& phase) {
  const int width = design.grid_width();
  const int samples = design.pupil_samples();
  const int oversampling = design.reconstruction.oversampling;
  const int seen = design.detector.width() * oversampling;
  const FresnelPropagator<double> propagator(width, beam.diameter / samples, beam.wavelength);
  std::vector<Image<double>> images;
  for (const double plane : design.planes) {
    Field<double> field = Field<double>::Zero(width, width);
    field.block((width - samples) / 2, (width - samples) / 2, samples, samples) =
        pupil_field(phase, pupil_mask(samples, beam.central_obscuration));
    propagator.propagate(field, plane);
    images.push_back(integrate_pixels(
        field.block((width - seen) / 2, (width - seen) / 2, seen, seen), oversampling));
  }
  return images;
}

/// The same with errors of tens of percent and no dark pixel, so that no field fits the images.
std::vector<Image<double>> contradictory_images(const Telescope& beam, const SensorDesign& design) {
  auto images = matched_images(beam, design, turbulence(design.pupil_samples()));
  RandomStream stream = random_stream({7});
  boost::random::uniform_real_distribution<double> factor(0.5, 1.5);
  for (Image<double>& image : images) {
    for (double& pixel : image.reshaped()) pixel = 0.01 + pixel * factor(stream);
  }
  return images;
}

/// A plane's field with the amplitudes of its image, over-relaxed by beta, pixel by pixel.
Field<double> with_amplitudes(const Field<double>& field, const Image<double>& image,
                              const ReconstructionOptions& options, double beta) {
  const int per_pixel = options.oversampling;
  const auto border = (field.rows() - image.rows() * per_pixel) / 2;
  Field<double> measured = field;
  if (options.outside == OutsideDetector::zero) measured.setZero();
  for (int row = 0; row < image.rows(); ++row) {
    for (int column = 0; column < image.cols(); ++column) {
      const auto y = border + row * per_pixel;
      const auto x = border + column * per_pixel;
      const auto samples = field.block(y, x, per_pixel, per_pixel);
      const double estimated = std::sqrt(samples.abs2().mean());
      const double wanted = std::sqrt(image(row, column));
      double factor = 1.0;
      if (!std::isnan(wanted)) {
        factor = estimated > 0.0 ? (wanted + beta * (wanted - estimated)) / estimated : 0.0;
      }
      measured.block(y, x, per_pixel, per_pixel) = samples * factor;
    }
  }
  return measured;
}

/// The loop as its definition reads: whole fields, no shortcut.
Field<double> plain_loop(const Telescope& beam, const SensorDesign& design,
                         const std::vector<Image<double>>& images) {
  const ReconstructionOptions& options = design.reconstruction;
  const int width = design.grid_width();
  const int samples = design.pupil_samples();
  const int border = (width - samples) / 2;
  const PupilMask mask = pupil_mask(samples, beam.central_obscuration);
  const FresnelPropagator<double> propagator(width, beam.diameter / samples, beam.wavelength);

  Field<double> pupil = mask.cast<std::complex<double>>();
  for (int loop = 1; loop <= options.max_loops; ++loop) {
    double beta = options.relaxation_start;
    if (options.max_loops > 1) {
      beta += (options.relaxation_end - options.relaxation_start) * (loop - 1) /
              (options.max_loops - 1);
    }
    Field<double> field = Field<double>::Zero(width, width);
    field.block(border, border, samples, samples) = pupil;
    double position = 0.0;
    for (std::size_t plane = 0; plane < images.size(); ++plane) {
      propagator.propagate(field, design.planes[plane] - position);
      position = design.planes[plane];
      field = with_amplitudes(field, images[plane], options, beta);
    }
    propagator.propagate(field, -position);
    pupil = mask.select(field.block(border, border, samples, samples), 0.0);
  }
  return pupil;
}

struct Variation {
  std::string name;
  void (*apply)(SensorDesign& design);
  double central_obscuration = 0.0;
};

void PrintTo(const Variation& variation, std::ostream* out) { *out << variation.name; }

class GerchbergSaxtonVariation : public testing::TestWithParam<Variation> {};

TEST_P(GerchbergSaxtonVariation, IsThePlainLoop) {
  SensorDesign design = small_design();
  GetParam().apply(design);
  const Telescope beam{.central_obscuration = GetParam().central_obscuration};
  design.validate(beam);
  const auto images = contradictory_images(beam, design);
  const Field<double> expected = plain_loop(beam, design, images);
  const Reconstruction result = GerchbergSaxton<double>(beam, design).reconstruct(images);
  EXPECT_LT((result.pupil_field - expected).abs().maxCoeff(), 1e-10);
  EXPECT_GT(expected.abs2().sum(), 0.1 * double(pupil_mask(16, 0.0).count()));
}

/// Images with scattered pixels, a row and a corner that were not measured.
std::vector<Image<double>> with_gaps(std::vector<Image<double>> images) {
  RandomStream stream = random_stream({11});
  boost::random::uniform_real_distribution<double> chance(0.0, 1.0);
  for (Image<double>& image : images) {
    for (double& pixel : image.reshaped()) {
      if (chance(stream) < 0.02) pixel = std::nan("");
    }
    image.row(image.rows() / 2).setConstant(std::nan(""));
    image.bottomRightCorner(3, 5).setConstant(std::nan(""));
  }
  return images;
}

TEST_P(GerchbergSaxtonVariation, LeavesTheFieldAsItIsWhereNothingWasMeasured) {
  SensorDesign design = small_design();
  GetParam().apply(design);
  const Telescope beam{.central_obscuration = GetParam().central_obscuration};
  const auto images = with_gaps(contradictory_images(beam, design));
  const Field<double> expected = plain_loop(beam, design, images);
  const Field<double> result =
      GerchbergSaxton<double>(beam, design).reconstruct(images).pupil_field;
  EXPECT_LT((result - expected).abs().maxCoeff(), 1e-10);
  EXPECT_GT(expected.abs2().sum(), 0.1 * double(pupil_mask(16, 0.0).count()));
}

TEST_P(GerchbergSaxtonVariation, PredictsTheImagesOfAPupil) {
  SensorDesign design = small_design();
  GetParam().apply(design);
  const Telescope beam{.central_obscuration = GetParam().central_obscuration};
  const PhaseScreen phase = turbulence(design.pupil_samples());
  const GerchbergSaxton<double> reconstructor(beam, design);
  const auto predicted = reconstructor.predict(pupil_field(phase, reconstructor.mask()));
  const auto expected = matched_images(beam, design, phase);
  ASSERT_EQ(predicted.size(), expected.size());
  for (std::size_t plane = 0; plane < expected.size(); ++plane) {
    EXPECT_LT((predicted[plane] - expected[plane]).abs().maxCoeff(), 1e-10) << plane;
  }
}

TEST_P(GerchbergSaxtonVariation, IsTheSameInSinglePrecision) {
  // With a weak phase that fits its images: others give a field's nulls a brightness, and with it
  // the phase of their rounding errors.
  SensorDesign design = small_design();
  GetParam().apply(design);
  const Telescope beam{.central_obscuration = GetParam().central_obscuration};
  const auto images = matched_images(beam, design, 0.3 * turbulence(design.pupil_samples()));
  const Field<double> expected =
      GerchbergSaxton<double>(beam, design).reconstruct(images).pupil_field;
  const Field<double> single = GerchbergSaxton<float>(beam, design).reconstruct(images).pupil_field;
  EXPECT_LT(std::sqrt((single - expected).abs2().sum() / expected.abs2().sum()),
            50.0 * double(std::numeric_limits<float>::epsilon()));
}

const std::vector<Variation> variations = {
    {"FreeOutside", [](SensorDesign&) {}},
    {"ZeroOutside",
     [](SensorDesign& design) { design.reconstruction.outside = OutsideDetector::zero; }},
    {"DetectorAsWideAsTheGrid", [](SensorDesign& design) { design.detector.window = 4.0; }},
    {"Oversampling2", [](SensorDesign& design) { design.reconstruction.oversampling = 2; }},
    {"Oversampling3", [](SensorDesign& design) { design.reconstruction.oversampling = 3; }},
    {"Oversampling2ZeroOutside",
     [](SensorDesign& design) {
       design.reconstruction.oversampling = 2;
       design.reconstruction.outside = OutsideDetector::zero;
     }},
    {"BorderThatIsNoWholePixel",
     [](SensorDesign& design) {
       design.reconstruction.oversampling = 3;
       design.reconstruction.window = 3.0 + 2.0 / 48.0;
     }},
    {"OverRelaxed",
     [](SensorDesign& design) {
       design.reconstruction.relaxation_start = design.reconstruction.relaxation_end = 0.5;
     }},
    {"UnderRelaxed",
     [](SensorDesign& design) {
       design.reconstruction.relaxation_start = design.reconstruction.relaxation_end = -0.7;
     }},
    {"RelaxationRamp",
     [](SensorDesign& design) {
       design.reconstruction.relaxation_start = 0.6;
       design.reconstruction.relaxation_end = -0.4;
     }},
    {"RelaxedOversampledRamp",
     [](SensorDesign& design) {
       design.reconstruction.oversampling = 2;
       design.reconstruction.relaxation_start = -0.5;
       design.reconstruction.relaxation_end = 0.5;
     }},
    {"OtherOrder",
     [](SensorDesign& design) {
       design.planes = {20e3, -60e3, -20e3, 60e3};
     }},
    {"TwoPlanes",
     [](SensorDesign& design) {
       design.planes = {35e3, -50e3};
     }},
    {"ThreePlanes",
     [](SensorDesign& design) {
       design.planes = {-50e3, 35e3, 70e3};
     }},
    {"FivePlanes",
     [](SensorDesign& design) {
       design.planes = {-60e3, 60e3, -20e3, 20e3, 5e3};
     }},
    {"EqualPlanes",
     [](SensorDesign& design) {
       design.planes = {-50e3, 35e3, -50e3};
     }},
    {"EqualPlanesInSuccession",
     [](SensorDesign& design) {
       design.planes = {-50e3, -50e3, 35e3};
     }},
    {"PupilPlaneFirst",
     [](SensorDesign& design) {
       design.planes = {0.0, -50e3, 35e3};
     }},
    {"PupilPlaneInTheMiddle",
     [](SensorDesign& design) {
       design.planes = {-50e3, 0.0, 35e3};
     }},
    {"PupilPlaneLast",
     [](SensorDesign& design) {
       design.planes = {-50e3, 35e3, 0.0};
     }},
    {"PupilPlaneFirstZeroOutside",
     [](SensorDesign& design) {
       design.planes = {0.0, -50e3, 35e3};
       design.reconstruction.outside = OutsideDetector::zero;
     }},
    {"PupilPlaneLastZeroOutside",
     [](SensorDesign& design) {
       design.planes = {-50e3, 35e3, 0.0};
       design.reconstruction.outside = OutsideDetector::zero;
     }},
    {"EqualPlanesZeroOutside",
     [](SensorDesign& design) {
       design.planes = {-50e3, -50e3, 35e3};
       design.reconstruction.outside = OutsideDetector::zero;
     }},
    {"OnlyPupilPlanes",
     [](SensorDesign& design) {
       design.planes = {0.0, 0.0};
     }},
    {"CentralObscuration", [](SensorDesign&) {}, 0.3},
};
INSTANTIATE_TEST_SUITE_P(Variations, GerchbergSaxtonVariation, testing::ValuesIn(variations),
                         [](const auto& variation) { return variation.param.name; });

/// The image moved by whole pixels on its periodic grid.
Image<double> rolled(const Image<double>& image, Eigen::Index x, Eigen::Index y) {
  Image<double> moved(image.rows(), image.cols());
  for (Eigen::Index row = 0; row < image.rows(); ++row) {
    for (Eigen::Index column = 0; column < image.cols(); ++column) {
      moved((row + y + image.rows()) % image.rows(), (column + x + image.cols()) % image.cols()) =
          image(row, column);
    }
  }
  return moved;
}

std::vector<Image<double>> rolled(const std::vector<Image<double>>& images,
                                  const std::vector<Eigen::Array2d>& axes) {
  std::vector<Image<double>> moved;
  for (std::size_t plane = 0; plane < images.size(); ++plane) {
    moved.push_back(
        rolled(images[plane], Eigen::Index(axes[plane].x()), Eigen::Index(axes[plane].y())));
  }
  return moved;
}

TEST(GerchbergSaxton, FindsTheLightWhereTheAxisMeetsEachDetector) {
  SensorDesign design = small_design();
  design.detector.window = 4.0;  // the whole grid, so that nothing is lost by moving
  design.planes = {-60e3, 0.0, -20e3, -20e3};
  const std::vector<Eigen::Array2d> axes{{3.0, -2.0}, {-1.0, 4.0}, {0.0, 0.0}, {5.0, 1.0}};
  for (const int oversampling : {1, 2}) {
    design.reconstruction.oversampling = oversampling;
    const PhaseScreen phase = turbulence(design.pupil_samples());
    const auto images = matched_images(telescope, design, phase);
    const auto moved = rolled(images, axes);
    const GerchbergSaxton<double> centred(telescope, design);
    const GerchbergSaxton<double> off_axis(telescope, design, axes);
    const Field<double> expected = centred.reconstruct(images).pupil_field;
    EXPECT_LT((off_axis.reconstruct(moved).pupil_field - expected).abs().maxCoeff(), 1e-10);
    EXPECT_GT((centred.reconstruct(moved).pupil_field - expected).abs().maxCoeff(), 0.5);
    const auto predicted = off_axis.predict(pupil_field(phase, centred.mask()));
    for (std::size_t plane = 0; plane < moved.size(); ++plane) {
      EXPECT_LT((predicted[plane] - moved[plane]).abs().maxCoeff(), 1e-10) << plane;
    }
  }
}

TEST(GerchbergSaxton, CountsCentroidsFromTheAxis) {
  SensorDesign design = small_design();
  design.reconstruction.initial_guess = InitialGuess::centroid;
  design.reconstruction.max_loops = 1;
  const auto images = matched_images(telescope, design, turbulence(16));
  const std::vector<Eigen::Array2d> axes{{1.0, -1.0}, {-1.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}};
  const auto moved = rolled(images, axes);
  const GerchbergSaxton<double> centred(telescope, design);
  const Field<double> expected = centred.reconstruct(images).pupil_field;
  const auto difference = [&](const GerchbergSaxton<double>& reconstructor) {
    return wrapped_phase_rms(reconstructor.reconstruct(moved).pupil_field, expected,
                             centred.mask());
  };
  EXPECT_LT(difference(GerchbergSaxton<double>(telescope, design, axes)),
            0.1 * difference(centred));
}

TEST(GerchbergSaxton, StartsFromTheSameTiltWithBadPixels) {
  // One loop from the centroids' tilt: bad pixels in the light must not move it much.
  SensorDesign design = small_design();
  design.reconstruction.initial_guess = InitialGuess::centroid;
  design.reconstruction.max_loops = 1;
  const PhaseScreen phase = turbulence(design.pupil_samples());
  const auto images = matched_images(telescope, design, phase);
  std::vector<Image<double>> bad = images;
  std::vector<Image<double>> dark = images;
  for (std::size_t plane = 0; plane < images.size(); ++plane) {
    bad[plane].block(20, 18, 3, 3).setConstant(std::nan(""));
    dark[plane].block(20, 18, 3, 3).setZero();
  }
  const GerchbergSaxton<double> reconstructor(telescope, design);
  const Field<double> expected = reconstructor.reconstruct(images).pupil_field;
  const auto difference = [&](const std::vector<Image<double>>& of) {
    return wrapped_phase_rms(reconstructor.reconstruct(of).pupil_field, expected,
                             reconstructor.mask());
  };
  EXPECT_LT(difference(bad), 0.5 * difference(dark));
}

TEST(GerchbergSaxton, KeepsNothingOfTheReconstructionBefore) {
  for (const auto& planes :
       std::vector<std::vector<double>>{{-60e3, 60e3, -20e3, 20e3}, {0.0, -50e3, 35e3}}) {
    SensorDesign design;
    design.planes = planes;
    design.detector = {.pupil_pixels = 16, .window = 2.0};
    design.reconstruction.window = 4.0;
    design.reconstruction.max_loops = 3;
    const auto images = matched_images(telescope, design, turbulence(16));
    const auto others = matched_images(telescope, design, PhaseScreen::Zero(16, 16));
    const GerchbergSaxton<double> used(telescope, design);
    used.reconstruct(others);
    const Field<double> again = used.reconstruct(images).pupil_field;
    const Field<double> fresh =
        GerchbergSaxton<double>(telescope, design).reconstruct(images).pupil_field;
    EXPECT_TRUE((again == fresh).all());
  }
}

TEST(GerchbergSaxton, CountsTwoTransformsForEachHopOfSomeLength) {
  SensorDesign design = small_design();
  const auto transforms_per_loop = [&](std::vector<double> planes) {
    design.planes = std::move(planes);
    const auto images = contradictory_images(telescope, design);
    const Reconstruction result = GerchbergSaxton<double>(telescope, design).reconstruct(images);
    EXPECT_EQ(result.fft_count % result.loops, 0);
    return result.fft_count / result.loops;
  };
  EXPECT_EQ(transforms_per_loop({-60e3, 60e3, -20e3, 20e3}), 10);
  EXPECT_EQ(transforms_per_loop({-60e3, 60e3}), 6);
  EXPECT_EQ(transforms_per_loop({-60e3, -60e3, 60e3}), 6);
  EXPECT_EQ(transforms_per_loop({0.0, -60e3, 60e3}), 6);
  EXPECT_EQ(transforms_per_loop({-60e3, 0.0, 60e3}), 8);
  EXPECT_EQ(transforms_per_loop({-60e3, 60e3, 0.0}), 6);
  EXPECT_EQ(transforms_per_loop({0.0, 0.0}), 0);
}

TEST(GerchbergSaxton, FindsTheFieldThatMadeMatchedImages) {
  SensorDesign design = small_design();
  design.detector.window = design.reconstruction.window;
  const PhaseScreen phase = turbulence(16);
  const auto images = matched_images(telescope, design, phase);
  const auto error_after = [&](int loops) {
    design.reconstruction.max_loops = loops;
    const Reconstruction result = GerchbergSaxton<double>(telescope, design).reconstruct(images);
    const PupilMask mask = pupil_mask(16, 0.0);
    return wrapped_phase_rms(result.pupil_field, pupil_field(phase, mask), mask);
  };
  EXPECT_GT(error_after(1), 1.0);
  EXPECT_LT(error_after(40), 1e-4);
  EXPECT_LT(error_after(100), 1e-12);
}

TEST(GerchbergSaxton, StaysOnTheFlatFieldThatMadeTheImages) {
  SensorDesign design = small_design();
  design.detector.window = design.reconstruction.window;
  const auto images = matched_images(telescope, design, PhaseScreen::Zero(16, 16));
  for (const StoppingRule rule : {StoppingRule::difference, StoppingRule::rms_change}) {
    design.reconstruction.stopping = rule;
    design.reconstruction.tolerance = 1e-15;
    const Reconstruction result = GerchbergSaxton<double>(telescope, design).reconstruct(images);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.loops, 1);
    EXPECT_EQ(result.fractional_loops, 1.0);
    // A tolerance of 0 is never met, not even by a change of 0.
    design.reconstruction.tolerance = 0.0;
    const Reconstruction full = GerchbergSaxton<double>(telescope, design).reconstruct(images);
    EXPECT_FALSE(full.converged);
    EXPECT_EQ(full.loops, design.reconstruction.max_loops);
  }
}

class GerchbergSaxtonStopping : public testing::TestWithParam<StoppingRule> {
 protected:
  GerchbergSaxtonStopping() {
    design_.detector.window = design_.reconstruction.window;
    design_.reconstruction.stopping = GetParam();
    design_.reconstruction.max_loops = 20;
    images_ = matched_images(telescope, design_, turbulence(16));
  }

  Reconstruction reconstruct() const {
    return GerchbergSaxton<double>(telescope, design_).reconstruct(images_);
  }

  SensorDesign design_ = small_design();
  std::vector<Image<double>> images_;
};

TEST_P(GerchbergSaxtonStopping, StopsAtTheFirstChangeBelowTheTolerance) {
  const double tolerance = 1e-9;
  design_.reconstruction.tolerance = tolerance;
  const Reconstruction result = reconstruct();
  ASSERT_TRUE(result.converged);
  ASSERT_GT(result.loops, 1);
  ASSERT_EQ(result.changes.size(), std::size_t(result.loops));
  for (int loop = 0; loop + 1 < result.loops; ++loop) EXPECT_GE(result.changes[loop], tolerance);
  EXPECT_LT(result.changes.back(), tolerance);
  // Straight in the logarithm between the last two changes.
  EXPECT_GE(result.fractional_loops, result.loops - 1);
  EXPECT_LE(result.fractional_loops, result.loops);
  const double before = result.changes[result.changes.size() - 2];
  const double there = before * std::pow(result.changes.back() / before,
                                         result.fractional_loops - (result.loops - 1));
  EXPECT_NEAR(there, tolerance, 1e-9 * tolerance);
}

TEST_P(GerchbergSaxtonStopping, ReportsMaxLoopsWhereTheChangeStaysAboveTheTolerance) {
  design_.reconstruction.tolerance = 1e-9;
  const int needed = reconstruct().loops;
  design_.reconstruction.max_loops = needed;
  EXPECT_TRUE(reconstruct().converged);
  design_.reconstruction.max_loops = needed - 1;
  const Reconstruction result = reconstruct();
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.loops, needed - 1);
  EXPECT_EQ(result.fractional_loops, needed - 1);
  EXPECT_EQ(result.changes.size(), std::size_t(needed - 1));
}

TEST_P(GerchbergSaxtonStopping, ChangesAreThoseOfItsDefinition) {
  design_.reconstruction.tolerance = 0.0;
  const PupilMask mask = pupil_mask(16, 0.0);
  const PhaseUnwrapper unwrapper(mask, design_.reconstruction.unwrapping);
  Field<double> before = mask.cast<std::complex<double>>();
  const double length_per_radian = telescope.wavelength / (2.0 * std::numbers::pi);
  for (const int loops : {1, 2, 3}) {
    design_.reconstruction.max_loops = loops;
    const Reconstruction result = reconstruct();
    const double change =
        GetParam() == StoppingRule::difference
            ? wrapped_phase_rms(result.pupil_field, before, mask)
            : std::abs(piston_free_rms(unwrapper.unwrap(result.pupil_field), mask) -
                       piston_free_rms(unwrapper.unwrap(before), mask));
    EXPECT_NEAR(result.changes.back(), change * length_per_radian, 1e-18);
    before = result.pupil_field;
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, GerchbergSaxtonStopping,
                         testing::Values(StoppingRule::difference, StoppingRule::rms_change),
                         [](const auto& rule) {
                           return rule.param == StoppingRule::difference ? "difference"
                                                                         : "rms_change";
                         });

/// The field that a reconstruction starts from: a relaxation next to -1 leaves every amplitude as
/// it is, so that a loop is a round trip.
Field<double> first_estimate(SensorDesign design, const std::vector<Image<double>>& images) {
  design.reconstruction.max_loops = 1;
  design.reconstruction.relaxation_start = -1.0 + 1e-12;
  design.reconstruction.initial_guess = InitialGuess::centroid;
  design.validate(telescope);
  return GerchbergSaxton<double>(telescope, design).reconstruct(images).pupil_field;
}

/// The phase of a slope (radians of angle) along x and y.
PhaseScreen tilt(double slope_x, double slope_y, int samples) {
  return PhaseScreen::NullaryExpr(samples, samples, [&](Eigen::Index row, Eigen::Index column) {
    const double pitch = telescope.diameter / samples;
    return 2.0 * std::numbers::pi / telescope.wavelength * pitch *
           (slope_x * (double(column) - 0.5 * (samples - 1)) +
            slope_y * (double(row) - 0.5 * (samples - 1)));
  });
}

TEST(GerchbergSaxton, StartsFromTheTiltThatTheCentroidsShow) {
  // A Gaussian beam: a sharp edge's light beyond the sampling's band limit is seen on the other
  // side, which moves the centroid by a share of about 0.6 / samples.
  const double slope_x = 1.1e-6;
  const double slope_y = -0.7e-6;
  const int samples = 32;
  SensorDesign design = small_design();
  design.detector.pupil_pixels = samples;
  const PupilMask mask = pupil_mask(samples, 0.0);
  const PhaseScreen truth = tilt(slope_x, slope_y, samples);
  Field<double> beam = pupil_field(truth, mask);
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const double radius = std::hypot(row - 0.5 * (samples - 1), column - 0.5 * (samples - 1));
      beam(row, column) *= std::exp(-std::pow(radius / (samples / 8.0), 2));
    }
  }
  const WrapFreePropagator light(samples, design.detector.width(), telescope.diameter / samples,
                                 telescope.wavelength);
  Field<double> spectrum = light.working_field();
  light.transform(beam, spectrum);
  Field<double> field = light.working_field();
  for (const auto& planes : std::vector<std::vector<double>>{
           {-60e3, 60e3, -20e3, 20e3}, {30e3, 50e3}, {-30e3, -50e3}, {0.0, -50e3}}) {
    design.planes = planes;
    std::vector<Image<double>> images;
    for (const double plane : planes) {
      light.propagate(spectrum, light.transfer_function(plane), field);
      images.emplace_back(
          field.topLeftCorner(light.window_samples(), light.window_samples()).abs2());
    }
    const Field<double> start = first_estimate(design, images);
    EXPECT_LT(wrapped_phase_rms(start, pupil_field(truth, mask), mask),
              1e-3 * piston_free_rms(truth, mask));
    EXPECT_NEAR(start.abs2().sum(), double(mask.count()), 1e-6);
  }
}

TEST(GerchbergSaxton, WeighsTheCentroidsOfItsPlanesByTheirDistance) {
  // One bright pixel in each plane: the slope is sum(z x) / sum(z^2).
  SensorDesign design = small_design();
  design.planes = {-20e3, 0.0, 50e3, 30e3};
  design.reconstruction.oversampling = 2;
  std::vector<Image<double>> images(4, Image<double>::Zero(48, 48));
  const double pixel = telescope.diameter / 16;
  images[0](24 + 3, 24 - 2) = 1.0;
  images[1](0, 0) = 5.0;  // at the pupil a shift says nothing
  images[2](24 + 1, 24 + 4) = 0.2;
  // A dark plane says nothing either.
  const double moment = 20e3 * 20e3 + 50e3 * 50e3;
  const double slope_x = (-20e3 * -1.5 + 50e3 * 4.5) * pixel / moment;
  const double slope_y = (-20e3 * 3.5 + 50e3 * 1.5) * pixel / moment;
  const Field<double> start = first_estimate(design, images);
  const Field<double> expected = pupil_field(tilt(slope_x, slope_y, 32), pupil_mask(32, 0.0));
  EXPECT_LT((start - expected).abs().maxCoeff(), 1e-9);
}

TEST(GerchbergSaxton, BearsDarkImages) {
  SensorDesign design = small_design();
  const std::vector<Image<double>> dark(4, Image<double>::Zero(48, 48));
  for (const InitialGuess guess : {InitialGuess::flat, InitialGuess::centroid}) {
    for (const OutsideDetector outside : {OutsideDetector::free, OutsideDetector::zero}) {
      design.reconstruction.initial_guess = guess;
      design.reconstruction.outside = outside;
      EXPECT_TRUE(GerchbergSaxton<double>(telescope, design)
                      .reconstruct(dark)
                      .pupil_field.isFinite()
                      .all());
      EXPECT_TRUE(
          GerchbergSaxton<float>(telescope, design).reconstruct(dark).pupil_field.isFinite().all());
    }
  }
}

TEST(GerchbergSaxton, TakesNegativePixelsAsDark) {
  const SensorDesign design = small_design();
  auto images = matched_images(telescope, design, turbulence(16));
  for (Image<double>& image : images) image -= 0.05;
  const Reconstruction negative = GerchbergSaxton<double>(telescope, design).reconstruct(images);
  for (Image<double>& image : images) {
    EXPECT_LT(image.minCoeff(), 0.0);
    image = image.max(0.0).eval();
  }
  const Reconstruction dark = GerchbergSaxton<double>(telescope, design).reconstruct(images);
  EXPECT_TRUE((negative.pupil_field == dark.pupil_field).all());
}

}  // namespace
}  // namespace nlcwfs
