// What a sensor is: planes, detector and reconstruction.
#pragma once

#include "model/detector.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/telescope.hpp"

#include <string_view>
#include <vector>

namespace nlcwfs {

/// When the loop ends; the change is compared with the tolerance after each loop.
enum class StoppingRule {
  difference,  ///< RMS over the pupil of the piston-free phase change since the loop before
  rms_change   ///< change of the RMS of the unwrapped wavefront since the loop before
};

/// The pupil field that the loop starts from, of unit amplitude.
enum class InitialGuess {
  flat,     ///< flat phase
  centroid  ///< the tilt that the images' centroids give, by least squares over the planes
};

/// What the amplitude step does to the field outside the detector's window.
enum class OutsideDetector {
  free,  ///< leaves it: unmeasured is not dark
  zero   ///< sets it to 0
};

/// The reconstructor's settings.
struct ReconstructionOptions {
  int max_loops = 20;                                ///< the loops end there, converged or not
  double tolerance = 1e-9;                           ///< m of optical path; 0 = always max_loops
  StoppingRule stopping = StoppingRule::difference;  ///< when the loops end
  double relaxation_start = 0.0;                     ///< beta of the first loop, -1 < beta < 1
  double relaxation_end = 0.0;                       ///< beta of loop max_loops; linear in between
  InitialGuess initial_guess = InitialGuess::flat;   ///< of the phase in the pupil
  double window = 8.0;  ///< width of the reconstruction grid, pupil diameters
  OutsideDetector outside = OutsideDetector::free;  ///< what the field outside the detector becomes
  int oversampling = 1;  ///< samples of the grid per detector pixel and axis
  UnwrappingMethod unwrapping = UnwrappingMethod::least_squares;  ///< of the reconstructed phase

  /// beta of a loop, counted from 1.
  double relaxation(int loop) const;
};

/// How far from the pupil a plane may be, m: at the Fresnel number 0.1, beyond which a sensor of
/// pupil-sized windows sees nothing.
double farthest_distance(const Telescope& telescope);

/// Demands at least 2 planes, none beyond farthest_distance().
/// @param key  the key that holds the planes
/// @throws InputError naming `key`
void validate_planes(std::string_view key, const std::vector<double>& planes,
                     const Telescope& telescope);

/// A sensor: where its planes stand, how they are sampled, and how they are read.
struct SensorDesign {
  std::vector<double> planes = {-180e3, 180e3, -47e3, 47e3};  ///< signed m, in visiting order
  Detector detector;                                          ///< the same for every plane
  ReconstructionOptions reconstruction;                       ///< how the phase is found

  /// Samples across the pupil diameter on the reconstruction grid.
  int pupil_samples() const { return detector.pupil_pixels * reconstruction.oversampling; }
  /// Samples along each side of the reconstruction grid.
  int grid_width() const;

  /// @throws InputError where a value is not allowed
  void validate(const Telescope& telescope) const;
};

}  // namespace nlcwfs
