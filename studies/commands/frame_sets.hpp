// Sets of measured frames are reconstructed.
#pragma once

#include "model/frame_reconstruction.hpp"
#include "studies/settings/measured_frames.hpp"

namespace nlcwfs {

/// What became of one set of frames.
struct SetResult {
  FrameReconstruction frames;  ///< as reconstructed
  Image<double> phase;         ///< rad, piston removed, NaN outside the pupil
  double wavefront_rms = 0.0;  ///< m of path over the pupil, piston removed
  /// Relative RMS that noise alone leaves, per plane; none if not known.
  std::vector<double> noise;
  std::vector<double> misfit;  ///< relative RMS beyond what noise explains, per plane
};

/// All sets; after an interrupt those before the first that is not done, one at least.
std::vector<SetResult> reconstruct_sets(const GerchbergSaxton<double>& reconstructor,
                                        const SensorDesign& design, const Telescope& telescope,
                                        const MeasuredFrames& measured);

/// Everything that the files and texts are made of.
struct FrameRun {
  const Telescope& telescope;          ///< that saw them
  const SensorDesign& design;          ///< of the sensor
  const MeasuredFrames& measured;      ///< the frames
  const std::vector<SetResult>& sets;  ///< what became of them
};

/// The mean of a set's figure.
template <class Metric>
MeanAndError mean_over_sets(const FrameRun& run, const Metric& metric) {
  std::vector<double> values;
  for (const SetResult& set : run.sets) values.push_back(metric(set));
  return mean_and_standard_error(values);
}

/// A plane's figures, means over the sets.
struct PlaneMeans {
  MeanAndError relative_rms;          ///< see PlaneConsistency
  std::optional<MeanAndError> noise;  ///< see SetResult
  MeanAndError misfit;                ///< see SetResult
  MeanAndError correlation;           ///< see PlaneConsistency
  MeanAndError light_share;           ///< of the light on all planes
  MeanAndError captured_energy;       ///< see PlaneConsistency
  MeanAndError x;                     ///< pixels that the plane stands off
  MeanAndError y;                     ///< the same
};

/// Of each plane, in visiting order.
std::vector<PlaneMeans> plane_means(const FrameRun& run);

}  // namespace nlcwfs
