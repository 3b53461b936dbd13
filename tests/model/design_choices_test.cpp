// What the choices of a design are worth, screen by screen: each holds by more than three standard
// errors of the paired difference.

#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr int pixels = 32;
const Telescope telescope;

std::vector<PhaseScreen> screens(double d_over_r0, int samples, int count = 16) {
  const Seeing seeing{.fried_parameter = telescope.diameter / d_over_r0};
  return generate_screens(TurbulenceScreenGenerator(seeing, samples, telescope.diameter, 11),
                          count);
}

/// The paper's layout, order and start.
SensorDesign papers_design() {
  SensorDesign design;
  design.planes = {-47e3, 47e3, -180e3, 180e3};
  design.detector.pupil_pixels = pixels;
  design.reconstruction.window = 4.0;
  return design;
}

/// How much more of a metric the one design has than the other.
MeanAndError excess(std::string_view metric, const Simulation& simulation, const SensorDesign& one,
                    const SensorDesign& other) {
  const auto samples = [&](const SensorDesign& design) {
    return simulation.evaluate(design).samples_of(performance_metric(metric));
  };
  std::vector<double> differences = samples(one);
  const std::vector<double> others = samples(other);
  for (std::size_t screen = 0; screen < others.size(); ++screen) {
    differences[screen] -= others[screen];
  }
  return mean_and_standard_error(differences);
}

class DesignChoices : public testing::Test {
 protected:
  Simulation matched_{telescope, screens(4.0, pixels), {.truth = TruthModel::matched}};
  Simulation extended_{telescope, screens(4.0, pixels), {.truth = TruthModel::extended}};
};

TEST_F(DesignChoices, StoppingByTheRmsEndsEarlierAndFartherFromTheTruth) {
  SensorDesign by_rms = papers_design();
  by_rms.reconstruction.stopping = StoppingRule::rms_change;
  const MeanAndError loops = excess("loops", matched_, papers_design(), by_rms);
  const MeanAndError error = excess("wrapped_wfe_nm", matched_, by_rms, papers_design());
  EXPECT_GT(loops.mean, 3.0 * loops.standard_error);
  EXPECT_GT(error.mean, 0.0);
}

TEST_F(DesignChoices, TheReconstructorsOwnGridExplainsLightThatNoSensorSees) {
  SensorDesign design = papers_design();
  design.reconstruction.outside = OutsideDetector::zero;
  const auto error = performance_metric("wrapped_wfe_nm");
  const MeanAndError matched = matched_.evaluate(design).mean_of(error);
  const MeanAndError extended = extended_.evaluate(design).mean_of(error);
  EXPECT_GT(extended.mean, 5.0 * matched.mean);
}

TEST_F(DesignChoices, UnmeasuredIsNotDark) {
  SensorDesign free = papers_design();
  free.reconstruction.window = 8.0;
  SensorDesign zero = free;
  zero.reconstruction.outside = OutsideDetector::zero;
  const MeanAndError error = excess("wrapped_wfe_nm", extended_, zero, free);
  EXPECT_GT(error.mean, 3.0 * error.standard_error);
}

TEST_F(DesignChoices, FarPlanesFirstLeavesLessError) {
  SensorDesign near_first = papers_design();
  near_first.reconstruction.window = 8.0;
  SensorDesign far_first = near_first;
  far_first.planes = {-180e3, 180e3, -47e3, 47e3};
  const MeanAndError error = excess("wrapped_wfe_nm", extended_, near_first, far_first);
  EXPECT_GT(error.mean, 3.0 * error.standard_error);
}

TEST(Loops, OverRelaxationAndACentroidStartSaveSome) {
  // About one loop, where single screens differ by several: it takes more screens to see.
  const Simulation simulation(telescope, screens(4.0, pixels, 128), {.truth = TruthModel::matched});
  SensorDesign relaxed = papers_design();
  relaxed.reconstruction.relaxation_start = relaxed.reconstruction.relaxation_end = 0.5;
  SensorDesign centred = papers_design();
  centred.reconstruction.initial_guess = InitialGuess::centroid;
  for (const SensorDesign& faster : {relaxed, centred}) {
    const MeanAndError loops = excess("fractional_loops", simulation, papers_design(), faster);
    EXPECT_GT(loops.mean, 3.0 * loops.standard_error);
  }
}

TEST(CoarsePixels, ReconstructionOnAFinerGridResolvesMore) {
  SensorDesign plain = papers_design();
  plain.planes = {-100e3, 100e3, -30e3, 30e3};
  plain.detector.pupil_pixels = 16;
  plain.reconstruction.window = 8.0;
  SensorDesign fine = plain;
  fine.reconstruction.oversampling = 2;
  const Simulation simulation(telescope, screens(6.0, 64), {});
  const MeanAndError error = excess("total_wfe_nm", simulation, plain, fine);
  EXPECT_GT(error.mean, 3.0 * error.standard_error);
}

}  // namespace
}  // namespace nlcwfs
