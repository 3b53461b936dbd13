// Times the loop of a design's reconstruction.
#pragma once

#include "model/gerchberg_saxton.hpp"

#include <vector>

#include <benchmark/benchmark.h>

namespace nlcwfs {

/// Times the loop of a design's reconstruction, ten at a time.
template <class Real>
void time_loops(benchmark::State& state, SensorDesign design) {
  constexpr int loops = 10;
  design.reconstruction.max_loops = loops;
  design.reconstruction.tolerance = 0.0;
  const GerchbergSaxton<Real> reconstructor(Telescope(), design);
  const int width = design.detector.width();
  const std::vector<Image<double>> images(design.planes.size(), Image<double>::Ones(width, width));
  while (state.KeepRunningBatch(loops)) {
    benchmark::DoNotOptimize(reconstructor.reconstruct(images));
  }
}

}  // namespace nlcwfs
