// advise: The planes that the scaling law gives for the configured telescope and seeing, and what
// they are predicted to reach.
#include "model/input_error.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/search/verified_ranking.hpp"
#include "studies/settings/law_file.hpp"
#include "studies/settings/units.hpp"

#include <array>
#include <cmath>

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// A metric that a law predicts, and what was simulated where the design was verified.
struct Prediction {
  std::string_view metric;  ///< of performance_metrics()
  std::string_view heading;
  MeanAndError predicted;
  std::optional<MeanAndError> simulated = {};

  /// Simulated minus predicted.
  MeanAndError difference() const {
    return {simulated->mean - predicted.mean,
            std::hypot(simulated->standard_error, predicted.standard_error)};
  }
  double standard_errors() const { return difference().mean / difference().standard_error; }
};

std::array<Prediction, 2> predictions_of(const ScalingLaw& law, double d_over_r0,
                                         const Telescope& telescope) {
  const double nm_per_wavelength = 1e9 * telescope.wavelength;
  const MeanAndError wavelengths = law.residual_wfe.predict(d_over_r0);
  return {{{.metric = "residual_wfe_nm",
            .heading = "residual WFE, nm",
            .predicted = {wavelengths.mean * nm_per_wavelength,
                          wavelengths.standard_error * nm_per_wavelength}},
           {.metric = "fractional_loops",
            .heading = "fractional loops",
            .predicted = law.fractional_loops.predict(d_over_r0)}}};
}

/// A key's value for people, rounded so that equal values are equal texts.
/// @param length_scale  what lengths are multiplied by
std::string shown_value(const Configuration& configuration, const ConfigurationKey& key,
                        double length_scale) {
  if (!configuration.is_set(key.name)) return "not set";
  switch (key.kind) {
    case Kind::number:
      return fmt::format("{:.6g}", configuration.number(key.name));
    case Kind::number_list:
      return fmt::format("{:.6g}", fmt::join(configuration.numbers(key.name), ","));
    case Kind::length:
      return format_length(*configuration.optional_length(key.name) * length_scale);
    case Kind::ramp: {
      const auto [start, end] = configuration.ramp(key.name);
      return fmt::format("{:.6g}:{:.6g}", start, end);
    }
    default:
      return configuration.value_text(key.name);
  }
}

/// A line for each setting that the law's designs had otherwise, and that decides what a design
/// reaches. Equal designs at different telescopes have equal optical paths in wavelengths and equal
/// outer scales in diameters.
std::vector<std::string> differing_conditions(const Configuration& configuration,
                                              const Configuration& conditions) {
  const Telescope here = telescope_of(configuration);
  const Telescope there = telescope_of(conditions);
  std::vector<std::string> notes;
  for (const ConfigurationKey& key : configuration_keys()) {
    const bool decides =
        key.name.starts_with("detector.") || key.name.starts_with("reconstruction.") ||
        key.name.starts_with("objective.") || key.name == "telescope.central_obscuration" ||
        key.name == "seeing.outer_scale" || key.name == "simulation.truth" ||
        key.name == "simulation.pupil_samples" || key.name == "verify.truth_factor";
    if (!decides) continue;
    const std::string asked = shown_value(configuration, key, 1.0);
    const std::string laws =
        shown_value(conditions, key,
                    key.name == "seeing.outer_scale" ? here.diameter / there.diameter
                                                     : here.wavelength / there.wavelength);
    if (asked == laws) continue;
    const bool is_noiseless = key.name == "detector.photons" && laws == "0";
    notes.push_back(fmt::format("{} is {}, where the law's designs have {}{}", key.name, asked,
                                is_noiseless ? "no photon noise" : laws,
                                key.kind == Kind::length ? " at this telescope" : ""));
  }
  return notes;
}

/// What is predicted, beside what was simulated where the design was verified.
std::string predictions_table(const std::array<Prediction, 2>& predictions) {
  const bool verified = predictions[0].simulated.has_value();
  std::string table = fmt::format("  {:<24} {:>22}", "", "predicted");
  if (verified) table += fmt::format(" {:>22} {:>22}", "simulated", "simulated - predicted");
  for (const Prediction& prediction : predictions) {
    table += fmt::format("\n  {:<24} {:>22}", prediction.heading, with_error(prediction.predicted));
    if (verified) {
      table +=
          fmt::format(" {:>22} {:>22} ({:+.1f} standard errors)", with_error(*prediction.simulated),
                      with_error(prediction.difference()), prediction.standard_errors());
    }
  }
  return table + '\n';
}

/// @param verified      null where it is not
/// @param is_elsewhere  whether the law's designs had other settings
void print_advice(const LawFile& file, const Telescope& telescope, const Seeing& seeing,
                  const SensorDesign& design, const std::array<Prediction, 2>& predictions,
                  const Performance* verified, bool is_elsewhere) {
  const double d_over_r0 = telescope.diameter / seeing.fried_parameter;
  const MeanAndError near = file.law.z_near_talbot.predict(d_over_r0);
  const MeanAndError far = file.law.far_fresnel_number.predict(d_over_r0);
  fmt::print("{}\n\nAdvised design, planes in visiting order:\n{}\n",
             telescope_line(telescope, seeing), planes_table(design, telescope, seeing, verified));
  fmt::print("The law knows the near pair's distance to {:.0f} %, the far pair's to {:.0f} %.\n\n",
             100.0 * near.standard_error / near.mean, 100.0 * far.standard_error / far.mean);
  fmt::print("By the law of {} searches, D/r0 = {:g} to {:g}{}{}:\n{}", file.data.size(),
             file.law.least_d_over_r0, file.law.greatest_d_over_r0,
             is_elsewhere ? ", for its own settings (see the notes)" : "",
             verified ? fmt::format(", and on {} fresh screens", verified->screens.size()) : "",
             predictions_table(predictions));
  if (file.law.extrapolates(d_over_r0)) {
    fmt::print(
        "warning: D/r0 = {:.4g} is outside that range: an extrapolation, whose error is larger "
        "than stated\n",
        d_over_r0);
  }
  if (verified) fmt::print("{}", captured_energy_warnings(design, *verified));
}

/// Long, as what is simulated is optional in each of its steps.
void run_advise(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  const Telescope telescope = telescope_of(configuration);
  const Seeing seeing = seeing_of(configuration, telescope);
  const LawFile file = configuration.is_set("advise.law")
                           ? read_law_file(configuration.text("advise.law"))
                           : parse_law_file(built_in_law_text(), "(built in)");
  const double d_over_r0 = telescope.diameter / seeing.fried_parameter;
  SensorDesign design = design_of(configuration);
  design.planes = file.law.planes(telescope, seeing.fried_parameter);
  design.validate(telescope);
  std::vector<std::string> notes = differing_conditions(configuration, file.conditions);
  std::optional<DesignTrial> verification;
  if (request.flags.contains("verify")) {
    const FreshScreens fresh(configuration);
    verification =
        verification_trial_of(Setup(configuration), fresh, cost_of(configuration, false));
    verification->run_on(request.runner);
    require_verifiable(*verification, {design}, fresh);
  }
  const bool is_elsewhere = !notes.empty();
  RunRecord record(request);

  auto predictions = predictions_of(file.law, d_over_r0, telescope);
  Json design_json = to_json(design, telescope, seeing.fried_parameter);
  std::optional<TriedDesign> verified;
  if (verification) {
    Progress progress = verification_progress(*verification, 1);
    verified = verified_design(design, *verification, record, interruptible(progress));
    record.note_missing_screens(*verified, *verification);
    design_json["cost"] = to_json(mean_and_standard_error(verified->costs));
    design_json["performance"] = to_json(verified->performances.front());
  }
  Json predicted{{"extrapolated", file.law.extrapolates(d_over_r0)},
                 {"z_near_talbot", to_json(file.law.z_near_talbot.predict(d_over_r0))},
                 {"far_fresnel_number", to_json(file.law.far_fresnel_number.predict(d_over_r0))}};
  Json differences;
  for (Prediction& prediction : predictions) {
    const std::string metric(prediction.metric);
    predicted[metric] = to_json(prediction.predicted);
    if (!verified) continue;
    prediction.simulated = verified->performances.front().mean_of(performance_metric(metric));
    differences[metric] = to_json(prediction.difference());
    differences[metric]["standard_errors"] = prediction.standard_errors();
  }

  Configuration advised = configuration;
  advised.set("sensor.planes", fmt::format("{}", fmt::join(design.planes, ",")), "by advise");
  record.folder().write("advised.cfg", advised.dump());
  record.folder().write("law.json", to_json(file).dump(2) + '\n');
  Json summary{{"design", design_json}, {"predicted", predicted}, {"law", to_json(file.law)}};
  if (verified) {
    summary["difference"] = differences;
    const CloserLook look = look_closer(*verification, *verified, record.folder());
    summary["closer_look"] = look.summary;
    notes.insert(notes.end(), look.notes.begin(), look.notes.end());
  }
  record.write_summary(summary);

  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  print_advice(file, telescope, seeing, design, predictions,
               verified ? &verified->performances.front() : nullptr, is_elsewhere);
  fmt::print("\nadvised.cfg holds this design, and a search from it: nlcwfs optimize --config {}\n",
             record.folder().file("advised.cfg").string());
  record.close();
}

std::string of_advise(const Json& summary) {
  const Json& predicted = summary.at("predicted");
  std::string text = fmt::format("Predicted: residual WFE {} nm after {} fractional loops",
                                 figure_text(predicted, "residual_wfe_nm"),
                                 figure_text(predicted, "fractional_loops"));
  if (summary.at("design").contains("performance")) {
    text += fmt::format(". Simulated: {}", reached_text(summary.at("design"), "fresh screens"));
  }
  return text + (predicted.at("extrapolated").get<bool>()
                     ? ". This D/r0 is outside the law's range: an extrapolation."
                     : ".");
}

}  // namespace

Command advise_command() {
  return {
      .name = "advise",
      .group = "Laws and scaling",
      .description = "tell a telescope's planes from the scaling law; --verify simulates them",
      .about =
          "Gives the planes of a telescope at once, with the error and the loops that the law "
          "predicts; with --verify they are simulated on fresh screens too.",
      .keys = keys::joined(
          {keys::site,
           {"source", "screens.seed", "sensor", "detector", "reconstruction", "simulation"},
           keys::judgement,
           keys::fresh_screens,
           {"advise"}}),
      .examples = {"nlcwfs advise --telescope.diameter 8.2 --seeing.fried_parameter 1m --verify"},
      .run = run_advise,
      .options = {{.name = "verify",
                   .description =
                       "simulate the design on fresh screens, as the section verify says"}},
      .files =
          joined({{{"advised.cfg", FileRole::design}, {"law.json"}}, closer_look_files(false)}),
      .verdict = of_advise};
}

}  // namespace nlcwfs
