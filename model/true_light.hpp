#pragma once

#include "model/array.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nlcwfs {

/// Where the sensor's data come from.
enum class TruthModel {
  extended,  ///< light on an infinite plane, sampled finer than the detector: wrap-free
  matched    ///< the reconstructor's own periodic grid, all of it measured (the paper's way)
};

/// The light that a sensor's detectors see.
class TrueLight {
 public:
  virtual ~TrueLight() = default;

  /// The image that a beam makes on the detector of each of the wanted planes: the mean intensity
  /// of every pixel, without noise. May be called from many threads.
  /// @param pupil   the field in the pupil, m x m samples across the diameter
  /// @param wanted  indices of planes in visiting order
  virtual std::vector<Image<double>> images(const Field<double>& pupil,
                                            std::span<const std::size_t> wanted) const = 0;
};

/// @param pupil_samples  m; for a matched truth the design's own
std::unique_ptr<const TrueLight> make_true_light(TruthModel model, const Telescope& telescope,
                                                 const SensorDesign& design, int pupil_samples);

}  // namespace nlcwfs
