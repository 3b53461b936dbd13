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

constexpr std::array<std::pair<std::string_view, std::string_view>, 2> predicted_metrics{
    {{"residual_wfe_nm", "residual WFE, nm"}, {"fractional_loops", "fractional loops"}}};

std::vector<Prediction> predictions_of(const ScalingLaw& law, double d_over_r0,
                                       const Telescope& telescope) {
  const double nm_per_wavelength = 1e9 * telescope.wavelength;
  const MeanAndError wavelengths = law.residual_wfe.predict(d_over_r0);
  const auto& [wfe, loops] = predicted_metrics;
  return {{wfe.first,
           wfe.second,
           {wavelengths.mean * nm_per_wavelength, wavelengths.standard_error * nm_per_wavelength}},
          {loops.first, loops.second, law.fractional_loops.predict(d_over_r0)}};
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

/// A setting that the law's designs had otherwise.
struct Difference {
  std::string text;
  /// Whether a design reaches something else with it: of what is left, another tolerance or another
  /// cost, the effect is small.
  bool is_decisive;
};

/// Equal designs at different telescopes have equal optical paths in wavelengths and equal outer
/// scales in diameters.
std::vector<Difference> differing_conditions(const Configuration& configuration,
                                             const Configuration& conditions) {
  const Telescope here = telescope_of(configuration);
  const Telescope there = telescope_of(conditions);
  std::vector<Difference> differences;
  for (const ConfigurationKey& key : configuration_keys()) {
    const bool is_decisive =
        key.name.starts_with("detector.") || key.name.starts_with("source.") ||
        (key.name.starts_with("reconstruction.") && key.name != "reconstruction.tolerance") ||
        key.name == "telescope.central_obscuration" || key.name == "seeing.outer_scale" ||
        key.name == "simulation.truth" || key.name == "simulation.pupil_samples";
    if (!is_decisive && !key.name.starts_with("objective.") &&
        key.name != "reconstruction.tolerance" && key.name != "verify.truth_factor") {
      continue;
    }
    const std::string asked = shown_value(configuration, key, 1.0);
    const std::string laws =
        shown_value(conditions, key,
                    key.name == "seeing.outer_scale" ? here.diameter / there.diameter
                                                     : here.wavelength / there.wavelength);
    if (asked == laws) continue;
    const bool is_noiseless = key.name == "detector.photons" && laws == "0";
    differences.push_back({fmt::format("{} is {}, where the law's designs have {}{}", key.name,
                                       asked, is_noiseless ? "no photon noise" : laws,
                                       key.kind == Kind::length ? " at this telescope" : ""),
                           is_decisive});
  }
  return differences;
}

/// What is predicted, beside what was simulated where the design was verified.
std::string predictions_table(const std::vector<Prediction>& predictions) {
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

/// @param predictions  none where the law says nothing of this design
/// @param verified     null where it is not
void print_advice(const LawFile& file, const Telescope& telescope, const Seeing& seeing,
                  const SensorDesign& design, const std::vector<Prediction>& predictions,
                  const Performance* verified, std::string_view warnings) {
  const double d_over_r0 = telescope.diameter / seeing.fried_parameter;
  const MeanAndError near = file.law.z_near_talbot.predict(d_over_r0);
  const MeanAndError far = file.law.far_fresnel_number.predict(d_over_r0);
  fmt::print("{}\n\nAdvised design, planes in visiting order:\n{}\n",
             telescope_line(telescope, seeing), planes_table(design, telescope, seeing, verified));
  fmt::print("The law knows the near pair's distance to {:.0f} %, the far pair's to {:.0f} %.\n\n",
             100.0 * near.standard_error / near.mean, 100.0 * far.standard_error / far.mean);
  if (predictions.empty()) {
    fmt::print(
        "What it reaches is not predicted: the law is of {} searches, D/r0 = {:g} to {:g}, under\n"
        "other conditions (see the notes). Simulate it{}, or search from it.\n",
        file.data.size(), file.law.least_d_over_r0, file.law.greatest_d_over_r0,
        verified ? ", as it was" : " with --verify");
    if (verified) {
      fmt::print("On {} fresh screens:\n", verified->screens.size());
      for (const auto& [metric, heading] : predicted_metrics) {
        fmt::print("  {:<24} {:>22}\n", heading,
                   with_error(verified->mean_of(performance_metric(std::string(metric)))));
      }
    }
  } else {
    fmt::print("By the law of {} searches, D/r0 = {:g} to {:g}{}:\n{}", file.data.size(),
               file.law.least_d_over_r0, file.law.greatest_d_over_r0,
               verified ? fmt::format(", and on {} fresh screens", verified->screens.size()) : "",
               predictions_table(predictions));
  }
  fmt::print("{}", warnings);
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
  std::vector<std::string> notes;
  std::vector<std::string> reasons;  // why there is no prediction
  for (const auto& [text, is_decisive] : differing_conditions(configuration, file.conditions)) {
    notes.push_back(text);
    if (is_decisive) reasons.push_back(text);
  }
  if (file.law.extrapolates(d_over_r0)) {
    notes.push_back(fmt::format("D/r0 is {:.4g}, where the law's designs have {:g} to {:g}",
                                d_over_r0, file.law.least_d_over_r0, file.law.greatest_d_over_r0));
    reasons.push_back(notes.back());
  }
  std::optional<DesignTrial> verification;
  if (request.flags.contains("verify")) {
    const FreshScreens fresh(configuration);
    verification =
        verification_trial_of(Setup(configuration), fresh, cost_of(configuration, false));
    verification->run_on(request.runner);
    require_verifiable(*verification, {design}, fresh);
  }
  RunRecord record(request);

  std::vector<Prediction> predictions;
  if (reasons.empty()) predictions = predictions_of(file.law, d_over_r0, telescope);
  Json design_json = to_json(design, telescope, seeing.fried_parameter);
  std::optional<TriedDesign> verified;
  if (verification) {
    Progress progress = verification_progress(*verification, 1);
    verified = verified_design(design, *verification, record, interruptible(progress));
    record.note_missing_screens(*verified, *verification);
    design_json["cost"] = to_json(mean_and_standard_error(verified->costs));
    design_json["performance"] = to_json(verified->performances.front());
    const std::string futility = futility_text(*verified, *verification);
    design_json["futility"] = futility.empty() ? Json(nullptr) : Json(futility);
  }
  Json predicted{{"extrapolated", file.law.extrapolates(d_over_r0)},
                 {"reasons_for_none", reasons},
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
  if (!differences.empty()) summary["difference"] = differences;
  if (verified) {
    const CloserLook look = look_closer(*verification, *verified, record.folder());
    summary["closer_look"] = look.summary;
    notes.insert(notes.end(), look.notes.begin(), look.notes.end());
  }
  record.write_summary(summary);

  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  print_advice(file, telescope, seeing, design, predictions,
               verified ? &verified->performances.front() : nullptr,
               verified ? design_warnings(*verified, *verification) : "");
  fmt::print("\nadvised.cfg holds this design, and a search from it: nlcwfs optimize --config {}\n",
             record.folder().file("advised.cfg").string());
  record.close();
}

std::string of_advise(const Json& summary) {
  const Json& predicted = summary.at("predicted");
  const Json& reasons = predicted.at("reasons_for_none");
  std::string text = reasons.empty()
                         ? fmt::format("Predicted: residual WFE {} nm after {} fractional loops",
                                       figure_text(predicted, "residual_wfe_nm"),
                                       figure_text(predicted, "fractional_loops"))
                         : fmt::format("What it reaches is not predicted: {}",
                                       fmt::join(reasons.get<std::vector<std::string>>(), "; "));
  if (summary.at("design").contains("performance")) {
    text += fmt::format(". Simulated: {}", reached_text(summary.at("design"), "fresh screens"));
  }
  return text + '.';
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
