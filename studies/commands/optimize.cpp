// optimize: The best design of the configured search, verified on fresh screens beside the
// baseline.
#include "results/tables/trial_summary.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/search/design_search.hpp"
#include "studies/search/search_log.hpp"

namespace nlcwfs {
namespace {

Json ranges_object(const DesignSearchResult& result) {
  Json ranges = Json::object();
  for (const OptimumRange& range : result.ranges) {
    ranges[range.name] = {{"best", range.best},
                          {"least", range.least},
                          {"greatest", range.greatest},
                          {"least_is_bound", range.least_is_bound},
                          {"greatest_is_bound", range.greatest_is_bound}};
  }
  return ranges;
}

Json stages_array(const SearchResult& result) {
  Json stages = Json::array();
  for (const SearchStage& stage : result.stages) {
    stages.push_back({{"name", stage.name}, {"evaluations", stage.evaluations}});
  }
  return stages;
}

std::string search_text(const DesignSearch& task, const DesignSearchResult& result) {
  std::string text =
      tried_text(fmt::format("{} designs", result.search.evaluations), task.trial,
                 task.search_precision, result.search_seconds, result.search.termination,
                 "search.budget", "until nothing got better");
  if (result.cheap_evaluations > 0) {
    text += fmt::format("; before that {} in the cheap search", result.cheap_evaluations);
  }
  if (result.search.failures > 0) {
    text += fmt::format("; {} of them failed, see search.csv", result.search.failures);
  }
  text += ".\n";
  if (result.given_up > 0) {
    text += fmt::format(
        "{} clearly worse ones were given up after their first screens, which saved {} of {} "
        "reconstructions.\n",
        result.given_up, result.saved_reconstructions,
        result.saved_reconstructions + result.search_reconstructions);
  }
  return text;
}

/// How far the best design's variables may move.
std::string ranges_text(const DesignSearch& task, const DesignSearchResult& result) {
  if (result.ranges.empty()) {
    return result.interrupted_when.empty()
               ? ""
               : "Interrupted: how far each variable may move is not known.\n\n";
  }
  std::string text =
      fmt::format("Moved alone, each variable is as good on {} fresh screens (Student's t, 5 %):\n",
                  task.scan.screen_count());
  for (const OptimumRange& range : result.ranges) {
    const auto shown = [&](double value) { return variable_text(range.name, value); };
    // With its value, since the pair that a search calls near may be the farther one.
    text += fmt::format("  {:<28} {:>10}: {:>10} to {}", range.name, shown(range.best),
                        shown(range.least), shown(range.greatest));
    if (range.least_is_bound && range.greatest_is_bound) {
      text += ", all that was searched";
    } else if (range.least_is_bound || range.greatest_is_bound) {
      text += fmt::format("; {} is the end of what was searched",
                          shown(range.least_is_bound ? range.least : range.greatest));
    }
    text += '\n';
  }
  return text + '\n';
}

void print_result(const DesignSearch& task, const DesignSearchResult& result,
                  const std::vector<std::string>& notes) {
  const TriedDesign& best = result.best();
  const Performance best_performance = pooled(best.performances);
  const Performance baseline_performance = pooled(result.baseline.performances);
  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n{}\n", telescope_line(task.telescope, task.seeing()), search_text(task, result));
  fmt::print("Best design, planes in visiting order:\n{}{}\n",
             planes_table(best.design, task.telescope, task.seeing(), &best_performance),
             choices_text(task.space, best.design));
  fmt::print("Baseline:\n{}\n", planes_table(result.baseline.design, task.telescope, task.seeing(),
                                             &baseline_performance));
  fmt::print("Both on the same {} fresh screens, true field {} samples across the pupil:\n{}",
             result.best().costs.size(),
             task.verification.conditions().front().simulation->truth_samples(),
             performance_table({{"best design", &best_performance, best.costs},
                                {"baseline", &baseline_performance, result.baseline.costs}}));
  fmt::print("{}\n{}{}", conditions_table(best, task.verification),
             ranking_text(result.ranking, "The search"), ranges_text(task, result));
  // Of two designs that do not work, neither beats the other.
  if (futility_text(best, task.verification).empty()) {
    fmt::print("{}\n", baseline_verdict_text(result.gain,
                                             mean_and_standard_error(result.baseline.costs).mean));
  }
  fmt::print("{}{}", limits_text(best, task.verification),
             design_warnings(best, task.verification));
}

void run_optimize(const Request& request) {
  const Stopwatch stopwatch;
  DesignSearch task(request.configuration);
  RunRecord record(request);
  for (DesignTrial* trial : task.trials()) record.adopt(*trial);
  const DesignSearchResult result = task.run(record);
  if (!result.interrupted_when.empty()) record.note_interrupted(result.interrupted_when);

  record.write_design("best.cfg", result.best().design, task.space, "by the search");
  record.folder().write("search.csv", result.table);
  record.folder().write("sensitivity.csv", sensitivity_table(result.ranges));
  const CloserLook look = look_closer(task.verification, result.best(), record.folder());
  const std::string title = picture_title(task.telescope, task.seeing());
  std::vector<PlannedPicture> pictures{search_picture(title, result.steps)};
  if (!result.ranges.empty()) pictures.push_back(sensitivity_picture(title, result.ranges));
  std::vector<std::string> notes = task.notes;
  for (const std::vector<std::string>& more :
       {look.notes, draw_pictures(pictures, record.folder())}) {
    notes.insert(notes.end(), more.begin(), more.end());
  }
  record.write_summary(
      {{"best", to_json(result.best(), task.verification)},
       {"baseline", to_json(result.baseline, task.verification)},
       {"improvement",
        {{"cost", result.gain.cost.mean}, {"standard_error", result.gain.cost.standard_error}}},
       {"ranking", to_json(result.ranking, task.verification)},
       {"indistinguishable", ranges_object(result)},
       {"closer_look", look.summary},
       {"evaluations", result.search.evaluations},
       {"cheap_evaluations", result.cheap_evaluations},
       {"given_up", result.given_up},
       {"cache_hits", result.search.cache_hits},
       {"failures", result.search.failures},
       {"search_reconstructions", result.search_reconstructions},
       {"saved_reconstructions", result.saved_reconstructions},
       {"reconstructions", result.reconstructions},
       {"wall_seconds", stopwatch.seconds()},
       {"search_seconds", result.search_seconds},
       {"termination", to_string(result.search.termination)},
       {"stages", stages_array(result.search)}});
  print_result(task, result, notes);
  record.close();
}

std::string of_optimize(const Json& summary) {
  const Json& best = summary.at("best");
  const Json& gain = summary.at("improvement");
  const std::size_t conditions = best.contains("conditions") ? best.at("conditions").size() : 1;
  const std::size_t screens =
      static_cast<std::size_t>(integer_from_json(best.at("performance").at("screens"))) /
      std::max<std::size_t>(conditions, 1);
  const std::string reached = reached_text(best, "fresh screens");
  if (!best.value("futility", Json()).is_null()) return fmt::format("Best design: {}.", reached);
  return fmt::format(
      "Best design: {}. {}", reached,
      baseline_verdict_text(improvement({number_from_json(gain.at("cost")),
                                         number_from_json(gain.at("standard_error"))},
                                        screens),
                            mean_from_json(summary.at("baseline").at("cost")).mean));
}

}  // namespace

Command optimize_command() {
  return {.name = "optimize",
          .group = "The best design",
          .description = "find a telescope's best design and verify it on fresh screens",
          .about =
              "Searches what the section search lets vary for the lowest cost of the section "
              "objective, verifies the best few designs on fresh screens beside the baseline, and "
              "tells how far each variable may move. best.cfg holds the winner.",
          .keys = keys::joined({keys::site, keys::simulation, keys::judgement, keys::search}),
          .examples =
              {"nlcwfs optimize --telescope.diameter 1.8 --telescope.wavelength 850nm "
               "--seeing.fwhm 0.9",
               "nlcwfs optimize --search.layout free --search.plane_count 3,4 --detector.photons "
               "1e5"},
          .run = run_optimize,
          .resumption = Resumption::by_trials,
          .files = joined({{{"best.cfg", FileRole::design},
                            {"search.csv", FileRole::table},
                            {"sensitivity.csv", FileRole::table}},
                           closer_look_files(),
                           picture_files({"search", "sensitivity"})}),
          .verdict = of_optimize,
          .is_for_a_start = true};
}

}  // namespace nlcwfs
