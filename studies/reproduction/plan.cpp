#include "studies/reproduction/plan.hpp"

#include "model/input_error.hpp"
#include "model/telescope.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <iterator>
#include <numeric>
#include <set>

#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr double km = 1e3;
/// Of the paper's maps and its fifth plane.
constexpr double farthest = 250 * km;
constexpr std::string_view source = "by reproduce";

/// Sets what has its default value: a run's own configuration file, which names every key, asks for
/// the same again.
void set_defaults(Configuration& configuration,
                  const std::vector<std::pair<std::string, std::string>>& values) {
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

/// The paper's planes in one of the two set-ups.
Configuration base_of(const Configuration& given, StudySetup setup) {
  Configuration configuration = given;
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
  configuration.set("sensor.planes",
                    fmt::format("{}", fmt::join(Configuration().lengths("baseline.planes"), ",")),
                    source);
  // Nothing is chosen: the report looks at whole maps, on their own screens.
  set_defaults(configuration, {{"verify.candidates", "1"}, {"verify.screens", "2"}});
  return configuration;
}

class Plan {
 public:
  explicit Plan(const Configuration& given) : given_(given) {}

  /// Adds a run unless it is there already.
  void add(const std::string& folder, const std::string& command, Configuration configuration,
           const std::vector<std::pair<std::string, std::string>>& values) {
    if (!folders_.insert(folder).second) return;
    for (const auto& [key, value] : values) configuration.set(key, value, source);
    runs_.push_back({folder, command, std::move(configuration)});
  }

  Configuration base(StudySetup setup) const { return base_of(given_, setup); }

  /// min:max:count of a map's axes.
  std::string map_axis() const {
    const int count = given_.integer("reproduce.grid");
    return fmt::format("{}:{}:{}", farthest / count, farthest, count);
  }

  std::vector<PlannedRun> runs() && { return std::move(runs_); }

  const Configuration& given() const { return given_; }

 private:
  const Configuration& given_;
  std::set<std::string> folders_;
  std::vector<PlannedRun> runs_;
};

void add_map(Plan& plan, StudySetup setup, int ratio, const std::string& order,
             const std::string& folder) {
  plan.add(folder, "sweep", plan.base(setup),
           {{"seeing.d_over_r0", fmt::format("{}", ratio)},
            {"sweep.z_near", plan.map_axis()},
            {"sweep.z_far", plan.map_axis()},
            {"sweep.plane_count", fmt::format("{}", order.size())},
            {"sweep.order", order},
            {"sweep.crossed_pairs", "left_out"}});
}

void add_four_plane_map(Plan& plan, StudySetup setup, int ratio) {
  add_map(plan, setup, ratio, "1234", fmt::format("figure-3/{}-{}", to_string(setup), ratio));
}

/// The paper's planes, or others at its distances, one for one.
void add_design(Plan& plan, StudySetup setup, const std::string& name,
                const std::vector<std::size_t>& papers_places) {
  Configuration configuration = plan.base(setup);
  const std::vector<double> papers = configuration.lengths("sensor.planes");
  std::vector<double> planes;
  for (const std::size_t place : papers_places) planes.push_back(papers[place]);
  plan.add(
      fmt::format("designs/{}-{}", to_string(setup), name), "evaluate", std::move(configuration),
      {{"sensor.planes", fmt::format("{}", fmt::join(planes, ","))},
       {"screens.count", fmt::format("{}", more_screens * plan.given().integer("screens.count"))}});
}

void add_four_planes(Plan& plan, StudySetup setup) {
  add_design(plan, setup, "four-planes", {0, 1, 2, 3});
}

/// The planes of figure 5: between the paper's last and the pupil, and on both of these.
std::string fifth_planes(int half_count) {
  std::vector<double> planes;
  for (int i = -half_count; i <= half_count; ++i) planes.push_back(farthest * i / half_count);
  const auto after = std::ranges::lower_bound(planes, 180 * km);
  if (*after != 180 * km) planes.insert(after, 180 * km);
  return fmt::format("{}", fmt::join(planes, ","));
}

void add_fifth_plane(Plan& plan, StudySetup setup) {
  Configuration configuration = plan.base(setup);
  const std::vector<double> planes = configuration.lengths("sensor.planes");
  std::vector<std::pair<std::string, std::string>> values{
      {"sweep.layout", "free"}, {"sweep.z5", fifth_planes(plan.given().integer("reproduce.grid"))}};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    values.emplace_back(fmt::format("sweep.z{}", i + 1), fmt::format("{}", planes[i]));
  }
  plan.add(fmt::format("figure-5/{}", to_string(setup)), "sweep", std::move(configuration), values);
}

/// The near pair at the Talbot distance of r0, as the paper finds best.
void add_sampling(Plan& plan, StudySetup setup, int ratio) {
  const Telescope telescope;
  const double near = talbot_distance(telescope.diameter / ratio, telescope.wavelength);
  plan.add(fmt::format("figure-6/{}-{}", to_string(setup), ratio), "sweep", plan.base(setup),
           {{"seeing.d_over_r0", fmt::format("{}", ratio)},
            {"sensor.planes", fmt::format("{0},{1},-180km,180km", -near, near)},
            {"simulation.truth", setup == StudySetup::paper ? "periodic" : "extended"},
            {"simulation.pupil_samples", "128"},
            {"detector.pupil_pixels", "128"},
            {"verify.truth_factor", "1"},
            {"sweep.pupil_pixels", "128,64,32,16,8"}});
}

void add_broadband(Plan& plan, StudySetup setup, const PaperBand& band) {
  std::vector<std::pair<std::string, std::string>> values{{"seeing.d_over_r0", "6"},
                                                          {"detector.pupil_pixels", "128"}};
  if (!band.bands.empty()) {
    values.emplace_back("source.bands", band.bands);
    values.emplace_back("source.wavelengths", fmt::format("{}", band.wavelengths));
  }
  plan.add(fmt::format("figure-8/{}-{}", to_string(setup), band.name), "convergence",
           plan.base(setup), values);
}

/// The paper's design at another telescope, at its Fresnel numbers and with its tolerance in waves.
void add_scaled(Plan& plan, StudySetup setup, const NamedSettings& settings) {
  Configuration configuration = plan.base(setup);
  const Telescope from = telescope_of(configuration);
  for (const auto& [key, value] : settings.settings) configuration.set(key, value, source);
  const Telescope to = telescope_of(configuration);
  std::vector<double> planes = configuration.lengths("sensor.planes");
  for (double& plane : planes) plane = scaled_distance(plane, from, to);
  const double tolerance =
      configuration.length("reconstruction.tolerance") * to.wavelength / from.wavelength;
  plan.add(fmt::format("scaling/{}-{}", to_string(setup), settings.name), "evaluate",
           std::move(configuration),
           {{"sensor.planes", fmt::format("{}", fmt::join(planes, ","))},
            {"reconstruction.tolerance", fmt::format("{}", tolerance)}});
}

/// Of the paper's planes, without noise and with photons, and of pairs of planes.
void add_responses(Plan& plan) {
  const Configuration base = plan.base(StudySetup::extended);
  plan.add("response/noise-free", "response", base, {{"response.distances", "5km:205km:21"}});
  plan.add("response/photons", "response", base, {{"detector.photons", "1e6"}});
}

void add_figure_3(Plan& plan, StudySetup setup) {
  for (const int ratio : map_ratios) add_four_plane_map(plan, setup, ratio);
  add_four_planes(plan, setup);
  add_design(plan, setup, "pairs-exchanged", {2, 3, 0, 1});
}

void add_figure_4(Plan& plan, StudySetup setup) {
  add_four_plane_map(plan, setup, 4);
  add_map(plan, setup, 4, "124", fmt::format("figure-4/{}-without-p3", to_string(setup)));
  add_map(plan, setup, 4, "234", fmt::format("figure-4/{}-without-p1", to_string(setup)));
  // One after the other, so that their times compare.
  add_four_planes(plan, setup);
  add_design(plan, setup, "without-p3", {0, 1, 3});
  add_design(plan, setup, "without-p1", {1, 2, 3});
}

/// The figures whose runs are made in either setup.
void add_figures(Plan& plan, StudySetup setup, const std::predicate<std::string_view> auto& wants) {
  if (wants("3")) add_figure_3(plan, setup);
  if (wants("4")) add_figure_4(plan, setup);
  if (wants("5")) {
    add_fifth_plane(plan, setup);
    add_four_planes(plan, setup);
  }
  if (wants("6")) {
    for (const int ratio : sampling_ratios) add_sampling(plan, setup, ratio);
  }
  for (const PaperBand& band : paper_bands) {
    if (wants("8") || (wants("7") && band.name == "medium")) add_broadband(plan, setup, band);
  }
  for (const NamedSettings& telescope : scaled_telescopes()) {
    if (wants("scaling")) add_scaled(plan, setup, telescope);
  }
}

void add_numerics(Plan& plan, int screens) {
  for (const NamedSettings& variant : numerical_variants(screens)) {
    for (const NamedSettings& probe : numerical_probes()) {
      auto settings = variant.settings;
      settings.insert(settings.end(), probe.settings.begin(), probe.settings.end());
      plan.add(fmt::format("numerics/{}/{}", variant.name, probe.name),
               probe.name == "medium-band" ? "convergence" : "evaluate",
               plan.base(StudySetup::paper), settings);
    }
  }
}

}  // namespace

std::string_view to_string(StudySetup setup) {
  return setup == StudySetup::paper ? "paper" : "extended";
}

const std::vector<NamedSettings>& scaled_telescopes() {
  static const std::vector<NamedSettings> telescopes{
      {"0.5m-532nm", {}},
      {"1.2m-532nm", {{"telescope.diameter", "1.2m"}}},
      {"0.5m-850nm", {{"telescope.wavelength", "850nm"}}},
      {"8.2m-1650nm", {{"telescope.diameter", "8.2m"}, {"telescope.wavelength", "1650nm"}}}};
  return telescopes;
}

std::vector<NamedSettings> numerical_variants(int screens) {
  return {
      {"as-the-paper", {}},
      {"window-2", {{"reconstruction.window", "2"}}},
      {"window-8", {{"reconstruction.window", "8"}}},
      {"window-16", {{"reconstruction.window", "16"}}},
      {"stopping-difference", {{"reconstruction.stopping", "difference"}}},
      {"unwrapping-quality-guided", {{"reconstruction.unwrapping", "quality_guided"}}},
      {"truth-periodic-128",
       {{"simulation.truth", "periodic"}, {"simulation.pupil_samples", "128"}}},
      {"truth-periodic-256",
       {{"simulation.truth", "periodic"}, {"simulation.pupil_samples", "256"}}},
      {"truth-extended-64", {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "64"}}},
      {"truth-extended-128",
       {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "128"}}},
      {"truth-extended-256",
       {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "256"}}},
      {"truth-extended-128-difference",
       {{"simulation.truth", "extended"},
        {"simulation.pupil_samples", "128"},
        {"reconstruction.stopping", "difference"}}},
      {"screens-times-4", {{"screens.count", fmt::format("{}", 4 * screens)}}},
      {"screens-times-16", {{"screens.count", fmt::format("{}", 16 * screens)}}}};
}

const std::vector<NamedSettings>& numerical_probes() {
  static const std::vector<NamedSettings> probes{
      {"four-planes-4", {}},
      {"four-planes-6", {{"seeing.d_over_r0", "6"}}},
      {"four-planes-8", {{"seeing.d_over_r0", "8"}}},
      {"without-p3", {{"sensor.planes", "-47km,47km,180km"}}},
      {"without-p1", {{"sensor.planes", "47km,-180km,180km"}}},
      {"fifth-plane", {{"sensor.planes", "-47km,47km,-180km,180km,100km"}}},
      {"four-pixels",
       {{"seeing.d_over_r0", "8"},
        {"sensor.planes", "-14.7km,14.7km,-180km,180km"},
        {"detector.pupil_pixels", "32"}}},
      {"medium-band",
       {{"seeing.d_over_r0", "6"},
        {"source.bands", std::string(paper_bands[2].bands)},
        {"source.wavelengths", fmt::format("{}", paper_bands[2].wavelengths)}}}};
  return probes;
}

std::vector<std::string> figures_of(const Configuration& configuration) {
  const std::string& text = configuration.text("reproduce.figures");
  std::vector<std::string> figures;
  boost::split(figures, text, [](char c) { return c == ','; });
  for (std::string& figure : figures) {
    figure = std::string(trimmed(figure));
    if (std::ranges::count(reproduced_figures, figure) == 0) {
      throw InputError("reproduce.figures", one_line(text),
                       fmt::format("a list of {}", fmt::join(reproduced_figures, ", ")));
    }
  }
  for (const std::string& figure : figures) {
    if (std::ranges::count(figures, figure) > 1) {
      throw InputError("reproduce.figures", one_line(text),
                       fmt::format("each value once, but {} is twice", figure));
    }
  }
  return figures;
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

std::vector<PlannedRun> planned_runs(const Configuration& configuration) {
  require_papers_case(configuration);
  const std::vector<std::string> figures = figures_of(configuration);
  const auto wants = [&](std::string_view figure) {
    return std::ranges::count(figures, figure) > 0;
  };
  Plan plan(configuration);
  for (const StudySetup setup : setups) add_figures(plan, setup, wants);
  if (wants("response")) add_responses(plan);
  if (wants("numerics")) add_numerics(plan, configuration.integer("screens.count"));
  return std::move(plan).runs();
}

}  // namespace nlcwfs
