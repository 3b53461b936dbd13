#include "results/tables/design_summary.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/design_text.hpp"
#include "studies/commands/run_functions.hpp"
#include "studies/run/evaluation_log.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/stopwatch.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/settings/setup.hpp"

#include <fmt/format.h>

namespace nlcwfs {
void run_evaluate(const CommandLine& command_line) {
  const Configuration& configuration = command_line.configuration;
  require_one_condition(configuration);
  const Telescope telescope = telescope_of(configuration);
  const Seeing seeing = seeing_of(configuration, telescope);
  std::vector<std::string> notes;
  DesignTrial trial = trial_of(configuration, "simulation.precision", notes);
  const SensorDesign design = trial.checked(design_of(configuration));
  trial.keeps_failures = false;
  RunRecord record(command_line);
  record.adopt(trial);

  const Stopwatch stopwatch;
  const TriedDesign tried = [&] {
    Progress progress("evaluate", trial.screen_count(), "screens", "", command_line.whole);
    return trial.run(design, {}, interruptible(progress));
  }();
  const double seconds = stopwatch.seconds();
  const Performance& performance = tried.performances.front();
  record.note_missing_screens(tried, trial);

  archive_and_log(record.archive(),
                  {.stage = "evaluate",
                   .design = to_json(design, telescope, seeing.fried_parameter).dump(),
                   .cost = mean_and_standard_error(tried.costs).mean,
                   .failure = "",
                   .seconds = seconds,
                   .performance = to_json(performance).dump()});
  record.folder().write("screens.csv", screens_table(performance));
  nlohmann::ordered_json summary{{"design", to_json(tried, trial)}};
  if (!command_line.silent) {
    const CloserLook look = look_closer(trial, tried, record.folder());
    summary["closer_look"] = look.summary;
    notes.insert(notes.end(), look.notes.begin(), look.notes.end());
  }
  record.write_summary(summary);

  for (const std::string& note : notes) record.print("note: {}\n", note);
  record.print("{}\n\n", telescope_line(telescope, seeing));
  record.print("{}\n", planes_table(design, telescope, seeing, &performance));
  record.print("On {} screen{}, {} truth:\n{}", performance.screens.size(),
               performance.screens.size() == 1 ? "" : "s", configuration.choice("simulation.truth"),
               performance_table({{"mean +- standard error", &performance, tried.costs}}));
  if (performance.screens.size() == 1) {
    record.print("note: one screen has no standard error; screens.count = 16 or more has\n");
  }
  record.print("{}{}", limits_text(tried, trial), captured_energy_warnings(design, performance));
  record.print("\n");
  record.close();
}

}  // namespace nlcwfs
