// One Gerchberg-Saxton loop of four planes beside what it cannot do without: its ten
// two-dimensional transforms, by FFTW's own plans that were chosen by measuring.

#include "model/gerchberg_saxton.hpp"

#include <complex>
#include <vector>

#include <benchmark/benchmark.h>
#include <fftw3.h>

namespace nlcwfs {
namespace {

constexpr int loops = 10;

template <class Real>
void gerchberg_saxton_loop(benchmark::State& state) {
  SensorDesign design;
  design.detector.pupil_pixels =
      static_cast<int>(double(state.range(0)) / design.reconstruction.window);
  design.reconstruction.max_loops = loops;
  design.reconstruction.tolerance = 0.0;
  const GerchbergSaxton<Real> reconstructor(Telescope(), design);
  const int width = design.detector.width();
  const std::vector<Image<double>> images(design.planes.size(), Image<double>::Ones(width, width));
  while (state.KeepRunningBatch(loops)) {
    benchmark::DoNotOptimize(reconstructor.reconstruct(images));
  }
}

template <class Real, class Complex, auto plan_2d, auto execute, auto destroy>
void ten_transforms(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  Field<Real> field(width, width);
  auto* const data = reinterpret_cast<Complex*>(field.data());
  const auto forward = plan_2d(width, width, data, data, FFTW_FORWARD, FFTW_PATIENT);
  const auto backward = plan_2d(width, width, data, data, FFTW_BACKWARD, FFTW_PATIENT);
  field.setZero();  // planning writes into it, and numbers above 0 would grow without bound
  while (state.KeepRunning()) {
    for (int pair = 0; pair < 5; ++pair) {
      execute(forward);
      execute(backward);
    }
  }
  destroy(forward);
  destroy(backward);
}

void grids(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("grid")->Arg(256)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
}

BENCHMARK_TEMPLATE(gerchberg_saxton_loop, double)->Apply(grids);
BENCHMARK_TEMPLATE(ten_transforms, double, fftw_complex, fftw_plan_dft_2d, fftw_execute,
                   fftw_destroy_plan)
    ->Name("ten_transforms<double>")
    ->Apply(grids);
BENCHMARK_TEMPLATE(gerchberg_saxton_loop, float)->Apply(grids);
BENCHMARK_TEMPLATE(ten_transforms, float, fftwf_complex, fftwf_plan_dft_2d, fftwf_execute,
                   fftwf_destroy_plan)
    ->Name("ten_transforms<float>")
    ->Apply(grids);

}  // namespace
}  // namespace nlcwfs

BENCHMARK_MAIN();
