#include "objectives/design_cost.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

double wavefront_error(const WavefrontMetrics& wavefront, WavefrontErrorKind kind) {
  switch (kind) {
    case WavefrontErrorKind::residual:
      return wavefront.residual_wfe;
    case WavefrontErrorKind::wrapped:
      return wavefront.wrapped_wfe;
    case WavefrontErrorKind::total:
      break;
  }
  return wavefront.total_wfe;
}

}  // namespace

std::vector<double> DesignCost::per_screen(const Performance& performance,
                                           const SensorDesign& design) const {
  const double transform_cost = time_weight * transform_seconds(design);
  return performance.samples_of([&](const ScreenPerformance& screen) {
    return wavefront_error(screen.wavefront, wfe) / wfe_scale +
           loop_weight * screen.fractional_loops + transform_cost * screen.fft_count;
  });
}

double DesignCost::transform_seconds(const SensorDesign& design) const {
  const double samples = double(design.grid_width()) * design.grid_width();
  return 5.0 * samples * std::log2(samples) / fft_rate;
}

}  // namespace nlcwfs
