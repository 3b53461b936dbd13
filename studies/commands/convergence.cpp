// convergence: How one design's wavefront error falls from loop to loop.
#include "model/input_error.hpp"
#include "results/pictures/curve_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/trial_summary.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/trials.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

constexpr double nm = 1e-9;

/// The residual WFE of the wavefronts after one loop, nm.
struct LoopResiduals {
  std::vector<double> screens;
  MeanAndError mean = {};
  double standard_deviation = 0.0;
};

/// @param performance  whose loops were followed, all of them as many
std::vector<LoopResiduals> residuals_of(const Performance& performance) {
  std::vector<LoopResiduals> loops(performance.screens.front().residual_after_loops.size());
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    for (const ScreenPerformance& screen : performance.screens) {
      loops[loop].screens.push_back(screen.residual_after_loops[loop] / nm);
    }
    loops[loop].mean = mean_and_standard_error(loops[loop].screens);
    loops[loop].standard_deviation =
        loops[loop].mean.standard_error * std::sqrt(double(performance.screens.size()));
  }
  return loops;
}

std::string table_of(const std::vector<LoopResiduals>& loops) {
  std::vector<std::string> columns{"loop", "residual_wfe_nm", "standard_error_nm",
                                   "standard_deviation_nm"};
  for (std::size_t screen = 0; screen < loops.front().screens.size(); ++screen) {
    columns.push_back(fmt::format("screen_{}_nm", screen));
  }
  CsvTable table(columns);
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    table.row().add(double(loop + 1)).add(loops[loop].mean).add(loops[loop].standard_deviation);
    for (const double value : loops[loop].screens) table.add(value);
  }
  return table.text();
}

Json residuals_object(const std::vector<LoopResiduals>& loops) {
  Json object;
  for (const LoopResiduals& loop : loops) {
    object["mean"].push_back(loop.mean.mean);
    object["standard_error"].push_back(loop.mean.standard_error);
    object["standard_deviation"].push_back(loop.standard_deviation);
    object["screens"].push_back(loop.screens);
  }
  return object;
}

CurvePicture picture_of(const std::vector<LoopResiduals>& loops, const std::string& title) {
  CurvePicture picture{.title = title,
                       .x_label = "loops",
                       .y_label = "residual WFE, nm",
                       .curves = {},
                       .has_log_y = true};
  std::vector<double> numbers;
  Curve mean{.label = "mean"};
  for (const LoopResiduals& loop : loops) {
    numbers.push_back(double(numbers.size() + 1));
    mean.y.push_back(loop.mean.mean);
  }
  mean.x = numbers;
  for (std::size_t screen = 0; screen < loops.front().screens.size(); ++screen) {
    Curve curve{.label = screen == 0 ? "each wavefront" : "", .x = numbers, .is_pale = true};
    for (const LoopResiduals& loop : loops) curve.y.push_back(loop.screens[screen]);
    picture.curves.push_back(std::move(curve));
  }
  picture.curves.push_back(std::move(mean));
  return picture;
}

/// Loops that double up, and the last.
std::string loops_text(const std::vector<LoopResiduals>& loops) {
  std::string text =
      "After each loop, as far as it goes:\n   loops    residual WFE, nm   "
      "standard deviation, nm\n";
  for (std::size_t loop = 1; loop <= loops.size(); ++loop) {
    const bool is_power_of_two = (loop & (loop - 1)) == 0;
    if (!is_power_of_two && loop != loops.size()) continue;
    const LoopResiduals& residuals = loops[loop - 1];
    text += fmt::format("  {:>6}  {:>18}   {:>22.4g}\n", loop, with_error(residuals.mean),
                        residuals.standard_deviation);
  }
  return text;
}

void run_convergence(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  Setup setup(configuration);
  DesignTrial trial = trial_of(setup, ScreenSource(configuration), setup.options.precision,
                               cost_of(configuration, false));
  const Telescope& telescope = setup.telescope;
  const Seeing& seeing = setup.seeing();
  trial.run_on(request.runner);
  const SensorDesign design = trial.checked(setup.design);
  RunRecord record(request);

  const Simulation& simulation = *trial.conditions().front().simulation;
  const int screens = trial.screen_count();
  const Performance followed = [&] {
    Progress progress("convergence", screens, "screens followed", "then to the tolerance",
                      request.whole);
    return simulation.follow(design, interruptible(progress));
  }();
  const TriedDesign tried = [&] {
    Progress progress("convergence to the tolerance", screens, "screens", "", request.whole);
    return trial.run(design, {}, interruptible(progress));
  }();
  if (const std::size_t done = std::min(followed.screens.size(), tried.costs.size());
      static_cast<int>(done) < screens) {
    record.note_interrupted(fmt::format("{} of {} screens were followed, {} to the tolerance",
                                        followed.screens.size(), screens, tried.costs.size()));
  }
  const std::vector<LoopResiduals> loops = residuals_of(followed);
  std::vector<double> aberrations = simulation.aberrations();
  aberrations.resize(followed.screens.size());
  for (double& aberration : aberrations) aberration /= nm;
  record.folder().write("screens.csv", screens_table(tried.performances.front()));
  record.folder().write("convergence.csv", table_of(loops));
  const auto no_picture = write_picture(picture_of(loops, picture_title(telescope, seeing)),
                                        record.folder().file("convergence"));
  record.write_summary({{"design", to_json(tried, trial)},
                        {"aberrations_nm", aberrations},
                        {"residual_after_loops_nm", residuals_object(loops)}});

  for (const std::string& note : setup.notes) record.print("note: {}\n", note);
  if (no_picture) record.print("note: there is no picture: {}\n", *no_picture);
  const Performance& performance = tried.performances.front();
  record.print("{}\n\n{}\n{}\n", telescope_line(telescope, seeing),
               planes_table(design, telescope, seeing, &performance), loops_text(loops));
  record.print("With reconstruction.tolerance = {}:\n{}\n",
               configuration.value_text("reconstruction.tolerance"),
               performance_table({{"mean +- standard error", &performance, tried.costs}}));
  record.close();
}

std::string of_convergence(const Json& summary) {
  const Json& residuals = summary.at("residual_after_loops_nm");
  const std::size_t loops = residuals.at("mean").size();
  return fmt::format(
      "After {} loops the residual WFE of {} wavefronts is {} nm; the stopping rule ends after {}.",
      loops, summary.at("aberrations_nm").size(),
      with_error({number_from_json(residuals.at("mean").at(loops - 1)),
                  number_from_json(residuals.at("standard_error").at(loops - 1))}),
      figure_text(summary.at("design").at("performance"), "loops"));
}

}  // namespace

Command convergence_command() {
  return {.name = "convergence",
          .group = "One design",
          .description = "follow one design's residual wavefront error from loop to loop",
          .about =
              "Runs all of reconstruction.max_loops on each wavefront, whatever the tolerance, "
              "and gives the residual wavefront error after each loop as a table and a picture.",
          .keys = keys::joined({keys::site, keys::simulation, keys::judgement}),
          .examples = {"nlcwfs convergence --source.bands 400nm:800nm --source.division split"},
          .run = run_convergence,
          .files = joined({{{"convergence.csv", FileRole::table}, {"screens.csv", FileRole::table}},
                           picture_files({"convergence"})}),
          .verdict = of_convergence};
}

}  // namespace nlcwfs
