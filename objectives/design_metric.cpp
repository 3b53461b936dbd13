// Figures of a design that costs, limits and fronts may use.
#include "objectives/design_metric.hpp"

#include "model/input_error.hpp"
#include "model/seeing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nlcwfs {
namespace {

constexpr double nm = 1e-9;

double detector_pixels(const SensorDesign& design) {
  return double(design.detector.width()) * design.detector.width() * double(design.planes.size());
}

double model_seconds(const ScreenPerformance& screen, const MetricContext& context) {
  return context.operation.transform_seconds(context.design) * screen.fft_count;
}

double latency(const ScreenPerformance& screen, const MetricContext& context) {
  const Operation& operation = context.operation;
  const double time_per_loop = operation.time_per_loop
                                   ? *operation.time_per_loop
                                   : model_seconds(screen, context) / screen.loops;
  return context.design.detector.exposure +
         operation.readout_time_per_pixel * detector_pixels(context.design) +
         screen.fractional_loops * time_per_loop;
}

double greenwood_frequency_of(const MetricContext& context) {
  const Operation& operation = context.operation;
  if (operation.greenwood_frequency) return *operation.greenwood_frequency;
  if (operation.wind_speed) {
    return greenwood_frequency(*operation.wind_speed, context.fried_parameter);
  }
  throw InputError("objective.greenwood_frequency", "(not set)",
                   "servo_wfe_nm and error_budget_nm need it or objective.wind_speed, such as 30");
}

double servo_wfe(const ScreenPerformance& screen, const MetricContext& context) {
  const double variance =
      servo_lag_variance(latency(screen, context), greenwood_frequency_of(context));
  return std::sqrt(variance) * context.operation.wavelength / (2.0 * std::numbers::pi);
}

std::vector<DesignMetric> make_metrics() {
  using Screen = const ScreenPerformance&;
  using Context = const MetricContext&;
  std::vector<DesignMetric> metrics;
  for (const PerformanceMetric& metric : performance_metrics()) {
    metrics.push_back({metric.name, metric.unit,
                       [metric](Screen screen, Context) { return metric(screen); },
                       metric.name == "field_strehl"});
  }
  const std::vector<DesignMetric> others{
      {"model_seconds", "s", model_seconds},
      {"detector_pixels", "",
       [](Screen, Context context) { return detector_pixels(context.design); }},
      {"plane_count", "",
       [](Screen, Context context) { return double(context.design.planes.size()); }},
      {"captured_energy", "",
       [](Screen screen, Context) { return std::ranges::min(screen.captured_energy); }, true},
      {"latency_seconds", "s", latency},
      {"servo_wfe_nm", "nm",
       [](Screen screen, Context context) { return servo_wfe(screen, context) / nm; }},
      {"error_budget_nm", "nm", [](Screen screen, Context context) {
         return std::hypot(screen.wavefront.total_wfe, servo_wfe(screen, context)) / nm;
       }}};
  metrics.insert(metrics.end(), others.begin(), others.end());
  return metrics;
}

}  // namespace

double Operation::transform_seconds(const SensorDesign& design) const {
  const double samples = double(design.grid_width()) * design.grid_width();
  return 5.0 * samples * std::log2(samples) / fft_rate;
}

ScreenPerformance any_screen() {
  ScreenPerformance screen;
  screen.loops = 1;
  screen.captured_energy = {1.0};
  return screen;
}

void DesignMetric::validate(const Operation& operation) const {
  (void)value(any_screen(), {SensorDesign(), operation, 1.0});
}

const std::vector<DesignMetric>& design_metrics() {
  static const std::vector<DesignMetric> metrics = make_metrics();
  return metrics;
}

const DesignMetric* find_design_metric(std::string_view name) {
  const auto found = std::ranges::find(design_metrics(), name, &DesignMetric::name);
  return found == design_metrics().end() ? nullptr : &*found;
}

}  // namespace nlcwfs
