// One design's evaluation, as a search makes it over and over, and its parts: screens (drawn once
// per search), the sensor's images, unwrapping.

#include "benchmarks/default_problem.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/true_light.hpp"

#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

/// Sixteen of them, in one thread.
void screens(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(default_screens(static_cast<int>(state.range(0))));
  }
}

/// One wavefront's, at the default planes.
void images(benchmark::State& state, TruthModel truth) {
  const Telescope telescope;
  const int samples = default_truth_samples(truth);
  const SensorDesign design =
      simulated_design(SensorDesign(), telescope, {.truth = truth}, samples);
  const TrueLight light(truth, telescope, design, samples);
  const PhaseScreen screen = default_screens(samples, 1).front();
  const std::vector<std::size_t> all_planes{0, 1, 2, 3};
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(light.images(screen, all_planes));
  }
}

/// One wavefront, as it is.
void unwrapping(benchmark::State& state, UnwrappingMethod method) {
  const int samples = static_cast<int>(state.range(0));
  const PupilMask mask = pupil_mask(samples, Telescope().central_obscuration);
  const PhaseUnwrapper unwrapper(mask, method);
  const Field<double> field = pupil_field(default_screens(samples, 1).front(), mask);
  while (state.KeepRunning()) benchmark::DoNotOptimize(unwrapper.unwrap(field));
}

/// The default design on the default 16 screens, none of whose images were made before.
void design(benchmark::State& state, TruthModel truth, Precision precision) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  double reconstruction_seconds = 0.0;
  while (state.KeepRunning()) {
    state.PauseTiming();
    const Simulation simulation = default_simulation({.truth = truth, .precision = precision});
    state.ResumeTiming();
    const Performance performance = simulation.evaluate(SensorDesign());
    for (const ScreenPerformance& screen : performance.screens) {
      reconstruction_seconds += screen.seconds;
    }
  }
  state.counters["reconstruction_ms"] =
      benchmark::Counter(1e3 * reconstruction_seconds, benchmark::Counter::kAvgIterations);
}

void threads(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void pupil_pixels(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("pupil_pixels")->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);
}

BENCHMARK(screens)->ArgName("samples")->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(images, extended, TruthModel::extended)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(images, matched, TruthModel::matched)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(unwrapping, quality_guided, UnwrappingMethod::quality_guided)
    ->Apply(pupil_pixels);
BENCHMARK_CAPTURE(unwrapping, least_squares, UnwrappingMethod::least_squares)->Apply(pupil_pixels);
BENCHMARK_CAPTURE(design, extended_double, TruthModel::extended, Precision::double_precision)
    ->Apply(threads);
BENCHMARK_CAPTURE(design, extended_single, TruthModel::extended, Precision::single_precision)
    ->Apply(threads);
BENCHMARK_CAPTURE(design, matched_double, TruthModel::matched, Precision::double_precision)
    ->Apply(threads);
BENCHMARK_CAPTURE(design, matched_single, TruthModel::matched, Precision::single_precision)
    ->Apply(threads);

}  // namespace
}  // namespace nlcwfs

BENCHMARK_MAIN();
