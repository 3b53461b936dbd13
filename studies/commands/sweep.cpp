// sweep: Every design of the configured grid, the best of them verified on fresh screens.
#include "model/input_error.hpp"
#include "objectives/design_space.hpp"
#include "optimizer/all_at_once.hpp"
#include "optimizer/failure_count.hpp"
#include "optimizer/problem.hpp"
#include "results/archive/run_files.hpp"
#include "results/pictures/grid_picture.hpp"
#include "results/pictures/picture_set.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/axis_text.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/command.hpp"
#include "studies/run/evaluation_log.hpp"
#include "studies/run/interrupt.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/request.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/stopwatch.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/search/verified_ranking.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/sweep_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Designs that are tried together: enough for many cores, as each is parallel in itself, and few
/// enough that neighbours on the grid, which share planes, find each other's images.
constexpr std::size_t batch_size = 16;
/// The same for each thread of a runner: more, as all wait for the last of them.
constexpr std::size_t batch_size_of_thread = 64;

/// What the configuration asks for, checked as a whole before anything is written.
struct Task {
  explicit Task(const Configuration& configuration);

  Telescope telescope;
  Seeing seeing;
  DesignGrid grid;
  std::vector<std::string> notes;
  DesignTrial trial;
  DesignTrial verification;
  std::vector<DesignMetric> metrics;  ///< every one that the configuration says enough for
  std::size_t candidates;             ///< that are verified
};

std::vector<DesignMetric> metrics_of(const Operation& operation) {
  std::vector<DesignMetric> metrics;
  for (const DesignMetric& metric : design_metrics()) {
    try {
      metric.validate(operation);
      metrics.push_back(metric);
    } catch (const InputError&) {
      // It needs what is not set.
    }
  }
  return metrics;
}

/// Whether the grid's designs differ in their pixels across the pupil.
bool pixels_vary(const Configuration& configuration) {
  const auto pixels = configuration.axis("sweep.pupil_pixels");
  return pixels && pixels->size() > 1;
}

Task::Task(const Configuration& configuration)
    : telescope(telescope_of(configuration)),
      seeing(seeing_of(configuration, telescope)),
      grid(sweep_grid_of(configuration, telescope,
                         simulated_design(design_of(configuration), telescope,
                                          simulation_options_of(configuration, "search.precision"),
                                          truth_samples(configuration)))),
      trial(trial_of(configuration, "search.precision", notes, pixels_vary(configuration))),
      verification(verification_trial_of(configuration, pixels_vary(configuration))),
      metrics(metrics_of(trial.cost().operation)),
      candidates(static_cast<std::size_t>(configuration.integer("verify.candidates"))) {
  try {
    verification.checked(design_of(configuration));
  } catch (const InputError& error) {
    throw InputError("verify.truth_factor", configuration.integer("verify.truth_factor"),
                     fmt::format("the finer truth does not suit the design: {}", error.what()));
  }
  if (!configuration.text("screens.file").empty()) {
    notes.emplace_back("the verification is on simulated screens of the configured seeing");
  }
}

/// How a design of the grid did, as the archive has it too.
struct Outcome {
  MeanAndError cost{};
  double violation = 0.0;
  std::vector<MeanAndError> metrics = {};  ///< in the order of Task::metrics
  std::string failure = {};                ///< why there is none of these
};

/// A design that was tried: how it did, and the archive's row.
struct Tried {
  Outcome outcome;
  ArchivedEvaluation evaluation;
  bool is_refused = false;  ///< it is none that can be simulated
};

/// Tries a design; one that cannot be tried has a failure. Nothing where an interrupt ended it.
std::optional<Tried> tried_design(const GridDesign& design, const Task& task) {
  const Stopwatch stopwatch;
  Tried result;
  ArchivedEvaluation& evaluation = result.evaluation;
  evaluation = {
      .stage = "sweep",
      .design = to_json(design.design, task.telescope, task.seeing.fried_parameter).dump(),
      .cost = std::numeric_limits<double>::quiet_NaN(),
      .failure = {},
      .seconds = 0.0,
      .performance = {},
      .key = design.key};
  try {
    const TriedDesign tried =
        task.trial.run(design.design, {}, [] { return !InterruptWatch::interrupted(); });
    if (static_cast<int>(tried.costs.size()) < task.trial.screen_count()) return std::nullopt;
    result.outcome.cost = mean_and_standard_error(tried.costs);
    if (!std::isfinite(result.outcome.cost.mean)) {
      throw std::runtime_error(fmt::format("the cost is {}", result.outcome.cost.mean));
    }
    result.outcome.violation = tried.violation;
    evaluation.cost = result.outcome.cost.mean;
    Json performance = to_json(pooled(tried.performances));
    performance["cost"] = to_json(result.outcome.cost);
    performance["violation"] = tried.violation;
    for (const DesignMetric& metric : task.metrics) {
      result.outcome.metrics.push_back(task.trial.mean_of(tried, metric));
      performance["metrics"][std::string(metric.name)] = to_json(result.outcome.metrics.back());
    }
    evaluation.performance = performance.dump();
  } catch (const TrialMemoryFailed&) {
    throw;  // no design is to blame
  } catch (const std::exception& error) {
    result.is_refused = dynamic_cast<const InputError*>(&error) != nullptr;
    result.outcome = {.failure = error.what()};
    evaluation.failure = error.what();
  }
  evaluation.seconds = stopwatch.seconds();
  return result;
}

/// A sweep under way: what is known of its designs.
class Sweep {
 public:
  Sweep(const Task& task, RunRecord& record)
      : task_(task),
        record_(record),
        designs_(task.grid.distinct_designs()),
        outcomes_(designs_.size()) {}

  /// Tries every design; an interrupt ends it early.
  /// @throws std::runtime_error where too many in a row fail
  void run(const Request& request);

  const std::vector<GridDesign>& designs() const { return designs_; }
  /// In the order of the designs; nothing where the sweep did not get there.
  const std::vector<std::optional<Outcome>>& outcomes() const { return outcomes_; }
  std::size_t done() const { return done_; }
  /// What the designs took, in earlier runs too, s.
  double seconds() const { return seconds_; }
  bool is_complete() const { return done_ == designs_.size(); }

 private:
  const Task& task_;
  RunRecord& record_;
  std::vector<GridDesign> designs_;
  std::vector<std::optional<Outcome>> outcomes_;
  std::size_t done_ = 0;
  double seconds_ = 0.0;
};

void Sweep::run(const Request& request) {
  Archive& archive = record_.archive();
  Progress progress("sweep", double(designs_.size()), "designs", "then the verification",
                    request.whole);
  const Stopwatch stopwatch;
  FailureCount failures;
  const std::size_t together =
      request.runner ? batch_size_of_thread * static_cast<std::size_t>(request.runner->threads())
                     : batch_size;
  for (std::size_t first = 0; first < designs_.size(); first += together) {
    const std::size_t count = std::min(together, designs_.size() - first);
    std::vector<std::optional<Tried>> batch(count);
    std::size_t next = 0;
    std::mutex lock;
    // In the order of the designs, so that equal sweeps have equal archives.
    const auto take_next = [&] {
      const std::size_t i = next++;
      if (!batch[i]) return;
      archive_and_log(archive, batch[i]->evaluation);
      outcomes_[first + i] = std::move(batch[i]->outcome);
      ++done_;
      if (batch[i]->is_refused) return;
      failures.add(!outcomes_[first + i]->failure.empty());
      if (failures.is_too_high()) {
        throw std::runtime_error(fmt::format(
            "{} of {} designs failed one after the other, the last with: {}; the archive has all "
            "of them: nlcwfs export {}",
            failures.in_a_row(), designs_.size(), outcomes_[first + i]->failure,
            record_.folder().path().string()));
      }
    };
    all_at_once(count, [&](std::size_t i) {
      if (InterruptWatch::interrupted()) return;
      std::optional<Tried> tried = tried_design(designs_[first + i], task_);
      progress.advance();
      const std::scoped_lock guard(lock);
      batch[i] = std::move(tried);
      // Not only after the batch: where all fail, this begins no more of them.
      while (!failures.is_too_high() && next < count && batch[next]) take_next();
    });
    // Those behind one that an interrupt ended.
    while (next < count) take_next();
  }
  seconds_ = archive.seconds_before() + stopwatch.seconds();
}

/// The cheapest designs that keep the limits, or come closest, best first; `most` at most.
/// @throws std::runtime_error where all failed
std::vector<std::size_t> best_of(const Sweep& sweep, std::size_t most) {
  std::vector<std::size_t> designs;
  for (std::size_t i = 0; i < sweep.designs().size(); ++i) {
    if (sweep.outcomes()[i]->failure.empty()) designs.push_back(i);
  }
  if (designs.empty()) {
    throw std::runtime_error(
        fmt::format("every design of the grid failed; the first: {}",
                    sweep.outcomes().empty() ? "" : sweep.outcomes().front()->failure));
  }
  const auto rank = [&](std::size_t design) {
    const Outcome& outcome = *sweep.outcomes()[design];
    return EvaluatedDesign{
        .point = {}, .key = {}, .cost = outcome.cost.mean, .violation = outcome.violation};
  };
  std::ranges::stable_sort(designs, is_better, rank);
  designs.resize(std::min(designs.size(), most));
  return designs;
}

/// A value of an axis as people write it; lengths and times in SI.
Json axis_value(const DesignGrid& grid, const GridAxis& axis, std::size_t place) {
  const double value = axis.values[place];
  if (axis.name == "order") {
    return fmt::format("{}", fmt::join(grid.orders()[static_cast<std::size_t>(value)], ""));
  }
  const auto& keys = configuration_keys();
  const auto key = std::ranges::find(keys, "sweep." + axis.name, &ConfigurationKey::name);
  if (key->element == Kind::choice) return key->choices[static_cast<std::size_t>(value)];
  if (key->element == Kind::integer) return static_cast<int>(value);
  return value;
}

/// The outcome of each point; null where the grid has no design.
std::vector<const Outcome*> outcomes_of_points(const Task& task, const Sweep& sweep) {
  std::vector<const Outcome*> points(task.grid.size(), nullptr);
  for (std::size_t i = 0; i < sweep.designs().size(); ++i) {
    for (const std::size_t point : sweep.designs()[i].points) points[point] = &*sweep.outcomes()[i];
  }
  return points;
}

/// One row per point of the grid.
std::string points_table(const Task& task, const std::vector<const Outcome*>& points) {
  const DesignGrid& grid = task.grid;
  std::vector<std::string> columns;
  for (const GridAxis& axis : grid.axes()) {
    columns.push_back(column_of_variable(axis.name));
  }
  columns.insert(columns.end(), {"cost", "cost_standard_error", "violation"});
  for (const DesignMetric& metric : task.metrics) {
    columns.emplace_back(metric.name);
    columns.push_back(fmt::format("{}_standard_error", metric.name));
  }
  columns.emplace_back("failure");
  CsvTable table(columns);
  for (std::size_t point = 0; point < points.size(); ++point) {
    table.row();
    const std::vector<std::size_t> places = grid.places(point);
    for (std::size_t axis = 0; axis < places.size(); ++axis) {
      const Json value = axis_value(grid, grid.axes()[axis], places[axis]);
      if (value.is_string()) {
        table.add(value.get<std::string>());
      } else {
        table.add(value.get<double>());
      }
    }
    const Outcome* outcome = points[point];
    if (outcome == nullptr || !outcome->failure.empty()) {
      for (std::size_t i = 0; i < 3 + 2 * task.metrics.size(); ++i) table.add("");
      table.add(outcome == nullptr ? "left out, or the order is one of another number of planes"
                                   : outcome->failure);
      continue;
    }
    table.add(outcome->cost.mean).add(outcome->cost.standard_error).add(outcome->violation);
    for (const MeanAndError& metric : outcome->metrics) {
      table.add(metric.mean).add(metric.standard_error);
    }
    table.add("");
  }
  return table.text();
}

/// Nested arrays, the first axis outermost, of a value of each point; null where there is none.
template <class Value>
Json matrix_of(const DesignGrid& grid, const std::vector<const Outcome*>& points,
               const Value& value) {
  std::vector<Json> rows;
  for (const Outcome* point : points) {
    const bool has_value = point != nullptr && point->failure.empty();
    rows.push_back(has_value ? Json(value(*point)) : Json(nullptr));
  }
  // Cut into the innermost arrays, these into the next ones, ...
  for (std::size_t axis = grid.axes().size(); axis-- > 0;) {
    const auto length = static_cast<std::ptrdiff_t>(grid.axes()[axis].values.size());
    std::vector<Json> outer;
    for (auto begin = rows.begin(); begin != rows.end(); begin += length) {
      outer.emplace_back(Json::array_t(begin, begin + length));
    }
    rows = std::move(outer);
  }
  return rows.front();
}

Json grid_object(const Task& task, const std::vector<const Outcome*>& points) {
  const DesignGrid& grid = task.grid;
  Json object;
  object["axes"] = Json::array();
  for (const GridAxis& axis : grid.axes()) {
    Json values = Json::array();
    for (std::size_t i = 0; i < axis.values.size(); ++i)
      values.push_back(axis_value(grid, axis, i));
    object["axes"].push_back(
        {{"name", axis.name}, {"unit", unit_of_variable(axis.name)}, {"values", values}});
  }
  // They say which of a design's pairs the axes call near.
  object["orders"] = Json::array();
  for (const VisitingOrder& order : grid.orders()) {
    object["orders"].push_back(fmt::format("{}", fmt::join(order, "")));
  }
  Json errors;
  object["cost"] = matrix_of(grid, points, [](const Outcome& point) { return point.cost.mean; });
  errors["cost"] =
      matrix_of(grid, points, [](const Outcome& point) { return point.cost.standard_error; });
  object["violation"] = matrix_of(grid, points, [](const Outcome& p) { return p.violation; });
  for (std::size_t i = 0; i < task.metrics.size(); ++i) {
    const std::string name(task.metrics[i].name);
    object[name] =
        matrix_of(grid, points, [i](const Outcome& point) { return point.metrics[i].mean; });
    errors[name] = matrix_of(grid, points,
                             [i](const Outcome& point) { return point.metrics[i].standard_error; });
  }
  object["standard_error"] = errors;
  return object;
}

/// On fresh screens, without those that fail there.
/// @throws VerificationFailed where all do
std::vector<RankedDesign> ranking_of(const std::vector<std::size_t>& best, const Sweep& sweep,
                                     const Task& task, RunRecord& record, const Progress* whole) {
  std::vector<RankedDesign> verified;
  Progress progress = verification_progress(task.verification, best.size(), "", whole);
  for (std::size_t i = 0; i < best.size(); ++i) {
    const bool is_last = i + 1 == best.size();
    std::optional<TriedDesign> tried =
        verified_candidate(sweep.designs()[best[i]].design, task.verification, record,
                           interruptible(progress), verified.empty() && is_last);
    const bool is_whole =
        !tried || static_cast<int>(tried->costs.size()) == task.verification.screen_count();
    if (!is_whole || (InterruptWatch::interrupted() && !is_last)) {
      throw RunInterrupted(fmt::format("in the verification; {}", record.how_to_go_on()));
    }
    if (tried) verified.push_back({.candidate = i, .verified = std::move(*tried)});
  }
  return ranked(std::move(verified));
}

/// A figure that people look at first.
struct MapFigure {
  const char* name;  ///< in the summary's grid
  const char* unit;  ///< as FITS has it
  const char* file;  ///< of the map, without what it ends with
};
constexpr std::array<MapFigure, 3> map_figures{{{"cost", "", "map-cost"},
                                                {"residual_wfe_nm", "nm", "map-residual_wfe"},
                                                {"fractional_loops", "", "map-fractional_loops"}}};

/// @return notes where there is no map
std::vector<std::string> draw_maps(const Task& task, const Json& grid, const CostedDesign& best,
                                   const OutputFolder& folder) {
  std::vector<PlannedPicture> pictures;
  pictures.reserve(map_figures.size());
  for (const MapFigure& map : map_figures) {
    pictures.push_back({map.file, [&, map](const auto& stem) {
                          return write_grid_picture(picture_title(task.telescope, task.seeing),
                                                    grid, map.name, best, stem);
                        }});
  }
  return draw_pictures(pictures, folder);
}

void run_sweep(const Request& request) {
  const Configuration& configuration = request.configuration;
  const Stopwatch stopwatch;
  Task task(configuration);
  RunRecord record(request);
  for (DesignTrial* trial : {&task.trial, &task.verification}) record.adopt(*trial);
  const std::size_t taken_over = record.archive().known_designs(task.trial.identity());
  const double seconds_before = record.archive().seconds_before();
  Sweep sweep(task, record);
  sweep.run(request);
  if (!sweep.is_complete()) {
    throw RunInterrupted(fmt::format("{} of {} designs are done; {}", sweep.done(),
                                     sweep.designs().size(), record.how_to_go_on()));
  }

  const std::vector<const Outcome*> points = outcomes_of_points(task, sweep);
  record.folder().write("sweep.csv", points_table(task, points));
  const std::vector<RankedDesign> ranking =
      ranking_of(best_of(sweep, task.candidates), sweep, task, record, request.whole);
  const TriedDesign& best = ranking.front().verified;
  const TriedDesign on_search_screens = task.trial.run(best.design);

  Configuration best_configuration = configuration;
  set_design(best_configuration, best.design, task.grid.space(), "by the sweep");
  record.folder().write("best.cfg", best_configuration.dump());
  const Json grid = grid_object(task, points);
  std::vector<std::string> notes = task.notes;
  std::ranges::move(
      draw_maps(task, grid, {best.design, mean_and_standard_error(on_search_screens.costs).mean},
                record.folder()),
      std::back_inserter(notes));
  const auto failures = static_cast<int>(std::ranges::count_if(
      sweep.outcomes(), [](const auto& outcome) { return !outcome->failure.empty(); }));
  const auto evaluations = static_cast<int>(sweep.designs().size());
  Json summary{
      {"best", to_json(best, task.verification)},
      {"best_on_search_screens", to_json(on_search_screens, task.trial)},
      {"ranking", to_json(ranking, task.verification)},
      {"grid", grid},
      {"points", task.grid.size()},
      {"evaluations", evaluations},
      {"failures", failures},
      {"search_reconstructions", std::int64_t(evaluations - failures) * task.trial.screen_count() *
                                     static_cast<std::int64_t>(task.trial.conditions().size())},
      {"reconstructions",
       (std::int64_t(evaluations - failures + 1) * task.trial.screen_count() +
        static_cast<std::int64_t>(ranking.size()) * task.verification.screen_count()) *
           static_cast<std::int64_t>(task.trial.conditions().size())},
      {"wall_seconds", seconds_before + stopwatch.seconds()},
      {"search_seconds", sweep.seconds()}};
  if (!request.silent) {
    for (const MapFigure& map : map_figures) {
      write_grid_map(grid, map.name, map.unit,
                     record.folder().file(std::string(map.file) + ".fits"));
    }
    const CloserLook look = look_closer(task.verification, best, record.folder());
    summary["closer_look"] = look.summary;
    std::ranges::copy(look.notes, std::back_inserter(notes));
  }
  record.write_summary(summary);

  const Performance performance = pooled(best.performances);
  const Performance search_performance = pooled(on_search_screens.performances);
  for (const std::string& note : notes) record.print("note: {}\n", note);
  record.print("{}\n", telescope_line(task.telescope, task.seeing));
  record.print(
      "Tried {} designs at {} points of a grid on {} screens in {} precision in {}{}{}.\n\n",
      evaluations, task.grid.size(), task.trial.screen_count(),
      configuration.choice("search.precision"), duration_text(sweep.seconds()),
      taken_over > 0 ? fmt::format(" ({} of them in an earlier run)", taken_over) : "",
      failures > 0 ? fmt::format("; {} of them failed, see sweep.csv", failures) : "");
  record.print("Best design, planes in visiting order:\n{}\n",
               planes_table(best.design, task.telescope, task.seeing, &performance));
  record.print(
      "On the sweep's {} screens, and on {} fresh ones with the true field {} samples across "
      "the pupil:\n{}",
      task.trial.screen_count(), task.verification.screen_count(),
      task.verification.conditions().front().simulation->truth_samples(),
      performance_table({{"sweep's screens", &search_performance, on_search_screens.costs},
                         {"fresh screens", &performance, best.costs}}));
  record.print("{}\n{}{}{}\n", conditions_table(best, task.verification),
               ranking_text(ranking, "The sweep"), limits_text(best, task.verification),
               captured_energy_warnings(best.design, performance));
  record.close();
}

std::string of_sweep(const Json& summary) {
  return fmt::format("The best of {} designs: {}.", integer_from_json(summary.at("evaluations")),
                     reached_text(summary.at("best"), "fresh screens"));
}

}  // namespace

Command sweep_command() {
  return {
      .name = "sweep",
      .group = "The best design",
      .description = "try every design of a grid: maps of all figures, and the best, verified",
      .about =
          "Tries all designs of the axes of the section sweep, maps every metric over them, "
          "and verifies the best few on fresh screens. It is what a search is checked "
          "against.",
      .keys = keys::joined(
          {keys::site, keys::simulation, keys::judgement, {"sweep", "verify", "search.precision"}}),
      .examples = {"nlcwfs sweep --sweep.z_near 5km:100km:24:log --sweep.z_far 50km:235km:24:log",
                   "nlcwfs sweep --resume results/sweep-1"},
      .run = run_sweep,
      .resumption = Resumption::by_trials,
      .files = joined({closer_look_files(),
                       {{"best.cfg", FileRole::design}, {"sweep.csv"}, {"map-*.fits"}},
                       picture_files({"map-*"})}),
      .verdict = of_sweep};
}

}  // namespace nlcwfs
