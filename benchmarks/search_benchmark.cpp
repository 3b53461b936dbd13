// The search that the program makes unless told otherwise, all threads, without its verification.

#include "benchmarks/default_problem.hpp"
#include "objectives/design_problem.hpp"
#include "optimizer/chained_search.hpp"

#include <memory>

#include <benchmark/benchmark.h>

namespace nlcwfs {
namespace {

void search_default(benchmark::State& state) {
  const Telescope telescope;
  const DesignSpace space(telescope, {});
  SensorDesign papers;
  papers.planes = {-47e3, 47e3, -180e3, 180e3};
  SearchOptions options;
  options.starts = {*space.point_of(SensorDesign()), *space.point_of(papers)};
  int evaluations = 0;
  while (state.KeepRunning()) {
    const DesignTrial trial(
        {{.name = "default",
          .simulation = std::make_shared<const Simulation>(
              telescope, default_screens(default_truth_samples(TruthModel::extended)),
              SimulationOptions{.precision = Precision::single_precision})}},
        DesignCost());
    DesignProblem problem(space, trial);
    evaluations += search(problem, options).evaluations;
  }
  state.counters["evaluations"] =
      benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
}

BENCHMARK(search_default)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace nlcwfs

BENCHMARK_MAIN();
