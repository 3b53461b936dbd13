// Figures of a design that costs, limits and fronts may use.
#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What a sensor is operated with; the defaults of the optional values are the models.
struct Operation {
  double wavelength = 532e-9;  ///< of the telescope, m
  /// Floating-point operations per second of one Fourier transform, 1/s.
  double fft_rate = 5e9;
  std::optional<double> time_per_loop = {};  ///< s; absent = its transforms, by fft_rate
  double readout_time_per_pixel = 0.0;       ///< of the detector, s
  /// Hz; absent = that of one layer at wind_speed.
  std::optional<double> greenwood_frequency = {};
  std::optional<double> wind_speed = {};  ///< m/s

  /// Time of one two-dimensional transform of the design's reconstruction grid of N x N samples, s:
  /// 5 N^2 log2(N^2) operations (the convention of Frigo & Johnson 2005) over fft_rate. A model
  /// rather than a clock, so that searches are repeatable.
  double transform_seconds(const SensorDesign& design) const;
};

/// All but the screen that a figure of merit depends on.
struct MetricContext {
  const SensorDesign& design;  ///< that was tried
  const Operation& operation;  ///< what metrics of the servo loop and of time assume
  double fried_parameter;      ///< of the seeing at the telescope's wavelength, m
};

/// A figure of merit of a design on one screen.
struct DesignMetric {
  std::string_view name;  ///< ends with the unit, where there is one
  std::string_view unit;  ///< "nm", "s", ...; empty for what has none
  /// @throws InputError naming the key where the metric needs what is not set
  std::function<double(const ScreenPerformance&, const MetricContext&)> value;
  bool higher_is_better = false;  ///< and 1 is the best; of the others 0 is

  /// The metric as a figure to be minimised, or the metric of such a figure: its negative where
  /// higher is better.
  double minimised(double figure) const { return higher_is_better ? -figure : figure; }

  /// @throws InputError naming the key where the metric needs what is not set
  void validate(const Operation& operation) const;
};

/// What a metric can be tried on, of a design that might be.
ScreenPerformance any_screen();

/// Every figure of merit that a cost, a limit or a trade may be made of: performance_metrics(),
/// of which `seconds` is measured, so that costs with it are not repeatable, and
///
/// - model_seconds     fft_count transforms by Operation::transform_seconds
/// - detector_pixels   of all planes together
/// - plane_count
/// - captured_energy   the least of the planes' shares
/// - latency_seconds   exposure + read-out of all pixels + fractional_loops loops
/// - servo_wfe_nm      what the turbulence changes by in that time: servo_lag_variance() at
///                     Operation::wavelength
/// - error_budget_nm   sqrt(total_wfe_nm^2 + servo_wfe_nm^2)
const std::vector<DesignMetric>& design_metrics();

/// One of design_metrics() by its name; null where there is no such metric.
const DesignMetric* find_design_metric(std::string_view name);

}  // namespace nlcwfs
