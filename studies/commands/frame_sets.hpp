// Sets of measured frames are reconstructed.
#pragma once

#include "model/frame_background.hpp"
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
  /// What is left of a background, per plane, in the file's unit; none without an unlit border.
  std::vector<std::optional<FrameBackground>> background;
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
  MeanAndError relative_rms;                ///< see PlaneConsistency
  std::optional<MeanAndError> noise;        ///< see SetResult
  MeanAndError misfit;                      ///< see SetResult
  std::optional<MeanAndError> correlation;  ///< see PlaneConsistency; none where a set has none
  MeanAndError light_share;                 ///< of the light on all planes
  MeanAndError captured_energy;             ///< see PlaneConsistency
  MeanAndError x;                           ///< pixels that the plane stands off
  MeanAndError y;                           ///< the same
  double measured_share = 0.0;              ///< the least of the sets', see PlaneConsistency
  /// The mean of the sets', with the mean of their errors: what the light's structure adds is much
  /// the same in all of them. None where a set has none.
  std::optional<FrameBackground> background;
  double background_share = 0.0;  ///< of the plane's light: what it adds on the whole detector

  /// Whether it has a background that matters.
  bool has_background() const {
    return background && background->is_significant() && std::abs(background_share) > 0.02;
  }
  /// Whether too little was measured to agree or not.
  bool is_mute() const { return !correlation || measured_share < 0.5; }
};

/// Of each plane, in visiting order.
std::vector<PlaneMeans> plane_means(const FrameRun& run);

}  // namespace nlcwfs
