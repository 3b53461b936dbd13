// How a design did on its wavefronts, and which figures of that are reported.
#pragma once

#include "model/array.hpp"
#include "model/statistics.hpp"
#include "model/wavefront_metrics.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// How a design did on one wavefront.
struct ScreenPerformance {
  WavefrontMetrics wavefront;  ///< errors of the reconstruction
  bool converged = false;  ///< whether the loops ended by their rule, not at their greatest number
  int loops = 0;           ///< that were run
  double fractional_loops = 0.0;  ///< loop at which the change crosses the tolerance, interpolated
  int fft_count = 0;              ///< two-dimensional Fourier transforms of the reconstruction
  double seconds = 0.0;           ///< measured time of the reconstruction
  double data_seconds = 0.0;      ///< measured time to make the images, 0 for kept ones
  std::vector<double> captured_energy;  ///< share of the pupil's light in the window, per plane
  /// Residual WFE after each loop, m; only of Simulation::follow() and record().
  std::vector<double> residual_after_loops = {};
};

/// What a design saw of one wavefront and made of it.
struct ScreenRecord {
  ScreenPerformance performance;      ///< as of an evaluation, with the residual after each loop
  std::vector<Image<double>> images;  ///< what the detectors gave, noise included: one per plane in
                                      ///< visiting order, in units of the unaberrated pupil's
                                      ///< intensity
  // n x n reconstruction samples across the diameter, rad, piston removed, NaN outside the pupil:
  Image<double> true_phase;           ///< averaged onto these samples
  Image<double> reconstructed_phase;  ///< unwrapped
  Image<double> residual_phase;       ///< reconstructed minus true; its RMS is the residual WFE
};

/// How a design did on a set of wavefronts.
struct Performance {
  std::vector<ScreenPerformance> screens;  ///< one for each wavefront
  /// Under how many conditions: all screens under the first, then all under the second, ...
  std::size_t conditions = 1;

  /// `metric(screen)` of every screen, its mean over the conditions.
  template <class Metric>
  std::vector<double> samples_of(const Metric& metric) const {
    std::vector<double> samples(screens.size() / conditions, 0.0);
    for (std::size_t i = 0; i < screens.size(); ++i) {
      samples[i % samples.size()] += metric(screens[i]);
    }
    for (double& sample : samples) sample /= double(conditions);
    return samples;
  }
  /// Mean and standard error over the screens of `metric(screen)`.
  template <class Metric>
  MeanAndError mean_of(const Metric& metric) const {
    return mean_and_standard_error(samples_of(metric));
  }

  /// Share of the reconstructions that ended by their rule, 0 to 1.
  double converged_fraction() const;
  std::vector<double> captured_energy() const;  ///< mean over the screens, per plane
};

/// One design's performances under several conditions as one. Its means are over all screens and
/// conditions, their standard errors over the screens, which the conditions have in common.
/// @pre there is one, and all have as many screens
Performance pooled(std::span<const Performance> performances);

/// A figure of merit as users see it: its name ends with its unit.
struct PerformanceMetric {
  std::string_view name;                      ///< as summaries have it, with its unit
  std::string_view unit;                      ///< "nm", "s"; empty for what has none
  double (*value)(const ScreenPerformance&);  ///< the figure of one wavefront

  /// The figure of one wavefront.
  double operator()(const ScreenPerformance& screen) const { return value(screen); }
};

/// Every metric that has a mean and a standard error over the screens: residual_wfe_nm,
/// wrapped_wfe_nm, total_wfe_nm, field_strehl, loops, fractional_loops, seconds, fft_count.
std::span<const PerformanceMetric> performance_metrics();

/// One of performance_metrics() by its name.
/// @pre there is such a metric
PerformanceMetric performance_metric(std::string_view name);

}  // namespace nlcwfs
