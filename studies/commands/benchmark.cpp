// benchmark: How fast this machine is at the configuration.
#include "studies/commands/commands.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/trials.hpp"

#include <cmath>
#include <sys/resource.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace nlcwfs {
namespace {

/// What one evaluation of the design took.
struct EvaluationTime {
  double seconds;                 ///< all of it, all its screens
  double data_seconds;            ///< to make the data, mean over the screens
  double reconstruction_seconds;  ///< mean over the screens
  double loops;                   ///< mean over the screens
  double transforms;              ///< mean over the screens

  double loop_seconds() const { return reconstruction_seconds / loops; }
};

/// @throws RunInterrupted
EvaluationTime timed_evaluation(const Simulation& simulation, const SensorDesign& design) {
  const Stopwatch stopwatch;
  const Performance performance =
      simulation.evaluate(design, [] { return !InterruptWatch::interrupted(); });
  const double seconds = stopwatch.seconds();
  if (InterruptWatch::interrupted()) throw RunInterrupted("before anything was timed");
  using Screen = const ScreenPerformance&;
  const auto mean = [&](const auto& metric) { return performance.mean_of(metric).mean; };
  return {.seconds = seconds,
          .data_seconds = mean([](Screen screen) { return screen.data_seconds; }),
          .reconstruction_seconds = mean([](Screen screen) { return screen.seconds; }),
          .loops = mean([](Screen screen) { return double(screen.loops); }),
          .transforms = mean([](Screen screen) { return double(screen.fft_count); })};
}

/// The same on one thread, whatever the number of threads around.
EvaluationTime evaluation_on_one_thread(const Simulation& simulation, const SensorDesign& design) {
  tbb::task_arena one_thread(1);
  return one_thread.execute([&] { return timed_evaluation(simulation, design); });
}

/// The threads that an evaluation may use.
int thread_count() {
  const auto allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(static_cast<int>(allowed), tbb::this_task_arena::max_concurrency());
}

/// The higher of the two in the middle where the number of times is even.
template <class Figure>
double median_of(const std::vector<EvaluationTime>& times, const Figure& figure) {
  std::vector<double> values(times.size());
  std::ranges::transform(times, values.begin(), figure);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// How long one precision of the reconstruction took each time.
struct Timings {
  std::vector<EvaluationTime> alone;     ///< one screen on one thread
  std::vector<EvaluationTime> together;  ///< all screens on all threads
};

/// How fast one precision of the reconstruction is; medians over the repetitions.
struct Speed {
  double one_thread_loop_seconds;  ///< with a thread that works alone
  double loop_seconds;             ///< of each thread while all work
  double loops_per_second;         ///< of all threads together
  double data_seconds;
  double reconstruction_seconds;
  double loops;
  double design_seconds;  ///< on all screens of the configuration
  /// That the cost's model of time would need to predict the reconstruction on one thread alone.
  double fft_rate;  // 1/s
};

/// What is timed, and how thoroughly.
struct Benchmark : Setup {
  explicit Benchmark(const Configuration& configuration)
      : Setup(configuration),
        source(configuration),
        // Before the screens, which may take long.
        design(simulated()),
        screens(screens_of(source, telescope, seeing(), samples, notes, most_screens())),
        configured_screens(source.file.empty() ? source.count : static_cast<int>(screens.size())) {}

  /// Decides how many screens and repetitions there is time for: a few seconds for everything, or
  /// as long as three wavefronts on one thread and two on all threads take.
  void prepare() {
    constexpr double evaluation_limit = 1.0;  // s
    const double seconds =
        evaluation_on_one_thread(simulation(Precision::double_precision, 1), design).seconds;
    const double affordable = threads * std::max(1.0, std::floor(evaluation_limit / seconds));
    used_screens = static_cast<int>(std::min(affordable, double(screens.size())));
    repetitions = seconds < evaluation_limit ? 3 : 1;
  }

  /// In double and in single precision. An interrupt ends it with the repetitions that are done.
  /// @throws RunInterrupted before there is one
  std::pair<Speed, Speed> speeds() {
    Progress progress("benchmark", 4.0 * repetitions, "evaluations");
    Timings in_double;
    Timings in_single;
    // In turns, so that what else the machine does meets both.
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      try {
        repeat(Precision::double_precision, in_double, progress);
        repeat(Precision::single_precision, in_single, progress);
      } catch (const RunInterrupted&) {
        if (repetition == 0) throw;
        repetitions = repetition;
        is_interrupted = true;
      }
    }
    return {speed_of(in_double), speed_of(in_single)};
  }

  /// Of the wavefronts along each side.
  int width() const { return static_cast<int>(screens.front().rows()); }
  /// Fewer than the threads where there are fewer screens.
  int threads_at_work() const { return std::min(threads, used_screens); }

  int threads = thread_count();
  ScreenSource source;
  SensorDesign design;  ///< as it is simulated
  std::vector<PhaseScreen> screens;
  int configured_screens;
  int used_screens = 1;
  int repetitions = 1;
  bool is_interrupted = false;

 private:
  /// More would hardly change the mean number of loops; as many for each thread.
  int most_screens() const {
    constexpr int enough = 16;
    return (enough + threads - 1) / threads * threads;
  }

  Simulation simulation(Precision precision, int count) const {
    SimulationOptions of_this = options;
    of_this.precision = precision;
    return {telescope, {screens.begin(), screens.begin() + count}, of_this};
  }

  /// In new simulations, which have no images yet.
  void repeat(Precision precision, Timings& timings, Progress& progress) const {
    timings.alone.push_back(evaluation_on_one_thread(simulation(precision, 1), design));
    progress.advance();
    timings.together.push_back(timed_evaluation(simulation(precision, used_screens), design));
    progress.advance();
  }

  Speed speed_of(const Timings& timings) const {
    const std::vector<EvaluationTime>& together = timings.together;
    const double loop_seconds = median_of(together, &EvaluationTime::loop_seconds);
    return {.one_thread_loop_seconds = median_of(timings.alone, &EvaluationTime::loop_seconds),
            .loop_seconds = loop_seconds,
            .loops_per_second = threads_at_work() / loop_seconds,
            .data_seconds = median_of(together, &EvaluationTime::data_seconds),
            .reconstruction_seconds = median_of(together, &EvaluationTime::reconstruction_seconds),
            .loops = together.front().loops,
            .design_seconds =
                median_of(together, &EvaluationTime::seconds) * configured_screens / used_screens,
            .fft_rate = median_of(timings.alone, [this](const EvaluationTime& time) {
              return Operation{.fft_rate = 1.0}.transform_seconds(design) * time.transforms /
                     time.reconstruction_seconds;
            })};
  }
};

/// The most memory that this process has had, MiB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;  // from KiB
}

/// To two significant digits: timings on a machine at work hold no more.
double rounded(double value) {
  if (!(value > 0.0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

std::string rounded_text(double value) {
  const double shown = rounded(value);
  const int decimals =
      shown > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(shown))), 0, 9) : 0;
  return fmt::format("{:.{}f}", shown, decimals);
}

/// A duration that is an estimate.
std::string estimate_text(double seconds) {
  if (seconds < 1.0) return "below 1 s";
  if (seconds < 100.0) return fmt::format("about {} s", rounded_text(seconds));
  if (seconds < 6000.0) return fmt::format("about {} min", rounded_text(seconds / 60.0));
  return fmt::format("about {} h", rounded_text(seconds / 3600.0));
}

std::string counted(int count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Json to_json(const Speed& speed, double search_seconds) {
  return {{"loops_per_second_one_thread", 1.0 / speed.one_thread_loop_seconds},
          {"loops_per_second", speed.loops_per_second},
          {"loop_seconds_one_thread", speed.one_thread_loop_seconds},
          {"loop_seconds", speed.loop_seconds},
          {"data_seconds", speed.data_seconds},
          {"reconstruction_seconds", speed.reconstruction_seconds},
          {"loops", speed.loops},
          {"design_seconds", speed.design_seconds},
          {"designs_per_minute", 60.0 / speed.design_seconds},
          {"search_seconds", search_seconds},
          {"fft_rate", speed.fft_rate}};
}

/// How long the configured search takes if all its designs are like this one, s.
double search_seconds(const Speed& speed, const Configuration& configuration) {
  const double seconds = configuration.integer("search.budget") * speed.design_seconds;
  return std::min(seconds, configuration.optional_time("search.time_limit").value_or(seconds));
}

void print_task(const Benchmark& benchmark, const Configuration& configuration) {
  for (const std::string& note : benchmark.notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n", telescope_line(benchmark.telescope, benchmark.seeing()));
  const auto square = [](int samples) { return fmt::format("{0} x {0}", samples); };
  const SensorDesign& design = benchmark.design;
  fmt::print("{} planes of {} pixels, reconstruction grid {}\n", design.planes.size(),
             square(design.detector.width()), square(design.grid_width()));
  fmt::print("{} of {} samples, {} truth, {}\n\n", counted(benchmark.configured_screens, "screen"),
             square(benchmark.width()), configuration.choice("simulation.truth"),
             counted(benchmark.threads, "thread"));
}

void print_speeds(const Speed& in_double, const Speed& in_single, const Benchmark& benchmark,
                  const Configuration& configuration) {
  const auto row = [&](std::string_view heading, const auto& text) {
    fmt::print("  {:<48} {:>14} {:>14}\n", heading, text(in_double), text(in_single));
  };
  const auto figure = [&](std::string_view heading, const auto& value) {
    row(heading, [&](const Speed& speed) { return rounded_text(std::invoke(value, speed)); });
  };
  const auto milliseconds = [&](std::string_view heading, double Speed::*seconds) {
    figure(heading, [=](const Speed& speed) { return 1e3 * speed.*seconds; });
  };
  fmt::print("  {:<48} {:>14} {:>14}\n", "precision of the reconstruction", "double", "single");
  figure("loops per second, 1 thread alone",
         [](const Speed& speed) { return 1.0 / speed.one_thread_loop_seconds; });
  milliseconds("  ms per loop", &Speed::one_thread_loop_seconds);
  if (const int at_work = benchmark.threads_at_work(); at_work > 1) {
    figure(fmt::format("loops per second, {} threads together", at_work), &Speed::loops_per_second);
    milliseconds("  ms per loop on each", &Speed::loop_seconds);
  }
  fmt::print("\n");
  milliseconds("ms to make one screen's images, always in double", &Speed::data_seconds);
  milliseconds("ms to reconstruct from them", &Speed::reconstruction_seconds);
  figure("  in loops", &Speed::loops);
  fmt::print("\n");
  figure(fmt::format("seconds per design on {}", counted(benchmark.configured_screens, "screen")),
         &Speed::design_seconds);
  figure("  designs per minute", [](const Speed& speed) { return 60.0 / speed.design_seconds; });
  row(fmt::format("  search of {}{}", configuration.is_set("search.time_limit") ? "at most " : "",
                  counted(configuration.integer("search.budget"), "design")),
      [&](const Speed& speed) { return estimate_text(search_seconds(speed, configuration)); });
  fmt::print("\n");
  row("objective.fft_rate of one thread alone, 1/s",
      [](const Speed& speed) { return fmt::format("{:.2g}", speed.fft_rate); });
}

void print_reading(const Benchmark& benchmark, double memory) {
  const int repetitions = benchmark.repetitions;
  fmt::print("\n{} of this design; peak memory of this run {:.0f} MiB.\n",
             repetitions == 1 ? "From one evaluation"
                              : fmt::format("Medians of {} evaluations", repetitions),
             memory);
  if (benchmark.used_screens < benchmark.configured_screens) {
    fmt::print("Timed on {} of the screens and scaled to all of them.\n", benchmark.used_screens);
  }
  fmt::print(
      "A search takes that long if its designs need as many loops as this one and share no "
      "planes,\n"
      "then verifies its best one. More threads pay as long as loops per second grow with them "
      "(--threads).\n"
      "objective.fft_rate is what the time in a cost should be predicted with on this machine.\n");
}

void run_benchmark(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  Benchmark benchmark(configuration);
  std::optional<RunRecord> record;
  if (request.output) {
    record.emplace(request);
  } else {
    print_notes_on_keys(request);
  }
  const InterruptWatch watch;

  benchmark.prepare();
  const auto [in_double, in_single] = benchmark.speeds();
  const double memory = peak_memory();

  print_task(benchmark, configuration);
  print_speeds(in_double, in_single, benchmark, configuration);
  print_reading(benchmark, memory);
  if (benchmark.is_interrupted) {
    const std::string what =
        fmt::format("{} had been timed", counted(benchmark.repetitions, "repetition"));
    if (!record) throw RunInterrupted(fmt::format("when {}", what));
    record->note_interrupted(what);
  }
  if (!record) return;
  const SensorDesign& design = benchmark.design;
  record->write_summary({{"grid_samples", design.grid_width()},
                         {"detector_pixels", design.detector.width()},
                         {"truth_samples", benchmark.width()},
                         {"plane_count", design.planes.size()},
                         {"screens", benchmark.configured_screens},
                         {"timing",
                          {{"threads", benchmark.threads},
                           {"repetitions", benchmark.repetitions},
                           {"timed_screens", benchmark.used_screens},
                           {"double", to_json(in_double, search_seconds(in_double, configuration))},
                           {"single", to_json(in_single, search_seconds(in_single, configuration))},
                           {"peak_memory_mib", memory}}}});
  fmt::print("\n");
  record->close();
}

/// A number without more digits than timings hold, and without an exponent.
std::string two_digits(double value) {
  const double unit = value < 100.0 ? 1.0 : std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return value < 100.0 ? fmt::format("{:.2g}", value)
                       : fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string of_benchmark(const Json& summary) {
  const Json& timing = summary.at("timing");
  const int threads = integer_from_json(timing.at("threads"));
  return fmt::format("{} loops per second in double precision, {} in single, on {}.",
                     two_digits(number_from_json(timing.at("double").at("loops_per_second"))),
                     two_digits(number_from_json(timing.at("single").at("loops_per_second"))),
                     counted(threads, "thread"));
}

}  // namespace

Command benchmark_command() {
  return {
      .name = "benchmark",
      .group = "The paper and this machine",
      .description = "time a configuration on this machine; writes files only with --output",
      .about =
          "Takes about five seconds and says what loops, designs and a whole search of the "
          "configuration cost on this machine.",
      .keys = keys::joined({keys::site, keys::simulation, {"search.budget", "search.time_limit"}}),
      .examples = {"nlcwfs benchmark --detector.pupil_pixels 128 --threads 8"},
      .run = run_benchmark,
      .verdict = of_benchmark};
}

}  // namespace nlcwfs
