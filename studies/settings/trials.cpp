// Screens are drawn or read, and trials made of them.
#include "studies/settings/trials.hpp"

#include "model/grid_width.hpp"
#include "model/image_gaps.hpp"
#include "model/input_error.hpp"
#include "model/pupil.hpp"
#include "model/screen_resampling.hpp"
#include "model/turbulence_screen.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/text/quantity_text.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::vector<PhaseScreen> simulated_screens(const Telescope& telescope, const Seeing& seeing,
                                           int samples, int count, std::uint64_t seed,
                                           const std::function<bool(int)>& watch = {}) {
  return generate_screens(TurbulenceScreenGenerator(seeing, samples, telescope.diameter, seed),
                          count, watch);
}

std::vector<PhaseScreen> screens_from_file(const std::string& file, const Telescope& telescope,
                                           int samples, std::vector<std::string>& notes) {
  FitsCube cube = read_fits_cube(file, "screens.file", FitsGaps::allowed);
  if (cube.diameter && !is_same_length(*cube.diameter, telescope.diameter)) {
    throw InputError("screens.file", file,
                     fmt::format("its DIAMETER is {}, and telescope.diameter {}",
                                 format_length(*cube.diameter), format_length(telescope.diameter)),
                     "set that, or take the keyword out of the file");
  }
  double radians_per_unit = 1.0;
  if (cube.unit == "m") {
    radians_per_unit = 2.0 * std::numbers::pi / telescope.wavelength;
  } else if (cube.unit.empty() || cube.unit == "rad") {
    if (cube.wavelength && !is_same_length(*cube.wavelength, telescope.wavelength)) {
      radians_per_unit = *cube.wavelength / telescope.wavelength;
      notes.push_back(
          fmt::format("{}: its radians are at WAVELEN = {}; the same optical path has "
                      "{:.4g} times as many at {}",
                      file, format_length(*cube.wavelength), radians_per_unit,
                      format_length(telescope.wavelength)));
    }
  } else {
    throw InputError("screens.file", file,
                     fmt::format("BUNIT must be 'rad' or 'm', but is '{}'", cube.unit));
  }
  const auto size = static_cast<int>(cube.slices.front().rows());
  if (size < 2) throw InputError("screens.file", file, "at least 2 x 2 samples");
  require_memory("screens.file", file, double(cube.slices.size()), samples);
  if (size != samples) {
    notes.push_back(fmt::format("{}: {} x {} samples were resampled to the truth's {} x {}", file,
                                size, size, samples, samples));
  }
  const PupilMask pupil = pupil_mask(size, telescope.central_obscuration);
  for (Image<double>& screen : cube.slices) {
    if (!(screen.isFinite() || (screen.isNaN() && !pupil)).all()) {
      throw InputError("screens.file", file,
                       "has values that are not finite; only outside the pupil may there be none");
    }
    // Continued beyond the pupil, so that what is resampled at its edge comes from within.
    screen = with_gaps_filled(screen) * radians_per_unit;
    if (size != samples) screen = resampled_screen(screen, samples);
  }
  return std::move(cube.slices);
}

/// "D/r0 = 4, 100000 photons"
std::string condition_name(const Telescope& telescope, const Seeing& seeing,
                           const Detector& detector) {
  std::string name = fmt::format("D/r0 = {:.4g}", telescope.diameter / seeing.fried_parameter);
  if (detector.photon_rate > 0.0) {
    name += fmt::format(", {:g} photons/s", detector.photon_rate);
  } else if (detector.photons > 0.0) {
    name += fmt::format(", {:g} photons", detector.photons);
  }
  return name;
}

/// Each seeing, with each light.
/// @param screens_in  makes the screens of a seeing
template <class ScreensIn>
std::vector<Condition> conditions_of(const Setup& setup, const SimulationOptions& options,
                                     const ScreensIn& screens_in) {
  std::vector<Condition> conditions;
  for (const Seeing& seeing : setup.seeings) {
    const auto simulation =
        std::make_shared<const Simulation>(setup.telescope, screens_in(seeing), options);
    for (const std::optional<double> light : setup.lights) {
      Condition condition{.name = {},
                          .simulation = simulation,
                          .light = light,
                          .fried_parameter = seeing.fried_parameter};
      condition.name =
          condition_name(setup.telescope, seeing, condition.lit(setup.design).detector);
      conditions.push_back(std::move(condition));
    }
  }
  return conditions;
}

/// @param key  that asks for so many screens, for the error where they take too much memory
DesignTrial trial_on_fresh_screens(const Setup& setup, SimulationOptions options, int samples,
                                   std::string_view key, int count, std::uint64_t seed,
                                   DesignCost cost) {
  require_memory(key, std::to_string(count), double(setup.seeings.size()) * count, samples);
  options.noise_seed = seed;
  DesignTrial trial(conditions_of(setup, options,
                                  [&](const Seeing& seeing) {
                                    return simulated_screens(setup.telescope, seeing, samples,
                                                             count, seed);
                                  }),
                    std::move(cost));
  trial.keeps_failures = false;
  return trial;
}

constexpr int least_scanned_screens = 8;

/// See DesignTrial::spec: how the trial is made, and every value that is set.
std::string spec_of(std::string_view kind, Precision precision, const Setup& setup) {
  return fmt::format("{} {}\n{}", kind, static_cast<int>(precision), setup.values);
}

}  // namespace

bool is_same_length(double a, double b) { return std::abs(a - b) <= 1e-6 * b; }

ScreenSource::ScreenSource(const Configuration& configuration)
    : file(configuration.text("screens.file")),
      count(configuration.integer("screens.count")),
      seed(configuration.seed("screens.seed")) {}

FreshScreens::FreshScreens(const Configuration& configuration)
    // By default four times the search's, so that the verification adds little noise of its own.
    : count(configuration.is_set("verify.screens")
                ? configuration.integer("verify.screens")
                : std::max(64, 4 * configuration.integer("screens.count"))),
      seed(configuration.seed("verify.seed")),
      truth_factor(configuration.integer("verify.truth_factor")) {
  if (seed == configuration.seed("screens.seed")) {
    throw InputError("verify.seed", seed,
                     "another seed than screens.seed, or the screens would not be fresh");
  }
}

void require_memory(std::string_view key, const std::string& value, double count, int samples) {
  const double bytes_per_screen = double(samples) * samples * sizeof(double);
  if (count * bytes_per_screen <= max_image_memory) return;
  throw InputError(
      key, value,
      fmt::format(
          "{:.0f} screens of {} x {} samples take {:.3g} GiB of memory; at most {:.0f} of them "
          "fit into the {:g} GiB allowed",
          count, samples, samples, count * bytes_per_screen / std::exp2(30),
          std::floor(max_image_memory / bytes_per_screen), max_image_memory / std::exp2(30)));
}

std::vector<PhaseScreen> screens_of(const ScreenSource& source, const Telescope& telescope,
                                    const Seeing& seeing, int samples,
                                    std::vector<std::string>& notes, int most,
                                    const std::function<bool(int)>& watch) {
  if (!source.file.empty()) return screens_from_file(source.file, telescope, samples, notes);
  require_memory("screens.count", std::to_string(source.count), source.count, samples);
  return simulated_screens(telescope, seeing, samples, std::min(source.count, most), source.seed,
                           watch);
}

DesignTrial trial_of(Setup& setup, const ScreenSource& source, Precision precision,
                     DesignCost cost) {
  // Before the screens, which may take long.
  (void)setup.simulated();
  if (!source.file.empty() && setup.seeings.size() > 1) {
    throw InputError("screens.file", source.file, "its screens have one seeing",
                     "give one value of the section seeing");
  }
  if (source.file.empty()) {
    require_memory("screens.count", std::to_string(source.count),
                   double(setup.seeings.size()) * source.count, setup.samples);
  }
  SimulationOptions options = setup.options;
  options.precision = precision;
  DesignTrial trial(conditions_of(setup, options,
                                  [&](const Seeing& seeing) {
                                    return screens_of(source, setup.telescope, seeing,
                                                      setup.samples, setup.notes);
                                  }),
                    std::move(cost));
  trial.spec =
      spec_of("search", precision, setup) + fmt::format("screens.count {}\n", source.count);
  return trial;
}

DesignTrial fresh_trial_of(const Setup& setup, const FreshScreens& fresh, int count,
                           Precision precision, DesignCost cost) {
  SimulationOptions options = setup.options;
  options.precision = precision;
  DesignTrial trial = trial_on_fresh_screens(setup, options, setup.samples, "screens.count", count,
                                             fresh.seed, std::move(cost));
  trial.spec = spec_of("fresh", precision, setup);
  return trial;
}

DesignTrial verification_trial_of(const Setup& setup, const FreshScreens& fresh, DesignCost cost) {
  SimulationOptions options = setup.options;
  options.precision = Precision::double_precision;
  if (fresh.truth_factor > 1) options.truth = TruthModel::extended;
  const double window = setup.options.truth == TruthModel::extended
                            ? setup.design.detector.window
                            : setup.design.reconstruction.window;
  const double search_width = window * setup.samples;
  if (fresh.truth_factor * search_width > max_grid_width) {
    throw InputError(
        "verify.truth_factor", fresh.truth_factor,
        fmt::format("at most {:g}: the search's true field is {:g} samples wide, and "
                    "at most {} are allowed",
                    std::floor(max_grid_width / search_width), search_width, max_grid_width));
  }
  DesignTrial trial =
      trial_on_fresh_screens(setup, options, setup.samples * fresh.truth_factor, "verify.screens",
                             fresh.count, fresh.seed, std::move(cost));
  trial.spec = spec_of("verification", options.precision, setup);
  return trial;
}

TrialSetup::TrialSetup(const Configuration& configuration)
    : Setup(configuration),
      screen_source(configuration),
      fresh(configuration),
      search_precision(precision_of(configuration, "search.precision")),
      cost_if_varying(cost_of(configuration, true)),
      cost_if_not(cost_of(configuration, false)) {}

DesignTrial TrialSetup::make_trial(bool pixels_vary) {
  return trial_of(*this, screen_source, search_precision, cost(pixels_vary));
}

DesignTrial TrialSetup::make_scan(bool pixels_vary) const {
  return fresh_trial_of(*this, fresh, std::max(least_scanned_screens, screen_source.count),
                        search_precision, cost(pixels_vary));
}

DesignTrial TrialSetup::make_verification(bool pixels_vary) {
  if (!screen_source.file.empty()) {
    notes.emplace_back("the verification is on simulated screens of the configured seeing");
  }
  return verification_trial_of(*this, fresh, cost(pixels_vary));
}

DesignTrial trial_from_spec(const std::string& spec) {
  std::istringstream lines(spec);
  std::string kind;
  int precision = 0;
  lines >> kind >> precision;
  Configuration configuration;
  std::string key;
  for (std::string value; lines >> key && std::getline(lines >> std::ws, value);) {
    configuration.set(key, value, "in a trial's specification");
  }
  TrialSetup setup(configuration);
  setup.search_precision = static_cast<Precision>(precision);
  if (kind == "search") return setup.make_trial(false);
  if (kind == "fresh") return setup.make_scan(false);
  return setup.make_verification(false);
}

}  // namespace nlcwfs
