#include "studies/reproduction/plan.hpp"

#include "model/input_error.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr std::string_view source = "by reproduce";

/// Sets what has its default value: a run's own configuration file, which names every key, asks for
/// the same again.
void set_defaults(Configuration& configuration, const Settings& values) {
  const Configuration defaults;
  for (const auto& [key, value] : values) {
    if (configuration.value_text(key) == defaults.value_text(key)) {
      configuration.set(key, value, source);
    }
  }
}

/// Refuses what would make it another study than the paper's.
void require_papers_case(const Configuration& configuration) {
  const Configuration defaults;
  Configuration preset;
  preset.apply_preset("paper");
  for (const ConfigurationKey& key : configuration_keys()) {
    const std::string section = key.name.substr(0, key.name.find('.'));
    const bool is_papers = section == "telescope" || section == "seeing" || section == "sensor" ||
                           section == "source" || section == "sweep";
    if (!is_papers || !configuration.is_set(key.name)) continue;
    const std::string& value = configuration.value_text(key.name);
    if (value == defaults.value_text(key.name) || value == preset.value_text(key.name)) continue;
    throw InputError(key.name, one_line(value),
                     "reproduce takes the paper's own; leave it away, or run evaluate, sweep, "
                     "convergence and response on it");
  }
}

}  // namespace

std::string list_text(const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, ","));
}

Plan::Plan(const Configuration& given, std::vector<std::string> figures)
    : given_(given), figures_(std::move(figures)) {
  require_papers_case(given);
}

bool Plan::has(std::string_view figure) const { return std::ranges::count(figures_, figure) > 0; }

Configuration Plan::base(StudySetup setup) const {
  Configuration configuration = given_;
  configuration.set("reproduce.figures", Configuration().text("reproduce.figures"), source);
  if (setup == StudySetup::paper) {
    const auto paper = std::ranges::find(presets(), "paper", &Preset::name);
    set_defaults(configuration, paper->values);
  }
  // What makes it this set-up, whatever is given.
  const bool is_paper = setup == StudySetup::paper;
  configuration.set("simulation.truth", is_paper ? "matched" : "extended", source);
  configuration.set("reconstruction.stopping", is_paper ? "rms_change" : "difference", source);
  configuration.set("source.aberration", is_paper ? "phase" : "path", source);
  configuration.set("seeing.d_over_r0", "4", source);
  configuration.set("sensor.planes", list_text(Configuration().lengths("baseline.planes")), source);
  // Nothing is chosen: the report looks at whole maps, on their own screens.
  set_defaults(configuration, {{"verify.candidates", "1"}, {"verify.screens", "2"}});
  return configuration;
}

void Plan::add(const std::string& folder, const std::string& command, Configuration configuration,
               const Settings& values) {
  if (!folders_.insert(folder).second) return;
  for (const auto& [key, value] : values) configuration.set(key, value, source);
  runs_.push_back({folder, command, std::move(configuration)});
}

void Plan::add_map(const std::string& folder, StudySetup setup, int ratio,
                   const std::string& order) {
  const int count = given_.integer("reproduce.grid");
  const std::string axis = fmt::format("{}:{}:{}", farthest / count, farthest, count);
  add(folder, "sweep", base(setup),
      {{"seeing.d_over_r0", fmt::format("{}", ratio)},
       {"sweep.z_near", axis},
       {"sweep.z_far", axis},
       {"sweep.plane_count", fmt::format("{}", order.size())},
       {"sweep.order", order},
       {"sweep.crossed_pairs", "left_out"}});
}

void Plan::add_plane_count_maps(StudySetup setup) {
  add_map(run_folder("figure-3", setup, "4"), setup, 4, "1234");
  add_map(run_folder("figure-4", setup, "without-p3"), setup, 4, "124");
  add_map(run_folder("figure-4", setup, "without-p1"), setup, 4, "234");
}

void Plan::add_design(StudySetup setup, std::string_view name,
                      const std::vector<std::size_t>& papers_places) {
  Configuration configuration = base(setup);
  const std::vector<double> papers = configuration.lengths("sensor.planes");
  std::vector<double> planes;
  for (const std::size_t place : papers_places) planes.push_back(papers[place]);
  add(run_folder("designs", setup, name), "evaluate", std::move(configuration),
      {{"sensor.planes", list_text(planes)},
       {"screens.count", fmt::format("{}", more_screens * given_.integer("screens.count"))}});
}

double work_of(const PlannedRun& run) {
  const Configuration& configuration = run.configuration;
  const auto size_of = [&](std::string_view key, double otherwise) {
    const auto axis = configuration.axis(key);
    return axis ? double(axis->size()) : otherwise;
  };
  const bool is_followed = run.command == "convergence";
  const double loops = is_followed ? configuration.integer("reconstruction.max_loops") : 8.0;
  double designs = 1.0;
  if (run.command == "response") {
    const bool is_noisy = configuration.numbers("detector.photons").front() > 0.0;
    designs = size_of("response.frequencies", 16.0) * (1.0 + size_of("response.distances", 0.0)) *
              (is_noisy ? 2.0 : 1.0);
  }
  // Of each pixel across the pupil, squared.
  double pixels = std::pow(configuration.integer("detector.pupil_pixels"), 2);
  for (const ConfigurationKey& key : configuration_keys()) {
    if (run.command != "sweep" || !key.name.starts_with("sweep.")) continue;
    if (key.kind != Kind::axis || !configuration.is_set(key.name)) continue;
    const std::vector<double> values = *configuration.axis(key.name);
    if (key.name == "sweep.pupil_pixels") {
      pixels = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    } else {
      designs *= double(values.size());
    }
  }
  const double grid = std::pow(configuration.number("reconstruction.window"), 2) * pixels;
  // The pupil's light on a detector, along each axis; a matched truth has the grid's own.
  const double truth = configuration.choice("simulation.truth") == "matched"
                           ? grid
                           : std::pow((configuration.number("detector.window") + 1.0) *
                                          configuration.integer("simulation.pupil_samples"),
                                      2);
  const auto planes = double(configuration.lengths("sensor.planes").size());
  const double wavelengths =
      configuration.is_set("source.bands") ? configuration.integer("source.wavelengths") : 1.0;
  return 1e-9 * designs * configuration.integer("screens.count") * planes *
         (2.0 * loops * grid + 2.0 * wavelengths * truth);
}

}  // namespace nlcwfs
