// A configuration becomes the types of the physics.
#include "studies/settings/setup.hpp"

#include "model/input_error.hpp"
#include "model/words.hpp"
#include "objectives/design_field.hpp"
#include "studies/settings/metric_text.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// A choice's value.
template <class Value>
Value choice_of(const Configuration& configuration, std::string_view key) {
  return value_of_word<Value>(configuration.choice(key)).value();
}

/// A list of whole numbers, or all of a range.
std::vector<int> whole_numbers(const Domain& domain) {
  std::vector<int> numbers;
  if (const auto* list = std::get_if<std::vector<double>>(&domain)) {
    for (const double value : *list) {
      numbers.push_back(static_cast<int>(value));
    }
  } else {
    const auto& range = std::get<ValueRange>(domain);
    for (auto number = static_cast<int>(range.lower); number <= range.upper; ++number) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

/// The value of a design's field; of several lights the first.
double configured(const Configuration& configuration, const DesignField& field) {
  const std::string_view key = field.key;
  if (!field.words.empty()) {
    const auto word = std::ranges::find(field.words, configuration.choice(key));
    return double(word - field.words.begin());
  }
  if (field.kind == VariableKind::integer) return configuration.integer(key);
  switch (key_named(key).kind) {
    case Kind::number_list:
      return configuration.numbers(key).front();
    case Kind::length:
      return configuration.length(key);
    case Kind::time:
      return configuration.optional_time(key).value_or(0.0);
    case Kind::ramp: {
      const auto [start, end] = configuration.ramp(key);
      return field.variable == "relaxation_end" ? end : start;
    }
    default:
      return configuration.number(key);
  }
}

bool is_matched(const Configuration& configuration) {
  return choice_of<TruthModel>(configuration, "simulation.truth") == TruthModel::matched;
}

/// What replaces the design's light; nothing where there is one light alone.
std::vector<std::optional<double>> lights_of(const Configuration& configuration) {
  const std::vector<double> photons = configuration.numbers("detector.photons");
  const std::vector<double> rates = configuration.numbers("detector.photon_rate");
  if (photons.size() == 1 && rates.size() == 1) return {std::nullopt};
  if (photons.size() > 1 && configuration.value_text("detector.photon_rate") != "0") {
    throw InputError("detector.photon_rate", configuration.value_text("detector.photon_rate"),
                     fmt::format("set only one of it and detector.photons, which is {}",
                                 configuration.value_text("detector.photons")));
  }
  if (std::ranges::count(rates, 0.0) > 0 && rates.size() > 1) {
    throw InputError("detector.photon_rate", configuration.value_text("detector.photon_rate"),
                     "several lights must all be above 0");
  }
  const std::vector<double>& lights = photons.size() > 1 ? photons : rates;
  return {lights.begin(), lights.end()};
}

/// At D/r0 = 0.1 a wavefront has a fortieth of a wave RMS (Noll): below, a unit was forgotten.
void require_turbulence(const Configuration& configuration, double d_over_r0) {
  constexpr double least = 0.1;
  constexpr double greatest = 1e4;
  // A ratio has no unit, and bounds of its own.
  if (configuration.is_set("seeing.d_over_r0")) return;
  if (d_over_r0 >= least && d_over_r0 <= greatest) return;
  for (const auto& [key, unit] : {std::pair("seeing.fwhm", "; it is in arcsec"),
                                  std::pair("seeing.fried_parameter", "; r0 has its unit: 12cm")}) {
    if (!configuration.is_set(key)) continue;
    throw InputError(key, configuration.value_text(key),
                     fmt::format("a D/r0 from {:g} to {:g}, this is {:.2g}{}", least, greatest,
                                 d_over_r0, unit));
  }
}

/// Refuses what needs the servo lag where nothing says how fast the turbulence is.
void require_wind(const Configuration& configuration,
                  std::initializer_list<std::string_view> keys) {
  if (configuration.is_set("objective.wind_speed") ||
      configuration.is_set("objective.greenwood_frequency")) {
    return;
  }
  for (const std::string_view key : keys) {
    const std::string& text = configuration.value_text(key);
    if (text.find("error_budget") == std::string::npos &&
        text.find("servo_wfe") == std::string::npos) {
      continue;
    }
    throw InputError(key, text,
                     "needs objective.wind_speed or objective.greenwood_frequency, such as "
                     "--objective.wind_speed 10");
  }
}

/// A line for each key that is set.
std::string values_of(const Configuration& configuration) {
  std::string values;
  for (const ConfigurationKey& key : configuration_keys()) {
    const std::string& value = configuration.value_text(key.name);
    if (!value.empty()) values += fmt::format("{} {}\n", key.name, value);
  }
  return values;
}

}  // namespace

Telescope telescope_of(const Configuration& configuration) {
  const Telescope telescope{
      .diameter = configuration.length("telescope.diameter"),
      .wavelength = configuration.length("telescope.wavelength"),
      .central_obscuration = configuration.number("telescope.central_obscuration"),
      .relay_beam_diameter = configuration.optional_length("telescope.relay_beam_diameter")};
  telescope.validate();
  return telescope;
}

void scale_default_planes(Configuration& configuration) {
  const Telescope papers = telescope_of(Configuration());
  const Telescope telescope = telescope_of(configuration);
  if (telescope.diameter == papers.diameter && telescope.wavelength == papers.wavelength) return;
  const std::string by_default = Configuration().source("sensor.planes");
  Configuration preset;
  preset.apply_preset("paper");
  const std::string by_preset = preset.source("sensor.planes");
  for (const char* key : {"sensor.planes", "baseline.planes"}) {
    const std::string& source = configuration.source(key);
    if (source != by_default && source != by_preset) continue;
    std::vector<double> planes = configuration.lengths(key);
    for (double& plane : planes) plane = scaled_distance(plane, papers, telescope);
    configuration.set(key, fmt::format("{}", fmt::join(planes, ",")),
                      source + ", at the paper's Fresnel numbers");
  }
}

void set_trade_defaults(Configuration& configuration) {
  const auto set = [&](std::string_view key, const std::string& value) {
    if (configuration.source(key) == Configuration().source(key)) {
      configuration.set(key, value, "by the command trade");
    }
  };
  const auto is_any_set = [&](std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return configuration.is_set(key); });
  };
  set("search.plane_count", "2:5");
  if (is_any_set({"search.z1", "search.z2", "search.z3", "search.z4", "search.z5", "search.z6"})) {
    set("search.layout", std::string(word_of(Layout::free)));
  }
  set("search.initial_guess", "flat,centroid");
  if (!is_any_set({"search.relaxation_start", "search.relaxation_end"})) {
    set("search.relaxation", "-0.3:0.7");
  }
  // A matched truth shares one grid with detector and reconstruction.
  if (is_matched(configuration)) return;
  set("search.reconstruction_oversampling", "1,2");
  const Setup configured(configuration);
  std::vector<int> suitable;
  for (const int divisor : {4, 2, 1}) {
    Setup setup = configured;
    int& pixels = setup.design.detector.pupil_pixels;
    pixels /= divisor;
    if (pixels * divisor != configured.design.detector.pupil_pixels) continue;
    try {
      (void)setup.simulated();
      suitable.push_back(pixels);
    } catch (const InputError&) {
      // Its windows are no whole numbers of these pixels. Where the configured design itself does
      // not suit, that is said when it is simulated.
      continue;
    }
  }
  if (suitable.size() > 1) set("search.pupil_pixels", fmt::format("{}", fmt::join(suitable, ",")));
}

std::vector<DesignMetric> trade_objectives_of(const Configuration& configuration) {
  const std::string key = "trade.objectives";
  const std::string& text = configuration.text(key);
  std::vector<DesignMetric> objectives = parse_metrics(key, text);
  if (objectives.size() < 2) {
    throw InputError(key, text, "at least two metrics", "for one there is the command optimize");
  }
  for (const DesignMetric& objective : objectives) {
    if (objective.name == "seconds") {
      throw InputError(key, text, "seconds are measured, so the search could not be repeated",
                       "take model_seconds");
    }
  }
  require_wind(configuration, {key});
  return objectives;
}

void require_one_condition(const Configuration& configuration) {
  for (const char* key : {"seeing.d_over_r0", "seeing.fried_parameter", "seeing.fwhm",
                          "detector.photons", "detector.photon_rate"}) {
    const std::string& text = configuration.value_text(key);
    if (text.find(',') == std::string::npos) continue;
    throw InputError(key, text,
                     "one value for this command; several are for those that compare designs");
  }
}

bool is_seeing_given(const Configuration& configuration) {
  const std::string key = "seeing.d_over_r0";  // unset where another measure is given
  return configuration.value_text(key).empty() ||
         configuration.source(key) != Configuration().source(key);
}

std::vector<Seeing> seeings_of(const Configuration& configuration, const Telescope& telescope) {
  std::vector<double> fried_parameters;
  if (configuration.is_set("seeing.d_over_r0")) {
    for (const double ratio : configuration.numbers("seeing.d_over_r0")) {
      fried_parameters.push_back(telescope.diameter / ratio);
    }
  } else {
    const double reference =
        configuration.optional_length("seeing.reference_wavelength").value_or(telescope.wavelength);
    const auto add = [&](double fried_parameter) {
      fried_parameters.push_back(
          scaled_fried_parameter(fried_parameter, reference, telescope.wavelength));
    };
    if (configuration.is_set("seeing.fwhm")) {
      for (const double fwhm : configuration.numbers("seeing.fwhm")) {
        add(fried_parameter_of_fwhm(fwhm, reference));
      }
    } else {
      std::ranges::for_each(configuration.lengths("seeing.fried_parameter"), add);
    }
  }
  std::vector<Seeing> seeings;
  for (const double fried_parameter : fried_parameters) {
    require_turbulence(configuration, telescope.diameter / fried_parameter);
    seeings.push_back({.fried_parameter = fried_parameter,
                       .outer_scale = configuration.optional_length("seeing.outer_scale")});
    seeings.back().validate();
  }
  return seeings;
}

Seeing seeing_of(const Configuration& configuration, const Telescope& telescope) {
  return seeings_of(configuration, telescope).front();
}

SensorDesign design_of(const Configuration& configuration) {
  SensorDesign design;
  design.planes = configuration.lengths("sensor.planes");
  for (const DesignField& field : design_fields()) {
    if (!field.summary.empty()) field.set(design, configured(configuration, field));
  }
  return design;
}

SensorDesign baseline_of(const Configuration& configuration) {
  SensorDesign design = design_of(configuration);
  const auto [relaxation_start, relaxation_end] = configuration.ramp("baseline.relaxation");
  design.planes = configuration.lengths("baseline.planes");
  validate_planes("baseline.planes", design.planes, telescope_of(configuration));
  design.reconstruction.relaxation_start = relaxation_start;
  design.reconstruction.relaxation_end = relaxation_end;
  design.reconstruction.initial_guess =
      choice_of<InitialGuess>(configuration, "baseline.initial_guess");
  return design;
}

DesignCost cost_of(const Configuration& configuration, bool pixels_vary) {
  DesignCost cost{
      .kind = choice_of<CostKind>(configuration, "objective.kind"),
      .wfe = pixels_vary ? WavefrontErrorKind::total : WavefrontErrorKind::residual,
      .wfe_scale = configuration.length("objective.wfe_scale"),
      .loop_weight = configuration.number("objective.loop_weight"),
      .time_weight = configuration.number("objective.time_weight"),
      .terms = parse_terms("objective.terms", configuration.text("objective.terms")),
      .penalties =
          parse_penalties("objective.penalties", configuration.text("objective.penalties")),
      .limits = parse_limits("objective.limits", configuration.text("objective.limits")),
      .operation = {.wavelength = configuration.length("telescope.wavelength"),
                    .fft_rate = configuration.number("objective.fft_rate"),
                    .time_per_loop = configuration.optional_time("objective.time_per_loop"),
                    .readout_time_per_pixel =
                        *configuration.optional_time("objective.readout_time_per_pixel"),
                    .greenwood_frequency =
                        configuration.optional_number("objective.greenwood_frequency"),
                    .wind_speed = configuration.optional_number("objective.wind_speed")},
      .aggregate = {.kind = choice_of<AggregateKind>(configuration, "objective.aggregate"),
                    .level = configuration.number("objective.level")}};
  if (configuration.is_set("objective.wfe")) {
    cost.wfe = choice_of<WavefrontErrorKind>(configuration, "objective.wfe");
  }
  if (cost.operation.greenwood_frequency && cost.operation.wind_speed) {
    throw InputError("objective.wind_speed", configuration.value_text("objective.wind_speed"),
                     fmt::format("set only one of it and objective.greenwood_frequency, which is "
                                 "{}",
                                 configuration.value_text("objective.greenwood_frequency")));
  }
  require_wind(configuration,
               {"objective.kind", "objective.terms", "objective.penalties", "objective.limits"});
  cost.validate();
  return cost;
}

DesignSpaceOptions search_space_options_of(const Configuration& configuration, SensorDesign base) {
  DesignSpaceOptions options{
      .base = std::move(base),
      .layout = choice_of<Layout>(configuration, "search.layout"),
      .plane_counts = whole_numbers(*configuration.domain("search.plane_count")),
      .orders = configuration.orders("search.order")};
  for (const VisitingOrder& order : options.orders) {
    if (std::ranges::count(options.plane_counts, static_cast<int>(order.size())) > 0) continue;
    throw InputError("search.order", fmt::format("{}", fmt::join(order, "")),
                     fmt::format("an order of {} planes, see search.plane_count",
                                 fmt::join(options.plane_counts, " or ")));
  }
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!key.name.starts_with("search.") || key.kind != Kind::domain ||
        key.name == "search.plane_count") {
      continue;
    }
    if (const auto domain = configuration.domain(key.name)) {
      options.domains.emplace(key.name.substr(std::string_view("search.").size()), *domain);
    }
  }
  if (options.domains.contains("exposure") && options.base.detector.photon_rate == 0.0) {
    throw InputError("search.exposure", configuration.value_text("search.exposure"),
                     "nothing without detector.photon_rate, such as --detector.photon_rate 1e8");
  }
  return options;
}

DesignSpace search_space_of(const Configuration& configuration, const Telescope& telescope,
                            SensorDesign base) {
  return {telescope, search_space_options_of(configuration, std::move(base))};
}

void set_design(Configuration& configuration, const SensorDesign& design, const DesignSpace& space,
                std::string_view source) {
  configuration.set("sensor.planes", fmt::format("{}", fmt::join(design.planes, ",")), source);
  for (const DesignField& field : design_properties()) {
    if (!space.decides(field.variable)) continue;
    const ReconstructionOptions& reconstruction = design.reconstruction;
    const double value = field.get(design);
    configuration.set(
        field.key,
        key_named(field.key).kind == Kind::ramp
            ? fmt::format("{}:{}", reconstruction.relaxation_start, reconstruction.relaxation_end)
        : field.words.empty() ? fmt::format("{}", value)
                              : std::string(field.words[static_cast<std::size_t>(value)]),
        source);
  }
}

int truth_samples(const Configuration& configuration) {
  return configuration.integer(is_matched(configuration) ? "detector.pupil_pixels"
                                                         : "simulation.pupil_samples");
}

LightSource light_source_of(const Configuration& configuration) {
  LightSource source{
      .bands = configuration.bands("source.bands"),
      .is_split = configuration.choice("source.division") == "split",
      .wavelengths = configuration.integer("source.wavelengths"),
      .aberration = choice_of<ChromaticAberration>(configuration, "source.aberration")};
  if (configuration.is_set("source.weights")) {
    source.weights = configuration.numbers("source.weights");
  }
  return source;
}

Precision precision_of(const Configuration& configuration, std::string_view key) {
  return choice_of<Precision>(configuration, key);
}

SimulationOptions simulation_options_of(const Configuration& configuration) {
  return {.truth = choice_of<TruthModel>(configuration, "simulation.truth"),
          .precision = precision_of(configuration, "simulation.precision"),
          .noise_seed = configuration.seed("screens.seed"),
          .source = light_source_of(configuration),
          .time_limit = configuration.optional_time("simulation.time_limit")
                            .value_or(std::numeric_limits<double>::infinity())};
}

Setup::Setup(const Configuration& configuration)
    : telescope(telescope_of(configuration)),
      seeings(seeings_of(configuration, telescope)),
      lights(lights_of(configuration)),
      design(design_of(configuration)),
      options(simulation_options_of(configuration)),
      samples(truth_samples(configuration)),
      values(values_of(configuration)) {}

SensorDesign Setup::simulated() const {
  return simulated_design(design, telescope, options, samples);
}

}  // namespace nlcwfs
