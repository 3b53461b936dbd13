// A user's own frames are read, as the section frames describes them.
#pragma once

#include "model/array.hpp"
#include "studies/settings/configuration.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace nlcwfs {

/// A user's own frames, as the section frames of a configuration describes them.
struct MeasuredFrames {
  /// Of each set, one calibrated frame per plane in the order of sensor.planes, in the file's unit;
  /// see calibrated_frame.
  std::vector<std::vector<Image<double>>> sets;
  std::string unit;                  ///< BUNIT of the file; empty where it has none
  std::vector<Eigen::Array2d> axes;  ///< where the optical axis meets each calibrated frame: x, y
                                     ///< from its middle, pixels
  std::vector<double> throughputs;   ///< frames.flux; empty = not known

  /// Pixels along each side.
  Eigen::Index width() const { return sets.front().front().rows(); }
};

/// Reads and calibrates them.
/// @throws InputError where a file or a value is missing, is not allowed or does not fit the
///         others, or leaves a plane without light
MeasuredFrames measured_frames_of(const Configuration& configuration);

/// Sets detector.window to the width of the frames.
/// @throws InputError where the configuration sets it to another, or the frames are narrower than
///         the pupil or wider than the reconstruction's grid
void set_detector_window(Configuration& configuration, const MeasuredFrames& frames);

}  // namespace nlcwfs
