// The light that reaches the detectors: extended, periodic or the reconstruction's own.
#pragma once

#include "model/array.hpp"
#include "model/light_source.hpp"
#include "model/pupil.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace nlcwfs {

/// Where the sensor's data come from.
enum class TruthModel {
  extended,  ///< light on an infinite plane, sampled finer than the detector: wrap-free
  matched,   ///< the reconstructor's own periodic grid, all of it measured (the paper's way)
  periodic   ///< a periodic grid as wide as the reconstructor's, all of it measured, sampled finer
             ///< than the detector (the paper's way to study pixels)
};

/// How light of one wavelength gets from the pupil to the detectors.
class LightPath {
 public:
  virtual ~LightPath() = default;

  /// Gives the images that a beam makes, the mean intensity of every detector pixel, to `take` with
  /// their indices in `wanted`. May be called from many threads.
  /// @param pupil   the field in the pupil, m x m samples across the diameter
  /// @param wanted  indices of the path's distances
  virtual void make_images(
      const Field<double>& pupil, std::span<const std::size_t> wanted,
      const std::function<void(std::size_t, const Image<double>&)>& take) const = 0;
};

/// The light that a sensor's detectors see.
class TrueLight {
 public:
  /// @param pupil_samples  m; for a matched truth the design's own
  /// @pre the source is valid for the design's planes
  TrueLight(TruthModel model, const Telescope& telescope, const SensorDesign& design,
            int pupil_samples, const LightSource& source = {});

  /// The image on the detector of each of the wanted planes: the mean intensity of every pixel,
  /// without noise; of several wavelengths their weighted mean. May be called from many threads.
  /// @param phase   the aberration at the telescope's wavelength, m x m samples, rad
  /// @param wanted  indices of planes in visiting order
  std::vector<Image<double>> images(const PhaseScreen& phase,
                                    std::span<const std::size_t> wanted) const;

 private:
  /// One wavelength of a plane, as light of the telescope's wavelength that makes the same image.
  struct Line {
    std::size_t distance;  ///< its index in the path
    double phase_factor;   ///< of the aberration
    double weight;
  };

  PupilMask mask_;
  std::vector<std::vector<Line>> planes_;
  std::unique_ptr<const LightPath> path_;
};

}  // namespace nlcwfs
