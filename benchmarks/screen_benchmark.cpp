// Sixteen phase screens, as a search draws them once; all threads.

#include "model/turbulence_screen.hpp"

#include <benchmark/benchmark.h>

namespace nlcwfs {
namespace {

void sixteen_screens(benchmark::State& state) {
  const TurbulenceScreenGenerator generator({.fried_parameter = 0.125},
                                            static_cast<int>(state.range(0)), 0.5, 1);
  while (state.KeepRunning()) benchmark::DoNotOptimize(generate_screens(generator, 16));
}

BENCHMARK(sixteen_screens)
    ->ArgName("samples")
    ->Arg(64)
    ->Arg(128)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace nlcwfs

BENCHMARK_MAIN();
