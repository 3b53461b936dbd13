#include "model/input_error.hpp"
#include "objectives/design_comparison.hpp"
#include "objectives/design_problem.hpp"
#include "optimizer/chained_search.hpp"
#include "results/csv_table.hpp"
#include "results/design_summary.hpp"
#include "studies/design_text.hpp"
#include "studies/interrupt.hpp"
#include "studies/progress_line.hpp"
#include "studies/run_record.hpp"
#include "studies/settings.hpp"
#include "studies/studies.hpp"
#include "studies/trial_summary.hpp"
#include "studies/units.hpp"

#include <algorithm>
#include <any>
#include <chrono>
#include <stdexcept>
#include <stop_token>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The method, limits and seed of the section search.
SearchOptions search_options_of(const Configuration& configuration,
                                const std::vector<SubSpace>& sub_spaces) {
  SearchOptions options;
  options.optimizer = configuration.text("search.optimizer");
  options.seed = configuration.seed("search.seed");
  options.evaluation.budget = configuration.integer("search.budget");
  options.evaluation.time_limit = configuration.optional_time("search.time_limit");
  try {
    search_method(options.optimizer, sub_spaces);
  } catch (const std::invalid_argument& error) {
    throw InputError("search.optimizer", options.optimizer, error.what());
  }
  return options;
}

/// What the configuration asks for, checked as a whole before anything is written.
struct Task {
  explicit Task(const Configuration& configuration);

  Telescope telescope;
  Seeing seeing;
  std::vector<std::string> notes;
  DesignTrial trial;
  DesignTrial verification;
  SensorDesign design;  ///< gives what the search does not vary
  SensorDesign baseline;
  DesignSpace space;
  SearchOptions search;
};

Task::Task(const Configuration& configuration)
    : telescope(telescope_of(configuration)),
      seeing(seeing_of(configuration, telescope)),
      trial(trial_of(configuration, "search.precision", notes)),
      verification(verification_trial_of(configuration)),
      design(trial.checked(design_of(configuration))),
      baseline(trial.checked(baseline_of(configuration))),
      space(search_space_of(configuration, telescope, design)),
      search(search_options_of(configuration, space.sub_spaces())) {
  try {
    verification.checked(design);
    verification.checked(baseline);
  } catch (const InputError& error) {
    throw InputError("verify.truth_factor", configuration.integer("verify.truth_factor"),
                     fmt::format("the finer truth does not suit the design: {}", error.what()));
  }
  if (!configuration.text("screens.file").empty()) {
    notes.emplace_back("the verification is on simulated screens of the configured seeing");
  }
  // The user's own designs are tried first.
  for (const SensorDesign* known : {&design, &baseline}) {
    if (const auto point = space.point_of(*known)) search.starts.push_back(*point);
  }
}

/// Watches a search: archive, table and progress line.
class SearchLog {
 public:
  SearchLog(const Task& task, RunRecord& record, bool quiet)
      : task_(task), record_(record), progress_(quiet) {}

  void add(const EvaluationRecord& evaluation) {
    const SensorDesign design = task_.space.design(evaluation.point);
    const bool failed = !evaluation.failure.empty();
    const auto* tried = std::any_cast<TriedDesign>(&evaluation.detail);
    record_.archive().add(
        {.stage = "search",
         .design = to_json(design, task_.telescope, task_.seeing.fried_parameter).dump(),
         .cost = evaluation.cost,
         .failure = evaluation.failure,
         .seconds = evaluation.seconds,
         .performance = failed ? "" : to_json(pooled(tried->performances)).dump()});

    table_.row()
        .add(evaluation.index)
        .add(fmt::format("{:.7g}", fmt::join(design.planes, ",")))
        .add(evaluation.cost);
    for (const char* metric : {"residual_wfe_nm", "fractional_loops"}) {
      if (failed) {
        table_.add("");
      } else {
        table_.add(pooled(tried->performances).mean_of(performance_metric(metric)).mean);
      }
    }
    table_.add(evaluation.failure);
    show_progress(evaluation);
  }

  std::string table() const { return table_.text(); }

 private:
  void show_progress(const EvaluationRecord& evaluation) {
    const EvaluatorOptions& limits = task_.search.evaluation;
    const double elapsed = seconds_since(start_);
    double left = elapsed / evaluation.index * (limits.budget - evaluation.index);
    if (limits.time_limit) left = std::min(left, std::max(0.0, *limits.time_limit - elapsed));
    progress_.show(
        fmt::format("search: design {} of {}, lowest cost {:.4g}, {} left, then the "
                    "verification",
                    evaluation.index, limits.budget, evaluation.best_cost, duration_text(left)));
  }

  const Task& task_;
  RunRecord& record_;
  ProgressLine progress_;
  Clock::time_point start_ = Clock::now();
  CsvTable table_{
      {"evaluation", "planes_m", "cost", "residual_wfe_nm", "fractional_loops", "failure"}};
};

/// The search; Ctrl-C ends it with the best design so far.
SearchResult search_until_interrupted(DesignProblem& problem, SearchOptions options,
                                      SearchLog& log) {
  const InterruptWatch watch;
  std::stop_source stop;
  options.evaluation.stop = stop.get_token();
  options.evaluation.observer = [&](const EvaluationRecord& evaluation) {
    log.add(evaluation);
    if (InterruptWatch::interrupted()) stop.request_stop();
  };
  return search(problem, options);
}

TriedDesign verify_and_archive(const SensorDesign& design, std::string_view name, const Task& task,
                               RunRecord& record, bool quiet) {
  ProgressLine progress(quiet);
  progress.show(
      fmt::format("verification: {} on {} fresh screens", name, task.verification.screen_count()));
  const auto start = Clock::now();
  TriedDesign verified = task.verification.run(design);
  record.archive().add(
      {.stage = "verify",
       .design = to_json(design, task.telescope, task.seeing.fried_parameter).dump(),
       .cost = mean_and_standard_error(verified.costs).mean,
       .failure = "",
       .seconds = seconds_since(start),
       .performance = to_json(pooled(verified.performances)).dump()});
  return verified;
}

/// The best designs that differ, with what they cost on the screens of the search.
Json leaders_array(const SearchResult& result, const Task& task) {
  Json leaders = Json::array();
  for (const EvaluatedDesign& leader : result.best_designs) {
    leaders.push_back(
        {{"planes_m", task.space.design(leader.point).planes}, {"cost", leader.cost}});
  }
  return leaders;
}

Json stages_array(const SearchResult& result) {
  Json stages = Json::array();
  for (const SearchStage& stage : result.stages) {
    stages.push_back({{"name", stage.name}, {"evaluations", stage.evaluations}});
  }
  return stages;
}

/// How the search ended, for people.
std::string_view ending_text(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "until nothing got better";
    case Termination::target_reached:
      return "until search.target was reached";
    case Termination::stagnated:
      return "until search.stagnation designs in a row were no better";
    case Termination::budget_exhausted:
      return "all that search.budget allows";
    case Termination::time_limit:
      return "until search.time_limit";
    case Termination::stop_requested:
      break;
  }
  return "until it was interrupted";
}

std::string verdict_text(const Improvement& improvement, const TriedDesign& baseline) {
  switch (improvement.verdict) {
    case Verdict::better:
      return fmt::format(
          "The best design beats the baseline: it costs {} less ({:.0f} %), screen by screen.",
          with_error(improvement.cost),
          100.0 * improvement.cost.mean / mean_and_standard_error(baseline.costs).mean);
    case Verdict::indistinguishable:
      return fmt::format(
          "The baseline is NOT beaten: on fresh screens its cost minus the best design's is {}, "
          "which may well be chance.",
          with_error(improvement.cost));
    case Verdict::worse:
      break;
  }
  return fmt::format(
      "The baseline is NOT beaten: on fresh screens the best design that was found costs {} more. "
      "Search longer (search.budget) or on more screens (screens.count).",
      with_error({-improvement.cost.mean, improvement.cost.standard_error}));
}

void print_result(const Task& task, const SearchResult& result, std::string_view precision,
                  double search_seconds, const TriedDesign& best, const TriedDesign& baseline,
                  const Improvement& gain) {
  const Performance best_performance = pooled(best.performances);
  const Performance baseline_performance = pooled(baseline.performances);
  const std::size_t condition_count = task.trial.conditions().size();
  const std::string conditions =
      condition_count > 1 ? fmt::format(" under each of {} conditions", condition_count) : "";
  for (const std::string& note : task.notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n", telescope_line(task.telescope, task.seeing));
  fmt::print("Tried {} designs on {} screens{} in {} precision in {}, {}{}.\n\n",
             result.evaluations, task.trial.screen_count(), conditions, precision,
             duration_text(search_seconds), ending_text(result.termination),
             result.failures > 0
                 ? fmt::format("; {} of them failed, see search.csv", result.failures)
                 : "");
  fmt::print("Best design, planes in visiting order:\n{}\n",
             planes_table(best.design, task.telescope, task.seeing, &best_performance));
  fmt::print("Baseline:\n{}\n",
             planes_table(baseline.design, task.telescope, task.seeing, &baseline_performance));
  fmt::print("Both on the same {} fresh screens, true field {} samples across the pupil:\n{}",
             task.verification.screen_count(),
             task.verification.conditions().front().simulation->truth_samples(),
             performance_table({{"best design", &best_performance, best.costs},
                                {"baseline", &baseline_performance, baseline.costs}}));
  fmt::print("{}", conditions_table(best, task.verification));
  fmt::print("\n{}\n{}", verdict_text(gain, baseline),
             captured_energy_warnings(best.design, best_performance));
}

}  // namespace

void run_optimize(const CommandLine& command_line) {
  const Configuration& configuration = command_line.configuration;
  const auto start = Clock::now();
  const Task task(configuration);
  RunRecord record(command_line);

  DesignProblem problem(task.space, task.trial);
  SearchLog log(task, record, command_line.quiet);
  const auto search_start = Clock::now();
  const SearchResult result = search_until_interrupted(problem, task.search, log);
  const double search_seconds = seconds_since(search_start);

  const TriedDesign best = verify_and_archive(task.space.design(result.best->point), "best design",
                                              task, record, command_line.quiet);
  const TriedDesign baseline =
      verify_and_archive(task.baseline, "baseline", task, record, command_line.quiet);
  const Improvement gain = improvement(best, baseline);

  Configuration best_configuration = configuration;
  best_configuration.set("sensor.planes", fmt::format("{}", fmt::join(best.design.planes, ",")),
                         "by the search");
  record.folder().write("best.cfg", best_configuration.dump());
  record.folder().write("search.csv", log.table());
  record.write_summary(
      {{"best", to_json(best, task.verification)},
       {"baseline", to_json(baseline, task.verification)},
       {"improvement", {{"cost", gain.cost.mean}, {"standard_error", gain.cost.standard_error}}},
       {"leaders_of_search", leaders_array(result, task)},
       {"evaluations", result.evaluations},
       {"cache_hits", result.cache_hits},
       {"failures", result.failures},
       {"reconstructions", ((result.evaluations - result.failures) * task.trial.screen_count() +
                            2 * task.verification.screen_count()) *
                               static_cast<int>(task.trial.conditions().size())},
       {"wall_seconds", seconds_since(start)},
       {"search_seconds", search_seconds},
       {"termination", to_string(result.termination)},
       {"stages", stages_array(result)}});
  print_result(task, result, configuration.choice("search.precision"), search_seconds, best,
               baseline, gain);
  fmt::print("{}\n", record.closing_line());
}

}  // namespace nlcwfs
