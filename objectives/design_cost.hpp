#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"

#include <vector>

namespace nlcwfs {

/// Which wavefront error a cost counts; see WavefrontMetrics.
enum class WavefrontErrorKind { residual, wrapped, total };

/// Makes one number of a design's performance:
///   cost = WFE / wfe_scale + loop_weight x fractional loops + time_weight x reconstruction time.
/// Every term is a mean over the screens, so the cost of each screen is defined and designs can be
/// compared screen by screen.
struct DesignCost {
  WavefrontErrorKind wfe = WavefrontErrorKind::residual;
  double wfe_scale = 10e-9;  ///< m
  double loop_weight = 0.1;  ///< per loop
  double time_weight = 0.0;  ///< 1/s
  double fft_rate = 5e9;     ///< floating-point operations per second of one transform, 1/s

  /// The cost of each screen.
  std::vector<double> per_screen(const Performance& performance, const SensorDesign& design) const;

  /// Time of one two-dimensional transform of the design's reconstruction grid of N x N samples, s:
  /// 5 N^2 log2(N^2) operations (the convention of Frigo & Johnson 2005) over fft_rate. A model
  /// rather than a clock, so that searches are repeatable.
  double transform_seconds(const SensorDesign& design) const;
};

}  // namespace nlcwfs
