#pragma once

#include "model/array.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <memory>
#include <vector>

namespace nlcwfs {

/// Where the sensor's data come from.
enum class TruthModel {
  extended,  ///< light on an infinite plane, sampled finer than the detector: wrap-free
  matched    ///< the reconstructor's own periodic grid, all of it measured (the paper's way)
};

/// The light that a sensor's detectors see, before they integrate it over their pixels.
class TrueLight {
 public:
  virtual ~TrueLight() = default;

  /// The fields of a beam in the detector's window of each plane, in visiting order.
  /// @param pupil  the field in the pupil, m x m samples across the diameter
  /// @return fields of window * m samples a side, of the pupil's pitch
  virtual std::vector<Field<double>> at_planes(const Field<double>& pupil) const = 0;
};

/// @param pupil_samples  m; for a matched truth the design's own
std::unique_ptr<const TrueLight> make_true_light(TruthModel model, const Telescope& telescope,
                                                 const SensorDesign& design, int pupil_samples);

}  // namespace nlcwfs
