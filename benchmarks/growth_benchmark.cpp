// How the time of a loop grows with the grid and the planes, and that of a design with the screens
// and the threads.

#include "benchmarks/default_problem.hpp"
#include "benchmarks/loop_timing.hpp"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace nlcwfs {
namespace {

/// Half of the window measured, as by default.
void loop_with_window(benchmark::State& state) {
  SensorDesign design;
  design.reconstruction.window = static_cast<double>(state.range(0)) / design.pupil_samples();
  design.detector.window = design.reconstruction.window / 2.0;
  time_loops<double>(state, design);
}

void loop_with_planes(benchmark::State& state) {
  SensorDesign design;
  design.planes = {-180e3, 180e3, -47e3, 47e3, -100e3, 100e3};
  design.planes.resize(static_cast<std::size_t>(state.range(0)));
  time_loops<double>(state, design);
}

void design_with_screens(benchmark::State& state) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  while (state.KeepRunning()) {
    state.PauseTiming();
    const Simulation simulation = default_simulation({}, static_cast<int>(state.range(0)));
    state.ResumeTiming();
    benchmark::DoNotOptimize(simulation.evaluate(SensorDesign()));
  }
}

BENCHMARK(loop_with_window)
    ->ArgName("grid")
    ->RangeMultiplier(2)
    ->Range(128, 2048)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(loop_with_planes)->ArgName("planes")->DenseRange(2, 6)->Unit(benchmark::kMillisecond);
BENCHMARK(design_with_screens)
    ->ArgNames({"screens", "threads"})
    ->ArgsProduct({{4, 8, 16, 32, 64}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace nlcwfs

BENCHMARK_MAIN();
