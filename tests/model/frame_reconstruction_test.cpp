// Tests: Wavefronts are reconstructed from measured frames, and held against them.
#include "model/frame_reconstruction.hpp"

#include "model/frame_calibration.hpp"
#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

const Telescope telescope;
constexpr int truth_samples = 64;
constexpr double nm = 1e-9;

SensorDesign design() {
  SensorDesign design;
  design.detector.pupil_pixels = 32;
  design.reconstruction.max_loops = 40;
  return design;
}

PhaseScreen truth(int screen) {
  const Seeing seeing{.fried_parameter = telescope.diameter / 4.0};
  return TurbulenceScreenGenerator(seeing, truth_samples, telescope.diameter, 3).screen(screen);
}

/// The light on detectors whose middles stand off the optical axis, on an infinite plane.
/// @param axes  where the axis meets each, pixels from its middle
std::vector<Image<double>> light(const SensorDesign& design, const PhaseScreen& phase,
                                 const std::vector<Eigen::Array2d>& axes) {
  const int per_pixel = truth_samples / design.detector.pupil_pixels;
  const double pitch = telescope.diameter / truth_samples;
  const int window = design.detector.width() * per_pixel;
  const WrapFreePropagator propagator(truth_samples, window, pitch, telescope.wavelength);
  const PupilMask mask = pupil_mask(truth_samples, 0.0);
  const Eigen::ArrayXd position =
      Eigen::ArrayXd::LinSpaced(truth_samples, 0, truth_samples - 1) * pitch;
  std::vector<Image<double>> images;
  for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
    // By the Fresnel integral, a tilt of slope s / z moves the intensity at z by s.
    const double pixel = pitch * per_pixel;
    const double wave_number = 2.0 * std::numbers::pi / telescope.wavelength;
    PhaseScreen tilted = phase;
    tilted.rowwise() +=
        wave_number * axes[plane].x() * pixel / design.planes[plane] * position.transpose();
    tilted.colwise() += wave_number * axes[plane].y() * pixel / design.planes[plane] * position;
    Field<double> spectrum = propagator.working_field();
    Field<double> field = propagator.working_field();
    propagator.transform(pupil_field(tilted, mask), spectrum);
    propagator.propagate(spectrum, propagator.transfer_function(design.planes[plane]), field);
    images.push_back(integrate_pixels(field.topLeftCorner(window, window), per_pixel));
  }
  return images;
}

std::vector<Image<double>> light(const SensorDesign& design, const PhaseScreen& phase) {
  return light(design, phase,
               std::vector<Eigen::Array2d>(design.planes.size(), Eigen::Array2d::Zero()));
}

/// The residual wavefront error, m.
double residual(const GerchbergSaxton<double>& reconstructor, const FrameReconstruction& result,
                const PhaseScreen& phase) {
  const Field<double>& pupil = result.reconstruction.pupil_field;
  return measure_wavefront(pupil, reconstructor.unwrapper().unwrap(pupil), reconstructor.mask(),
                           phase, pupil_mask(truth_samples, 0.0), telescope.wavelength)
      .residual_wfe;
}

double worst_rms(const FrameReconstruction& result) {
  double worst = 0.0;
  for (const PlaneConsistency& plane : result.planes) {
    worst = std::max(worst, plane.relative_rms);
  }
  return worst;
}

/// What evaluate finds for the screen.
ScreenPerformance evaluated(const SensorDesign& design, const PhaseScreen& phase) {
  return Simulation(telescope, {phase}, {}).evaluate(design).screens.front();
}

TEST(FrameReconstruction, IsAsGoodAsEvaluateSaysWithoutKnowingTheLight) {
  for (const int screen : {0, 1, 2}) {
    const PhaseScreen phase = truth(screen);
    auto frames = light(design(), phase);
    const std::vector<double> gains{0.7e4, 1.5e4, 3e4, 1e4};
    for (std::size_t plane = 0; plane < frames.size(); ++plane) frames[plane] *= gains[plane];
    const GerchbergSaxton<double> reconstructor(telescope, design());
    const FrameReconstruction result = reconstruct_frames(reconstructor, frames, {});
    const ScreenPerformance expected = evaluated(design(), phase);
    EXPECT_NEAR(residual(reconstructor, result, phase), expected.wavefront.residual_wfe, 0.3 * nm);
    EXPECT_LT(worst_rms(result), 0.1);
    EXPECT_GT(result.passes, 1);
    // A frame's own sum would be that much off.
    EXPECT_LT(expected.captured_energy[0], 0.95);
    for (std::size_t plane = 0; plane < frames.size(); ++plane) {
      const PlaneConsistency& found = result.planes[plane];
      EXPECT_NEAR(found.light / (gains[plane] * reconstructor.pupil_energy()), 1.0, 0.025);
      EXPECT_NEAR(found.captured_energy, expected.captured_energy[plane], 0.02);
      EXPECT_GT(found.correlation.value_or(0.0), 0.99);
      EXPECT_EQ(found.measured_pixels, 128 * 128);
    }
  }
}

TEST(FrameReconstruction, TakesThroughputsThatAreKnown) {
  const PhaseScreen phase = truth(1);
  auto frames = light(design(), phase);
  const std::vector<double> throughputs{1.0, 2.0, 0.5, 1.0};
  for (std::size_t plane = 0; plane < frames.size(); ++plane) frames[plane] *= throughputs[plane];
  const GerchbergSaxton<double> reconstructor(telescope, design());
  const FrameReconstruction right = reconstruct_frames(reconstructor, frames, throughputs);
  EXPECT_NEAR(residual(reconstructor, right, phase),
              evaluated(design(), phase).wavefront.residual_wfe, 0.3 * nm);
  EXPECT_NEAR(right.planes[1].light / right.planes[2].light, 4.0, 1e-12);
  const FrameReconstruction wrong =
      reconstruct_frames(reconstructor, frames, std::vector{1.0, 1.0, 1.0, 1.0});
  EXPECT_GT(worst_rms(wrong), 0.3);
  EXPECT_GT(wrong.planes[0].correlation.value_or(0.0), 0.99);  // the pattern is right all the same
}

TEST(FrameReconstruction, IsTheSameInEveryUnit) {
  const auto frames = light(design(), truth(0));
  auto scaled = frames;
  for (Image<double>& frame : scaled) frame *= 1024.0;  // exact in binary
  const GerchbergSaxton<double> reconstructor(telescope, design());
  const auto one = reconstruct_frames(reconstructor, frames, {});
  const auto other = reconstruct_frames(reconstructor, scaled, {});
  EXPECT_TRUE((one.reconstruction.pupil_field == other.reconstruction.pupil_field).all());
  EXPECT_EQ(other.planes[2].light, 1024.0 * one.planes[2].light);
}

TEST(FrameReconstruction, FollowsFramesOffTheAxisByFractionsOfAPixel) {
  const std::vector<Eigen::Array2d> axes{{1.3, -2.4}, {-3.75, 0.5}, {2.2, 2.6}, {-1.1, -0.35}};
  const PhaseScreen phase = truth(0);
  const auto frames = light(design(), phase, axes);
  const GerchbergSaxton<double> off_axis(telescope, design(), axes);
  const FrameReconstruction result = reconstruct_frames(off_axis, frames, {});
  EXPECT_NEAR(residual(off_axis, result, phase), evaluated(design(), phase).wavefront.residual_wfe,
              1.0 * nm);
  EXPECT_LT(worst_rms(result), 0.1);
  const GerchbergSaxton<double> centred(telescope, design());
  const FrameReconstruction wrong = reconstruct_frames(centred, frames, {});
  EXPECT_GT(residual(centred, wrong, phase), 20.0 * nm);
  EXPECT_GT(worst_rms(wrong), 0.1);
}

TEST(FrameReconstruction, TellsWhereAFrameStandsOff) {
  const PhaseScreen phase = truth(0);
  const auto frames = light(design(), phase, {{0, 0}, {0, 0}, {0, 0}, {1.5, 0.0}});
  const GerchbergSaxton<double> reconstructor(telescope, design());
  const FrameReconstruction result = reconstruct_frames(reconstructor, frames, {});
  const Eigen::Array2d found = result.planes[3].displacement - result.planes[2].displacement;
  EXPECT_GT(found.x(), 0.3);
  EXPECT_LT(std::abs(found.y()), 0.2);
}

TEST(FrameReconstruction, NeedsItsBadPixelsKnown) {
  const PhaseScreen phase = truth(2);
  auto frames = light(design(), phase);
  PixelMask bad = PixelMask::Constant(128, 128, false);
  RandomStream stream = random_stream({5});
  boost::random::uniform_real_distribution<double> chance(0.0, 1.0);
  for (bool& is_bad : bad.reshaped()) is_bad = chance(stream) < 0.01;
  bad.block(60, 50, 4, 4).setConstant(true);
  std::vector<Image<double>> masked;
  for (Image<double>& frame : frames) {
    frame = bad.select(3.0, frame);
    masked.push_back(calibrated_frame(frame, Image<double>::Zero(128, 128), bad,
                                      std::numeric_limits<double>::infinity()));
  }
  const GerchbergSaxton<double> reconstructor(telescope, design());
  const double good = residual(reconstructor, reconstruct_frames(reconstructor, masked, {}), phase);
  const double unmasked =
      residual(reconstructor, reconstruct_frames(reconstructor, frames, {}), phase);
  EXPECT_LT(good, evaluated(design(), phase).wavefront.residual_wfe + 3.0 * nm);
  EXPECT_GT(unmasked, good + 10.0 * nm);
  const FrameReconstruction result = reconstruct_frames(reconstructor, masked, {});
  EXPECT_EQ(result.planes[0].measured_pixels, bad.size() - bad.count());
  EXPECT_NEAR(result.planes[0].light / reconstructor.pupil_energy(), 1.0, 0.03);
}

TEST(FrameReconstruction, DisagreesWhereAPairsSignsAreSwapped) {
  const PhaseScreen phase = truth(0);
  const auto frames = light(design(), phase);
  SensorDesign wrong = design();
  std::swap(wrong.planes[2], wrong.planes[3]);
  const GerchbergSaxton<double> reconstructor(telescope, wrong);
  EXPECT_GT(worst_rms(reconstruct_frames(reconstructor, frames, {})), 0.3);
}

TEST(FrameReconstruction, CannotTellAllSignsFromTheOppositePhase) {
  // |U(x, -z)| of a pupil is |U(x, z)| of its complex conjugate.
  const PhaseScreen phase = truth(0);
  const auto frames = light(design(), phase);
  SensorDesign mirrored = design();
  for (double& plane : mirrored.planes) plane = -plane;
  const GerchbergSaxton<double> reconstructor(telescope, design());
  const GerchbergSaxton<double> other(telescope, mirrored);
  const FrameReconstruction right = reconstruct_frames(reconstructor, frames, {});
  const FrameReconstruction twin = reconstruct_frames(other, frames, {});
  EXPECT_LT((twin.reconstruction.pupil_field - right.reconstruction.pupil_field.conjugate())
                .abs()
                .maxCoeff(),
            1e-6);
  EXPECT_NEAR(worst_rms(twin), worst_rms(right), 1e-6);
}

TEST(FrameReconstruction, NoiseLeavesWhatItsFormulaSays) {
  const auto images = light(design(), truth(0));
  Image<double> noisy = images[0];
  const double photons_per_unit = 30.0;
  const double read_noise = 2.0;
  RandomStream stream = random_stream({1});
  add_noise(noisy, photons_per_unit, read_noise, stream);
  const double measured = std::sqrt((noisy - images[0]).square().sum() / images[0].square().sum());
  EXPECT_NEAR(measured / relative_noise(images[0], photons_per_unit, read_noise), 1.0, 0.03);
  // Half of the pixels, which are as bright and as noisy, leave as much.
  Image<double> half = Image<double>::Constant(10, 10, 2.0);
  half.topRows(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_DOUBLE_EQ(relative_noise(half, 8.0, 4.0), std::sqrt(0.25 + 0.25) / 2.0);
}

}  // namespace
}  // namespace nlcwfs
