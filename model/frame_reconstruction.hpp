// Wavefronts are reconstructed from measured frames, and held against them.
#pragma once

#include "model/gerchberg_saxton.hpp"

#include <optional>
#include <span>
#include <vector>

namespace nlcwfs {

/// How well what the reconstruction predicts for a plane agrees with what was measured there, over
/// the pixels that were measured.
struct PlaneConsistency {
  /// RMS of measured less predicted intensity over the RMS of the predicted.
  double relative_rms = 0.0;
  /// Pearson's, of measured and predicted intensity; none where one of them is the same everywhere.
  std::optional<double> correlation = {};
  /// Share of the predicted light in the detector's window that fell on the measured pixels.
  double measured_share = 0.0;
  /// How much light the plane got: the counts in the frame that a pupil of unit amplitude would
  /// make, if all of its light fell on the detector.
  double light = 0.0;
  double captured_energy = 0.0;  ///< predicted share of that light in the detector's window
  /// By how many pixels the measured image stands off the predicted one (x, y): the shift that
  /// explains their difference best, by least squares to first order.
  Eigen::Array2d displacement = Eigen::Array2d::Zero();
  int measured_pixels = 0;  ///< pixels that are not bad
};

/// A wavefront from measured frames.
struct FrameReconstruction {
  Reconstruction reconstruction;         ///< of the last pass
  std::vector<Image<double>> measured;   ///< the frames in units of the unaberrated pupil's
                                         ///< intensity, as the loop saw them
  std::vector<Image<double>> predicted;  ///< the images of the reconstructed pupil, same units
  std::vector<PlaneConsistency> planes;  ///< in visiting order
  int passes = 0;  ///< reconstructions until the light of the planes had settled
};

/// Reconstructs a wavefront from frames whose scale is not known.
///
/// The loop needs the planes' intensities relative to each other (a factor common to all only
/// scales the field). A frame's own sum does not give it: some of the light misses the detector,
/// more of it in the farther planes (1.5 % at 47 km and about 10 % at 180 km on four diameters,
/// D/r0 = 4). So the share that falls on the measured pixels is taken from the reconstruction
/// itself: all of it at first, then what the reconstructed pupil sends there, until no plane's
/// light changes by more than 0.1 %.
///
/// @param frames       one per plane in visiting order, detector width x width; NaN = not measured
/// @param throughputs  the planes' light relative to each other; empty = not known, then each
///                     plane's is found on its own as above, else only a common factor
/// @pre every frame's sum over its measured pixels is above 0
FrameReconstruction reconstruct_frames(const GerchbergSaxton<double>& reconstructor,
                                       std::span<const Image<double>> frames,
                                       std::span<const double> throughputs);

/// The relative RMS that photon and read noise alone would leave between an image and its
/// expectation: sqrt(sum (I / q + (sigma / q)^2) / sum I^2).
/// @param predicted         expected intensity I; NaN is left out
/// @param photons_per_unit  q: photons in a pixel of intensity 1
/// @param read_noise        sigma: electrons RMS per pixel
double relative_noise(const Image<double>& predicted, double photons_per_unit, double read_noise);

}  // namespace nlcwfs
