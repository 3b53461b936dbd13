// The loop: a wavefront is reconstructed from the images of several planes.
#pragma once

#include "model/array.hpp"
#include "model/fresnel_propagator.hpp"
#include "model/image_gaps.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/pupil.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

namespace nlcwfs {

/// What a reconstruction ended with. Starts as a failure.
struct Reconstruction {
  Field<double> pupil_field;      ///< n x n samples across the diameter, 0 outside the pupil
  bool converged = false;         ///< the stopping rule was met within max_loops
  int loops = 0;                  ///< loops that were run
  double fractional_loops = 0.0;  ///< loop count at which the change crosses the tolerance,
                                  ///< interpolated in log(change); max_loops where it does not
  int fft_count = 0;              ///< two-dimensional transforms of the reconstruction grid
  std::vector<double> changes;    ///< the stopping rule's change after each loop, m
};

/// Multi-plane Gerchberg-Saxton loop: pupil -> P1 -> P2 -> ... -> PN -> pupil in visiting order. At
/// each plane the amplitude becomes the measured one, its phase is kept; in the pupil everything
/// outside the aperture becomes 0 and the amplitude inside is kept.
/// Source: Guyon 2010 (PASP 122, 49); Letchev et al. 2022, section 2.3.
///
/// The amplitude step is a relaxed projection: with A the measured and a the field's amplitude over
/// a detector pixel (the root of its mean intensity, of several samples where the grid is finer
/// than the pixels), the field there is scaled by (A + beta (A - a)) / a; a dark field stays dark.
/// Where a pixel's intensity is NaN it was not measured, and the field there is left as it is.
template <class Real>
class GerchbergSaxton {
 public:
  /// Plans the transforms and lays out the factors of a valid design.
  /// @param axes  where the optical axis meets each detector: x, y from the middle of its window in
  ///              detector pixels; empty = all in the middle
  GerchbergSaxton(const Telescope& telescope, const SensorDesign& design,
                  std::vector<Eigen::Array2d> axes = {});

  /// May be called from many threads.
  /// @param images  one per plane in visiting order, detector width x width, mean intensity per
  ///                pixel in units of the unaberrated pupil's; below 0 counts as 0, NaN = not
  ///                measured
  /// @param observer  called with the pupil field after each loop; may be empty
  Reconstruction reconstruct(
      std::span<const Image<double>> images,
      const std::function<void(const Field<double>& pupil)>& observer = {}) const;

  /// What the detectors would see of a pupil field, as the loop models it: one image per plane in
  /// visiting order, mean intensity per pixel. May be called from many threads.
  /// @param pupil  as Reconstruction::pupil_field
  std::vector<Image<double>> predict(const Field<double>& pupil) const;

  /// The light of a unit-amplitude pupil, in units of intensity times detector pixels.
  double pupil_energy() const;

  /// The pupil as sampled by the reconstruction, pupil_pixels x oversampling samples across.
  const PupilMask& mask() const { return mask_; }
  /// The design's, for that pupil.
  const PhaseUnwrapper& unwrapper() const { return unwrapper_; }

 private:
  Field<double> first_estimate(std::span<const Image<double>> images) const;
  /// The pupil from the transforms of its rows, 0 outside the aperture.
  Field<double> get_pupil(const Field<Real>& field) const;
  /// The amplitude step at one plane, on a field whose rows are Fourier transforms.
  /// @param gaps  the image's pixels without a value, row by row
  void measure(Field<Real>& field, const Image<Real>& image, std::span<const Gap> gaps,
               Real relaxation) const;

  /// The way to a plane.
  struct Hop {
    LineFactors<Real> along_x;
    LineFactors<Real> along_y;
  };

  SensorDesign design_;
  std::vector<Eigen::Array2d> axes_;  ///< of every plane
  double wavelength_;
  double pitch_;
  PupilMask mask_;
  FresnelPropagator<Real> propagator_;
  PhaseUnwrapper unwrapper_;
  std::vector<std::optional<Hop>> hops_;  ///< to each plane and back to the pupil; none where the
                                          ///< planes coincide
  /// What each thread works on. Made once: fresh memory for each reconstruction would cost a tenth
  /// of its time. A reconstruction must not start parallel work: while a thread waited for that, it
  /// might begin another reconstruction here.
  struct Workspace {
    Field<Real> field;                   ///< between the planes
    std::vector<Image<Real>> converted;  ///< the images, where Real is not their own precision
  };
  mutable tbb::enumerable_thread_specific<Workspace> workspaces_;
};

}  // namespace nlcwfs
