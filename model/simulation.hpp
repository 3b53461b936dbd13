// One design on one set of wavefronts, from the pupil to its performance.
#pragma once

#include "model/array.hpp"
#include "model/image_cache.hpp"
#include "model/light_source.hpp"
#include "model/performance.hpp"
#include "model/pupil.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"
#include "model/true_light.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace nlcwfs {

/// The precision of the reconstruction; the data are always made in double precision.
enum class Precision { double_precision, single_precision };

/// How the data are made and reconstructed.
struct SimulationOptions {
  TruthModel truth = TruthModel::extended;  ///< which light makes the images
  Precision precision =
      Precision::double_precision;  ///< of the reconstruction; images are made in double precision
  std::uint64_t noise_seed = 1;  ///< photon and read noise; streams are keyed by screen and plane
  LightSource source = {};       ///< wavelengths of the light
  /// That one wavefront may take, s: looked at between its loops. A design with a slower one fails.
  double time_limit = std::numeric_limits<double>::infinity();
};

/// What of the program decides on the result of a simulation, beside its input: raised by every
/// change after which equal input may give other bits.
constexpr int model_version = 2;

/// Asked after each screen that is done, by the thread that did it and by several at once: whether
/// another may be started. Screens are started in order, so those that are done are the first ones;
/// one at least always is.
using ScreenWatch = std::function<bool()>;

/// A design as it is simulated: with a matched or periodic truth the detector is as wide as the
/// reconstruction grid.
/// @param truth_samples  of the true field across the diameter
/// @throws InputError where the design is not valid, or does not fit the truth's samples or the
///         source
SensorDesign simulated_design(SensorDesign design, const Telescope& telescope,
                              const SimulationOptions& options, int truth_samples);

/// Judges sensor designs on a fixed set of wavefronts: pupil field -> propagation to each plane ->
/// detector images -> Gerchberg-Saxton reconstruction -> unwrapping -> metrics.
///
/// Every design sees the same wavefronts and the same streams of noise (common random numbers).
/// Screens run in parallel; the result does not depend on the number of threads. Images are kept
/// for designs that share planes.
///
/// Memory: the screens, kept images of at most 256 MiB, and for each thread two complex fields of
/// (detector + pupil) x (detector + pupil) truth samples and one of the reconstruction grid, with
/// the images of one screen; before that, up to 1 GiB for the kernel of a plane (64 MiB at the
/// paper's distances). Kept images are of use as long as one design's fit.
class Simulation {
 public:
  /// @param screens  true phases, all m x m samples across the diameter, rad
  /// @throws InputError where there is no screen
  Simulation(const Telescope& telescope, std::vector<PhaseScreen> screens,
             SimulationOptions options);

  /// @throws InputError where the design is not valid or does not fit the truth's samples
  /// @throws std::runtime_error where a wavefront takes too long or ends in what is no number
  Performance evaluate(const SensorDesign& design, const ScreenWatch& watch = {}) const;

  /// The same on `count` screens alone, of which `first` is the first; they are counted from 0.
  /// Each screen's result is that of the evaluation on all of them.
  Performance evaluate(const SensorDesign& design, int first, int count,
                       const ScreenWatch& watch = {}) const;

  /// The same with all of max_loops, whatever the tolerance, and with
  /// ScreenPerformance::residual_after_loops, which costs an unwrapping for each loop.
  Performance follow(SensorDesign design, const ScreenWatch& watch = {}) const;

  /// One screen of evaluate() with all that the sensor saw and made, and with
  /// ScreenPerformance::residual_after_loops. The rest of the performance, but for what a clock
  /// measured, is the evaluation's to the last bit.
  ScreenRecord record(const SensorDesign& design, int screen) const;

  /// See simulated_design.
  SensorDesign checked(SensorDesign design) const;

  /// A name of all that decides on a design's result: model_version, telescope, wavefronts and
  /// options, but not the time limit, which decides only on whether there is one. Equal simulations
  /// have equal names, on all machines with the same floating point format.
  std::string identity() const;

  /// The telescope that the wavefronts have come through.
  const Telescope& telescope() const { return telescope_; }
  /// RMS of each true wavefront over the pupil, piston removed, m of optical path.
  std::vector<double> aberrations() const;
  /// How many wavefronts a design is tried on.
  int screen_count() const { return static_cast<int>(screens_.size()); }
  /// Samples of the true field across the diameter.
  int truth_samples() const { return static_cast<int>(mask_.rows()); }

 private:
  Performance run(const SensorDesign& design, std::size_t first, std::size_t count,
                  bool follows_loops, const ScreenWatch& watch) const;

  Telescope telescope_;
  std::vector<PhaseScreen> screens_;
  SimulationOptions options_;
  PupilMask mask_;
  mutable ImageCache images_;
};

}  // namespace nlcwfs
