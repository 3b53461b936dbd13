// One Gerchberg-Saxton loop of four planes, and one propagation, beside what the loop cannot do
// without: its ten two-dimensional transforms, by FFTW's own plans that were chosen by measuring.

#include "benchmarks/loop_timing.hpp"
#include "model/fresnel_propagator.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>

#include <benchmark/benchmark.h>
#include <fftw3.h>

namespace nlcwfs {
namespace {

template <class Real, class Complex, auto plan_2d, auto execute, auto destroy>
void ten_transforms(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  const std::size_t samples = std::size_t(width) * std::size_t(width);
  // FFTW's own allocation, since its alignment is worth 8 % at 256.
  const std::unique_ptr<void, decltype(&fftw_free)> memory(fftw_malloc(samples * sizeof(Complex)),
                                                           fftw_free);
  auto* const data = static_cast<Complex*>(memory.get());
  // Each plan of a kind after the first comes from FFTW's wisdom, at once.
  const auto forward = plan_2d(width, width, data, data, FFTW_FORWARD, FFTW_PATIENT);
  const auto backward = plan_2d(width, width, data, data, FFTW_BACKWARD, FFTW_PATIENT);
  // Planning writes into the data, and numbers above 0 would grow without bound.
  std::fill_n(reinterpret_cast<Real*>(data), 2 * samples, Real(0));
  while (state.KeepRunning()) {
    for (int pair = 0; pair < 5; ++pair) {
      execute(forward);
      execute(backward);
    }
  }
  destroy(forward);
  destroy(backward);
}

template <class Real>
void hop(benchmark::State& state) {
  const SensorDesign design;
  const Telescope telescope;
  const int width = static_cast<int>(state.range(0));
  const double pitch = telescope.diameter * design.reconstruction.window / width;
  const FresnelPropagator<Real> propagator(width, pitch, telescope.wavelength);
  Field<Real> field = Field<Real>::Ones(width, width);
  while (state.KeepRunning()) propagator.propagate(field, design.planes.front());
}

template <class Real>
void loop(benchmark::State& state) {
  SensorDesign design;
  design.detector.pupil_pixels =
      static_cast<int>(double(state.range(0)) / design.reconstruction.window);
  design.detector.window = static_cast<double>(state.range(1));
  time_loops<Real>(state, design);
}

void grids(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("grid")->Arg(256)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
}

/// Half of the grid's eight diameters measured, or all of them, as with a matched truth.
void grids_and_detectors(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"grid", "detector_window"})
      ->ArgsProduct({{256, 512, 1024}, {4, 8}})
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK_TEMPLATE(ten_transforms, double, fftw_complex, fftw_plan_dft_2d, fftw_execute,
                   fftw_destroy_plan)
    ->Name("ten_transforms<double>")
    ->Apply(grids);
BENCHMARK_TEMPLATE(ten_transforms, float, fftwf_complex, fftwf_plan_dft_2d, fftwf_execute,
                   fftwf_destroy_plan)
    ->Name("ten_transforms<float>")
    ->Apply(grids);
BENCHMARK_TEMPLATE(loop, double)->Apply(grids_and_detectors);
BENCHMARK_TEMPLATE(loop, float)->Apply(grids_and_detectors);
BENCHMARK_TEMPLATE(hop, double)->Apply(grids);
BENCHMARK_TEMPLATE(hop, float)->Apply(grids);

}  // namespace
}  // namespace nlcwfs

int main(int argc, char** argv) {
  // What made the numbers, for the reports.
  benchmark::AddCustomContext("compiler", NLCWFS_COMPILER);
  benchmark::AddCustomContext("fftw", fftw_version);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
