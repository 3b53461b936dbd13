// sweep: Every design of the configured grid, the best of them verified on fresh screens.
#include "studies/search/sweep.hpp"

#include "results/pictures/grid_picture.hpp"
#include "results/pictures/picture_set.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/axis_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"

#include <array>
#include <iterator>

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// A value of an axis as people write it; lengths and times in SI.
Json axis_value(const DesignGrid& grid, const GridAxis& axis, std::size_t place) {
  const double value = axis.values[place];
  if (axis.name == "order") {
    return fmt::format("{}", fmt::join(grid.orders()[static_cast<std::size_t>(value)], ""));
  }
  const ConfigurationKey& key = key_named("sweep." + axis.name);
  if (key.element == Kind::choice) return key.choices[static_cast<std::size_t>(value)];
  if (key.element == Kind::integer) return static_cast<int>(value);
  return value;
}

/// One row per point of the grid.
std::string points_table(const SweepTask& task, const std::vector<const SweepOutcome*>& points) {
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
    const SweepOutcome* outcome = points[point];
    if (outcome == nullptr || !outcome->failure.empty()) {
      for (std::size_t i = 0; i < 3 + 2 * task.metrics.size(); ++i) table.add("");
      table.add(outcome == nullptr ? "left out, or the order is one of another number of planes"
                                   : outcome->failure);
      continue;
    }
    table.add(outcome->cost).add(outcome->violation);
    for (const MeanAndError& metric : outcome->metrics) table.add(metric);
    table.add("");
  }
  return table.text();
}

/// Nested arrays, the first axis outermost, of a value of each point; null where there is none.
template <class Value>
Json matrix_of(const DesignGrid& grid, const std::vector<const SweepOutcome*>& points,
               const Value& value) {
  std::vector<Json> rows;
  for (const SweepOutcome* point : points) {
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

Json grid_object(const SweepTask& task, const std::vector<const SweepOutcome*>& points) {
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
  const auto add = [&](std::string_view name, const auto& figure) {
    object[name] = matrix_of(grid, points, [&](const auto& point) { return figure(point).mean; });
    errors[name] =
        matrix_of(grid, points, [&](const auto& point) { return figure(point).standard_error; });
  };
  add("cost", [](const SweepOutcome& point) { return point.cost; });
  object["violation"] = matrix_of(grid, points, [](const SweepOutcome& p) { return p.violation; });
  for (std::size_t i = 0; i < task.metrics.size(); ++i) {
    add(task.metrics[i].name, [i](const SweepOutcome& point) { return point.metrics[i]; });
  }
  object["standard_error"] = errors;
  return object;
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
std::vector<std::string> draw_maps(const SweepTask& task, const Json& grid,
                                   const CostedDesign& best, const OutputFolder& folder) {
  std::vector<PlannedPicture> pictures;
  for (const MapFigure& map : map_figures) {
    pictures.push_back({map.file, [&, map](const auto& stem) {
                          return write_grid_picture(picture_title(task.telescope, task.seeing()),
                                                    grid, map.name, best, stem);
                        }});
  }
  return draw_pictures(pictures, folder);
}

/// What people are told of a sweep.
struct SweepResult {
  const std::vector<RankedDesign>& ranking;  ///< on fresh screens
  const TriedDesign& on_search_screens;      ///< the best
  std::size_t evaluations;
  std::ptrdiff_t failures;
  std::size_t taken_over;  ///< designs of an earlier run
  double seconds;          ///< that the grid took

  const TriedDesign& best() const { return ranking.front().verified; }
};

Json summary_of(const SweepTask& task, const SweepResult& result, const Json& grid) {
  const auto conditions = static_cast<std::int64_t>(task.trial.conditions().size());
  const std::int64_t tried = static_cast<std::int64_t>(result.evaluations) - result.failures;
  const int screens = task.trial.screen_count();
  const std::int64_t fresh =
      static_cast<std::int64_t>(result.ranking.size()) * task.verification.screen_count();
  return {{"best", to_json(result.best(), task.verification)},
          {"best_on_search_screens", to_json(result.on_search_screens, task.trial)},
          {"ranking", to_json(result.ranking, task.verification)},
          {"grid", grid},
          {"points", task.grid.size()},
          {"evaluations", result.evaluations},
          {"failures", result.failures},
          {"search_reconstructions", tried * screens * conditions},
          {"reconstructions", ((tried + 1) * screens + fresh) * conditions}};
}

void print_result(const RunRecord& record, const SweepTask& task, const SweepResult& result,
                  const std::vector<std::string>& notes) {
  const TriedDesign& best = result.best();
  const Performance performance = pooled(best.performances);
  const Performance search_performance = pooled(result.on_search_screens.performances);
  for (const std::string& note : notes) record.print("note: {}\n", note);
  record.print("{}\n", telescope_line(task.telescope, task.seeing()));
  record.print(
      "Tried {} designs at {} points of a grid on {} screens in {} precision in {}{}{}.\n\n",
      result.evaluations, task.grid.size(), task.trial.screen_count(),
      word_of(task.search_precision), duration_text(result.seconds),
      result.taken_over > 0 ? fmt::format(" ({} of them in an earlier run)", result.taken_over)
                            : "",
      result.failures > 0 ? fmt::format("; {} of them failed, see sweep.csv", result.failures)
                          : "");
  record.print("Best design, planes in visiting order:\n{}\n",
               planes_table(best.design, task.telescope, task.seeing(), &performance));
  record.print(
      "On the sweep's {} screens, and on {} fresh ones with the true field {} samples across "
      "the pupil:\n{}",
      task.trial.screen_count(), task.verification.screen_count(),
      task.verification.conditions().front().simulation->truth_samples(),
      performance_table({{"sweep's screens", &search_performance, result.on_search_screens.costs},
                         {"fresh screens", &performance, best.costs}}));
  record.print("{}\n{}{}{}\n", conditions_table(best, task.verification),
               ranking_text(result.ranking, "The sweep"), limits_text(best, task.verification),
               design_warnings(best, task.verification));
}

void run_sweep(const Request& request) {
  const Stopwatch stopwatch;
  SweepTask task(request.configuration);
  RunRecord record(request);
  for (DesignTrial* trial : {&task.trial, &task.verification}) record.adopt(*trial);
  const std::size_t taken_over = record.archive().known_designs(task.trial.identity());
  const double seconds_before = record.archive().seconds_before();
  Sweep sweep{task, record};
  sweep.run(request);
  if (sweep.done < sweep.designs.size()) {
    throw RunInterrupted(fmt::format("{} of {} designs are done; {}", sweep.done,
                                     sweep.designs.size(), record.how_to_go_on()));
  }

  const std::vector<const SweepOutcome*> points = outcomes_of_points(sweep);
  record.folder().write("sweep.csv", points_table(task, points));
  const std::vector<RankedDesign> ranking =
      ranking_of(best_of(sweep, task.candidates), sweep, request.whole);
  const TriedDesign& best = ranking.front().verified;
  const TriedDesign on_search_screens = task.trial.run(best.design);

  record.write_design("best.cfg", best.design, task.grid.space(), "by the sweep");
  const Json grid = grid_object(task, points);
  std::vector<std::string> notes = task.notes;
  std::ranges::move(
      draw_maps(task, grid, {best.design, mean_and_standard_error(on_search_screens.costs).mean},
                record.folder()),
      std::back_inserter(notes));
  const auto failures = std::ranges::count_if(
      sweep.outcomes, [](const auto& outcome) { return !outcome->failure.empty(); });
  const SweepResult result{ranking,  on_search_screens, sweep.designs.size(),
                           failures, taken_over,        sweep.seconds};
  Json summary = summary_of(task, result, grid);
  summary["wall_seconds"] = seconds_before + stopwatch.seconds();
  summary["search_seconds"] = sweep.seconds;
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

  print_result(record, task, result, notes);
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
