// How a design did on its wavefronts, and which figures of that are reported.
#include "model/performance.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace nlcwfs {

double Performance::converged_fraction() const {
  return mean_of([](const ScreenPerformance& screen) { return screen.converged ? 1.0 : 0.0; }).mean;
}

std::vector<double> Performance::captured_energy() const {
  std::vector<double> energy;
  for (std::size_t plane = 0; plane < screens.front().captured_energy.size(); ++plane) {
    energy.push_back(mean_of([&](const ScreenPerformance& screen) {
                       return screen.captured_energy[plane];
                     }).mean);
  }
  return energy;
}

Performance pooled(std::span<const Performance> performances) {
  Performance all{{}, performances.size()};
  for (const Performance& performance : performances) {
    assert(performance.screens.size() == performances.front().screens.size());
    assert(performance.conditions == 1);
    all.screens.insert(all.screens.end(), performance.screens.begin(), performance.screens.end());
  }
  return all;
}

std::span<const PerformanceMetric> performance_metrics() {
  using Screen = const ScreenPerformance&;
  static constexpr double nm = 1e-9;
  static constexpr std::array<PerformanceMetric, 8> metrics{{
      {"residual_wfe_nm", "nm", [](Screen screen) { return screen.wavefront.residual_wfe / nm; }},
      {"wrapped_wfe_nm", "nm", [](Screen screen) { return screen.wavefront.wrapped_wfe / nm; }},
      {"total_wfe_nm", "nm", [](Screen screen) { return screen.wavefront.total_wfe / nm; }},
      {"field_strehl", "", [](Screen screen) { return screen.wavefront.field_strehl; }},
      {"loops", "", [](Screen screen) { return double(screen.loops); }},
      {"fractional_loops", "", [](Screen screen) { return screen.fractional_loops; }},
      {"seconds", "s", [](Screen screen) { return screen.seconds; }},
      {"fft_count", "", [](Screen screen) { return double(screen.fft_count); }},
  }};
  return metrics;
}

PerformanceMetric performance_metric(std::string_view name) {
  const auto metrics = performance_metrics();
  const auto found = std::ranges::find(metrics, name, &PerformanceMetric::name);
  assert(found != metrics.end());
  return *found;
}

}  // namespace nlcwfs
