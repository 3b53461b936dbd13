// compare: The best designs of a sweep and of a search, on screens that neither has seen, and what
// finding them took.
#include "model/input_error.hpp"
#include "results/pictures/grid_picture.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/verified_ranking.hpp"
#include "studies/settings/text.hpp"

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// What a finished run left in its folder.
struct FinishedRun {
  std::filesystem::path folder;
  Configuration configuration = {};
  Json summary = {};
  SensorDesign best = {};
  Json effort = {};  ///< that finding it took: designs, reconstructions and seconds
};

/// @param argument  name of the command line's argument: "SWEEP"
/// @param command   that must have made the folder
FinishedRun finished_run(const std::string& argument, const std::string& command,
                         const std::filesystem::path& folder) {
  const auto refuse = [&](const std::string& why, const std::string& remedy) {
    throw InputError(argument, one_line(folder.string()), why, remedy);
  };
  const std::string finished = " of a finished " + command;
  if (!std::filesystem::is_directory(folder)) {
    refuse("there is no such folder", "name that" + finished);
  }
  if (!std::filesystem::is_regular_file(folder / "config.cfg")) {
    refuse("has no config.cfg", "name the folder" + finished);
  }
  if (!std::filesystem::is_regular_file(folder / "summary.json")) {
    refuse("has no summary.json: the run is not finished", "give that" + finished);
  }
  FinishedRun run{.folder = folder};
  run.configuration.read_file(folder / "config.cfg");
  try {
    run.summary = json_of(text_of_file(folder / "summary.json"));
    if (!run.summary.is_object()) throw std::runtime_error("it is no JSON object");
    const std::string made_by = run.summary.at("command");
    if (made_by != command) {
      refuse("is a run of " + made_by,
             "give first the folder of a sweep, then that of an optimize");
    }
    run.best = design_from_json(run.summary.at("best"));
    int designs = integer_from_json(run.summary.at("evaluations"));
    if (run.summary.contains("cheap_evaluations")) {
      designs += integer_from_json(run.summary.at("cheap_evaluations"));
    }
    run.effort = {{"designs", designs},
                  {"reconstructions", run.summary.at("search_reconstructions").get<std::int64_t>()},
                  {"seconds", run.summary.at("search_seconds").get<double>()}};
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("cannot read {}: {}", (folder / "summary.json").string(), error.what()));
  }
  return run;
}

/// Whether the grid or the search of a run decides on a key of the design.
bool decides_on(const FinishedRun& run, std::string_view section, std::string_view key) {
  return std::ranges::any_of(design_properties(), [&](const DesignField& field) {
    return field.key == key &&
           run.configuration.is_set(fmt::format("{}.{}", section, field.variable));
  });
}

/// Whether designs of equal costs would have others under another value of the key.
bool changes_the_comparison(std::string_view key) {
  return key.starts_with("telescope.") || key.starts_with("seeing.") ||
         key.starts_with("detector.") || key.starts_with("reconstruction.") ||
         key.starts_with("objective.") || key.starts_with("source.") || key == "simulation.truth" ||
         key == "simulation.pupil_samples";
}

/// A key's value such that equal values are equal texts.
std::string canonical(const Configuration& configuration, const ConfigurationKey& key) {
  if (!configuration.is_set(key.name)) return "not set";
  switch (key.kind) {
    case Kind::number:
      return fmt::format("{}", configuration.number(key.name));
    case Kind::number_list:
      return fmt::format("{}", fmt::join(configuration.numbers(key.name), ","));
    case Kind::length:
      return fmt::format("{}", configuration.length(key.name));
    case Kind::length_list:
      return fmt::format("{}", fmt::join(configuration.lengths(key.name), ","));
    case Kind::bands: {
      std::string text;
      for (const Band& band : configuration.bands(key.name)) {
        text += fmt::format("{}:{},", band.shortest, band.longest);
      }
      return text;
    }
    case Kind::time:
      return fmt::format("{}", *configuration.optional_time(key.name));
    case Kind::ramp:
      return fmt::format("{}", configuration.ramp(key.name));
    default:
      return configuration.value_text(key.name);
  }
}

std::string value_or_not_set(const Configuration& configuration, std::string_view key) {
  return configuration.is_set(key) ? configuration.value_text(key) : "not set";
}

/// Whether two configurations mean the same seeing, whichever measure of it they give.
bool is_same_seeing(const Configuration& a, const Configuration& b) {
  const auto is_same = [](const Seeing& one, const Seeing& other) {
    return one.fried_parameter == other.fried_parameter && one.outer_scale == other.outer_scale;
  };
  return std::ranges::equal(seeings_of(a, telescope_of(a)), seeings_of(b, telescope_of(b)),
                            is_same);
}

/// @throws InputError with every key in which the runs must not differ but do
void require_comparable(const FinishedRun& sweep, const FinishedRun& optimize) {
  const bool same_seeing = is_same_seeing(sweep.configuration, optimize.configuration);
  std::vector<std::string> differences;
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!changes_the_comparison(key.name) || decides_on(sweep, "sweep", key.name) ||
        decides_on(optimize, "search", key.name) ||
        (same_seeing && key.name.starts_with("seeing.")) ||
        canonical(sweep.configuration, key) == canonical(optimize.configuration, key)) {
      continue;
    }
    differences.push_back(fmt::format("{} ({} and {})", key.name,
                                      value_or_not_set(sweep.configuration, key.name),
                                      value_or_not_set(optimize.configuration, key.name)));
  }
  if (differences.empty()) return;
  throw InputError("OPTIMIZE", one_line(optimize.folder.string()),
                   fmt::format("was not configured as the sweep {}; they differ in {}",
                               one_line(sweep.folder.string()), fmt::join(differences, ", ")));
}

/// The sweep's configuration with the section verify of the command line, and screens that neither
/// run has seen.
Configuration comparison_configuration(const Configuration& given, const FinishedRun& sweep,
                                       const FinishedRun& optimize) {
  Configuration configuration = sweep.configuration;
  const auto is_given = [&](std::string_view key) {
    return given.source(key) != Configuration().source(key);
  };
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!changes_the_comparison(key.name) || !is_given(key.name) ||
        canonical(given, key) == canonical(configuration, key)) {
      continue;
    }
    throw InputError(key.name, value_or_not_set(given, key.name),
                     fmt::format("compare takes it from the sweep, where it is {}",
                                 value_or_not_set(configuration, key.name)),
                     "leave it away");
  }
  for (const std::string& key : keys::fresh_screens) {
    if (is_given(key)) configuration.set(key, given.value_text(key), given.source(key));
  }

  std::set<std::uint64_t> seen;
  for (const FinishedRun* run : {&sweep, &optimize}) {
    for (const char* key : {"screens.seed", "verify.seed"}) {
      seen.insert(run->configuration.seed(key));
    }
  }
  std::uint64_t seed = configuration.seed("verify.seed");
  if (is_given("verify.seed")) {
    if (seen.contains(seed)) {
      throw InputError("verify.seed", seed,
                       "another seed than those of the two runs, which have seen its screens");
    }
    return configuration;
  }
  while (seen.contains(seed)) ++seed;
  configuration.set("verify.seed", fmt::format("{}", seed), "by compare, for fresh screens");
  return configuration;
}

/// Whether designs that a run compared differed in their pixels across the pupil.
bool pixels_vary(const FinishedRun& sweep, const FinishedRun& optimize) {
  const auto swept = sweep.configuration.axis("sweep.pupil_pixels");
  const auto searched = optimize.configuration.domain("search.pupil_pixels");
  const auto* list = searched ? std::get_if<std::vector<double>>(&*searched) : nullptr;
  return (swept && swept->size() > 1) || (list != nullptr && list->size() > 1) ||
         sweep.best.detector.pupil_pixels != optimize.best.detector.pupil_pixels;
}

/// The designs that a search tried, over the sweep's map of the cost.
/// @return why there is no picture; nothing where there is one
std::optional<std::string> write_path_picture(const FinishedRun& sweep, const FinishedRun& optimize,
                                              const Telescope& telescope, const Seeing& seeing,
                                              const OutputFolder& folder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SearchPath path{.designs = {}, .best = {optimize.best, nan}};
  const Archive archive = Archive::reopened(optimize.folder / "archive.sqlite");
  for (const ArchivedEvaluation& evaluation : archive.evaluations()) {
    if (evaluation.stage != "search" || !evaluation.failure.empty()) continue;
    path.designs.push_back({design_from_json(json_of(evaluation.design)), evaluation.cost});
    if (path.designs.back().design.planes == optimize.best.planes) {
      path.best.cost = evaluation.cost;
    }
  }
  return write_grid_picture(picture_title(telescope, seeing), sweep.summary.at("grid"), "cost",
                            {sweep.best, nan}, folder.file("path"), path);
}

std::string verdict_text(const Improvement& gain, double sweep_cost) {
  switch (gain.verdict) {
    case Verdict::better:
      return fmt::format(
          "The optimizer's design beats the sweep's: it costs {} less ({:.1f} %), "
          "screen by screen.",
          with_error(gain.cost), 100.0 * gain.cost.mean / sweep_cost);
    case Verdict::indistinguishable:
      return fmt::format(
          "The two designs cannot be told apart: the sweep's cost minus the optimizer's is {}, "
          "which may well be chance.",
          with_error(gain.cost));
    case Verdict::worse:
      break;
  }
  return fmt::format(
      "The sweep's design beats the optimizer's, which costs {} more ({:.1f} %), "
      "screen by screen.",
      with_error({-gain.cost.mean, gain.cost.standard_error}),
      -100.0 * gain.cost.mean / sweep_cost);
}

/// How much more the sweep took than the search.
Json effort_ratios(const FinishedRun& sweep, const FinishedRun& optimize) {
  Json ratios;
  for (const auto& [what, effort] : sweep.effort.items()) {
    ratios[what] = effort.get<double>() / optimize.effort.at(what).get<double>();
  }
  return ratios;
}

/// A run with its best design on the screens of the comparison.
struct Side {
  const FinishedRun& run;
  const TriedDesign& tried;
};

void print_designs(const Side& sweep, const Side& optimize, const DesignTrial& trial,
                   const Telescope& telescope, const Seeing& seeing, std::uint64_t seed) {
  const Performance swept_performance = pooled(sweep.tried.performances);
  const Performance found_performance = pooled(optimize.tried.performances);
  fmt::print("Best of the sweep {}, planes in visiting order:\n{}\n", sweep.run.folder.string(),
             planes_table(sweep.tried.design, telescope, seeing, &swept_performance));
  fmt::print("Best of the optimizer {}:\n{}\n", optimize.run.folder.string(),
             planes_table(optimize.tried.design, telescope, seeing, &found_performance));
  fmt::print(
      "Both on the same {} screens of seed {}, which neither has seen, true field {} "
      "samples across the pupil:\n{}",
      sweep.tried.costs.size(), seed, trial.conditions().front().simulation->truth_samples(),
      performance_table({{"sweep", &swept_performance, sweep.tried.costs},
                         {"optimize", &found_performance, optimize.tried.costs}}));
}

void print_efforts(const FinishedRun& sweep, const FinishedRun& optimize, const Json& ratios) {
  fmt::print("  {:<22} {:>14} {:>14} {:>10}\n", "what finding it took", "sweep", "optimize",
             "ratio");
  for (const auto& [what, ratio] : ratios.items()) {
    const bool is_time = what == "seconds";
    const auto shown = [&, &key = what](const FinishedRun& run) {
      const Json& effort = run.effort.at(key);
      return is_time ? duration_text(effort.get<double>()) : effort.dump();
    };
    fmt::print("  {:<22} {:>14} {:>14} {:>10.3g}\n", is_time ? "time" : what, shown(sweep),
               shown(optimize), ratio.get<double>());
  }
  fmt::print("\n");
}

void run_compare(const Request& request) {
  const FinishedRun sweep = finished_run("SWEEP", "sweep", request.arguments.at(0));
  const FinishedRun optimize = finished_run("OPTIMIZE", "optimize", request.arguments.at(1));
  require_comparable(sweep, optimize);
  Request compared = request;
  compared.configuration = comparison_configuration(request.configuration, sweep, optimize);
  const Configuration& configuration = compared.configuration;
  const Setup setup(configuration);
  const Telescope& telescope = setup.telescope;
  const Seeing& seeing = setup.seeing();
  const FreshScreens fresh(configuration);
  DesignTrial trial =
      verification_trial_of(setup, fresh, cost_of(configuration, pixels_vary(sweep, optimize)));
  trial.run_on(request.runner);
  for (const FinishedRun* run : {&sweep, &optimize}) (void)trial.checked(run->best);
  RunRecord record(compared);

  TriedDesign swept;
  TriedDesign found;
  {
    Progress progress = verification_progress(trial, 2);
    swept = verified_design(sweep.best, trial, record, interruptible(progress));
    found = verified_design(optimize.best, trial, record, interruptible(progress));
  }
  const std::size_t screens = std::min(swept.costs.size(), found.costs.size());
  swept = trial.on_first_screens(std::move(swept), screens);
  found = trial.on_first_screens(std::move(found), screens);
  record.note_missing_screens(found, trial);
  const Improvement gain = improvement(found, swept);
  const Json ratios = effort_ratios(sweep, optimize);
  try {
    if (const auto reason =
            write_path_picture(sweep, optimize, telescope, seeing, record.folder())) {
      fmt::print("note: there is no path.svg: {}\n", *reason);
    }
  } catch (const std::exception& error) {
    fmt::print("note: there is no path.svg: {}\n", error.what());
  }
  record.write_summary(
      {{"sweep", to_json(swept, trial)},
       {"optimize", to_json(found, trial)},
       {"difference", to_json(MeanAndError{-gain.cost.mean, gain.cost.standard_error})},
       {"verdict", word_of(gain.verdict)},
       {"cost",
        {{"sweep", sweep.effort}, {"optimize", optimize.effort}, {"sweep_per_optimize", ratios}}}});

  fmt::print("{}\n\n", telescope_line(telescope, seeing));
  print_designs({sweep, swept}, {optimize, found}, trial, telescope, seeing, fresh.seed);
  fmt::print("\n{}\n\n", verdict_text(gain, mean_and_standard_error(swept.costs).mean));
  print_efforts(sweep, optimize, ratios);
  record.close();
}

std::string of_compare(const Json& summary) {
  const MeanAndError difference = mean_from_json(summary.at("difference"));
  const auto verdict = summary.at("verdict").get<std::string>();
  const std::string costs =
      fmt::format("the optimizer's design costs {} {} than the sweep's, screen by screen",
                  with_error({std::abs(difference.mean), difference.standard_error}),
                  difference.mean < 0.0 ? "less" : "more");
  return verdict == word_of(Verdict::indistinguishable)
             ? fmt::format("The two designs cannot be told apart: {}.", costs)
             : fmt::format("The optimizer's design is {}: {}.", verdict, costs);
}

}  // namespace

Command compare_command() {
  return {
      .name = "compare",
      .group = "The best design",
      .description =
          "hold a search against a sweep: both best designs on fresh screens, and what each cost",
      .about =
          "Takes the folders of a sweep and of a search for the same telescope, simulates the "
          "best design of each on screens that neither has seen, and gives the paired "
          "difference of their costs.",
      .keys = keys::fresh_screens,
      .examples = {"nlcwfs compare results/sweep-1 results/optimize-1"},
      .run = run_compare,
      .arguments = {{"SWEEP"}, {"OPTIMIZE"}},
      .files = {{"path.svg", FileRole::picture}, {"path.png"}},
      .verdict = of_compare};
}

}  // namespace nlcwfs
