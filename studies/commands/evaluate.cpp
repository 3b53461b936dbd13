// evaluate: One design's performance on the configured screens.
#include "results/tables/trial_summary.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/settings/trials.hpp"

namespace nlcwfs {
namespace {

void run_evaluate(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  Setup setup(configuration);
  DesignTrial trial = trial_of(setup, ScreenSource(configuration), setup.options.precision,
                               cost_of(configuration, false));
  const SensorDesign design = trial.checked(setup.design);
  const Telescope& telescope = setup.telescope;
  const Seeing& seeing = setup.seeing();
  trial.keeps_failures = false;
  RunRecord record(request);
  record.adopt(trial);

  const Stopwatch stopwatch;
  const TriedDesign tried = [&] {
    Progress progress("evaluate", trial.screen_count(), "screens", "", request.whole);
    return trial.run(design, {}, interruptible(progress));
  }();
  const double seconds = stopwatch.seconds();
  const Performance& performance = tried.performances.front();
  record.note_missing_screens(tried, trial);

  record.add({.stage = "evaluate",
              .design = to_json(design, telescope, seeing.fried_parameter).dump(),
              .cost = mean_and_standard_error(tried.costs).mean,
              .failure = "",
              .seconds = seconds,
              .performance = to_json(performance).dump()});
  record.folder().write("screens.csv", screens_table(performance));
  Json summary{{"design", to_json(tried, trial)}};
  if (!request.silent) {
    const CloserLook look = look_closer(trial, tried, record.folder());
    summary["closer_look"] = look.summary;
    setup.notes.insert(setup.notes.end(), look.notes.begin(), look.notes.end());
  }
  record.write_summary(summary);

  for (const std::string& note : setup.notes) record.print("note: {}\n", note);
  record.print("{}\n\n", telescope_line(telescope, seeing));
  record.print("{}\n", planes_table(design, telescope, seeing, &performance));
  record.print("On {} screen{}, {} truth:\n{}", performance.screens.size(),
               performance.screens.size() == 1 ? "" : "s", word_of(setup.options.truth),
               performance_table({{"mean +- standard error", &performance, tried.costs}}));
  if (performance.screens.size() == 1) {
    record.print("note: one screen has no standard error; screens.count = 16 or more has\n");
  }
  record.print("{}{}", limits_text(tried, trial), design_warnings(tried, trial));
  record.print("\n");
  record.close();
}

std::string of_evaluate(const Json& summary) {
  const Json& design = summary.at("design");
  return fmt::format("{} planes: {}; {:.3g} % of the reconstructions converged.",
                     design.at("planes_m").size(), reached_text(design, "screens"),
                     100.0 * number_from_json(design.at("performance").at("converged_fraction")));
}

}  // namespace

Command evaluate_command() {
  return {.name = "evaluate",
          .group = "One design",
          .description = "measure one design: wavefront error, loops and time with standard errors",
          .about =
              "Simulates the sensor of the sections sensor, detector and reconstruction on the "
              "wavefronts of the section screens, and says how well and how fast it recovers "
              "them. Every metric of every wavefront is in screens.csv.",
          .keys = keys::joined({keys::site, keys::simulation, keys::judgement}),
          .examples = {"nlcwfs evaluate --telescope.diameter 1.8 --seeing.fried_parameter 24cm",
                       "nlcwfs evaluate --config results/optimize-1/best.cfg --screens.count 256"},
          .run = run_evaluate,
          .resumption = Resumption::by_trials,
          .files = joined({closer_look_files(), {{"screens.csv", FileRole::table}}}),
          .verdict = of_evaluate,
          .is_for_a_start = true};
}

}  // namespace nlcwfs
