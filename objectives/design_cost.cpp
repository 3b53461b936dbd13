// What a design costs: wavefront error, loops, time, penalties and limits.
#include "objectives/design_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double MetricBound::excess(double value) const {
  return std::max(0.0, side == Side::above ? value - bound : bound - value);
}

std::vector<double> DesignCost::per_screen(const Performance& performance,
                                           const SensorDesign& design,
                                           double fried_parameter) const {
  const MetricContext context{design, operation, fried_parameter};
  const double transform_cost = time_weight * operation.transform_seconds(design);
  const DesignMetric* const error_budget = find_design_metric("error_budget_nm");
  return performance.samples_of([&](const ScreenPerformance& screen) {
    double cost = kind == CostKind::error_budget
                      ? error_budget->value(screen, context)
                      : wavefront_error(screen.wavefront, wfe) / wfe_scale +
                            loop_weight * screen.fractional_loops +
                            transform_cost * screen.fft_count;
    for (const CostTerm& term : terms) cost += term.weight * term.metric.value(screen, context);
    for (const auto& [penalised, weight] : penalties) {
      cost += weight * penalised.excess(penalised.metric.value(screen, context));
    }
    return cost;
  });
}

double DesignCost::violation(const Performance& performance, const SensorDesign& design,
                             double fried_parameter) const {
  const MetricContext context{design, operation, fried_parameter};
  double violation = 0.0;
  for (const MetricBound& limit : limits) {
    const double mean = performance
                            .mean_of([&](const ScreenPerformance& screen) {
                              return limit.metric.value(screen, context);
                            })
                            .mean;
    // Against a bound of 0 every excess is large, and finite.
    violation += limit.excess(mean) /
                 std::max(std::abs(limit.bound), std::numeric_limits<double>::epsilon());
  }
  return violation;
}

void DesignCost::validate() const {
  const Performance any{{any_screen()}};
  (void)per_screen(any, {}, 1.0);
  (void)violation(any, {}, 1.0);
}

}  // namespace nlcwfs
