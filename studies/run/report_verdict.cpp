#include "studies/run/report_verdict.hpp"

#include "objectives/design_comparison.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// With its standard error, where it has one: one screen alone has none.
std::string figure(const Json& object, const char* name) {
  const MeanAndError value = mean_from_json(object.at(name));
  return value.standard_error == 0.0 ? fmt::format("{:.4g}", value.mean) : with_error(value);
}

/// "residual WFE 2.64 +- 0.01 nm after 8.1 +- 0.2 loops on 64 fresh screens"
std::string reached(const Json& design, std::string_view screens) {
  const Json& performance = design.at("performance");
  return fmt::format("residual WFE {} nm after {} loops on {} {}",
                     figure(performance, "residual_wfe_nm"), figure(performance, "loops"),
                     integer_from_json(performance.at("screens")), screens);
}

/// A number without more digits than timings hold, and without an exponent.
std::string two_digits(double value) {
  const double unit = value < 100.0 ? 1.0 : std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return value < 100.0 ? fmt::format("{:.2g}", value)
                       : fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string of_evaluate(const Json& summary) {
  const Json& design = summary.at("design");
  return fmt::format("{} planes: {}; {:.3g} % of the reconstructions converged.",
                     design.at("planes_m").size(), reached(design, "screens"),
                     100.0 * number_from_json(design.at("performance").at("converged_fraction")));
}

std::string of_optimize(const Json& summary) {
  const Json& best = summary.at("best");
  const Json& gain = summary.at("improvement");
  const std::size_t conditions = best.contains("conditions") ? best.at("conditions").size() : 1;
  const std::size_t screens =
      static_cast<std::size_t>(integer_from_json(best.at("performance").at("screens"))) /
      std::max<std::size_t>(conditions, 1);
  return fmt::format(
      "Best design: {}. {}", reached(best, "fresh screens"),
      baseline_verdict_text(improvement({number_from_json(gain.at("cost")),
                                         number_from_json(gain.at("standard_error"))},
                                        screens),
                            mean_from_json(summary.at("baseline").at("cost")).mean));
}

std::string of_sweep(const Json& summary) {
  return fmt::format("The best of {} designs: {}.", integer_from_json(summary.at("evaluations")),
                     reached(summary.at("best"), "fresh screens"));
}

std::string of_trade(const Json& summary) {
  const Json& front = summary.at("front");
  const auto standing = std::ranges::count_if(front, [](const Json& design) {
    return !design.at("dominated").get<bool>() && number_from_json(design.at("violation")) == 0.0;
  });
  std::string text = fmt::format(
      "Of {} designs that were tried, {} are verified on fresh screens, and {} of them stay on the "
      "front there. ",
      integer_from_json(summary.at("evaluations")), front.size(), standing);
  if (summary.at("knee").is_null()) return text + "None keeps objective.limits: there is no front.";
  const auto knee = static_cast<std::size_t>(integer_from_json(summary.at("knee")));
  return text + fmt::format("The knee of the front is design {}: {}.", knee,
                            reached(front.at(knee), "fresh screens"));
}

std::string of_compare(const Json& summary) {
  const MeanAndError difference = mean_from_json(summary.at("difference"));
  const auto verdict = summary.at("verdict").get<std::string>();
  const std::string costs =
      fmt::format("the optimizer's design costs {} {} than the sweep's, screen by screen",
                  with_error({std::abs(difference.mean), difference.standard_error}),
                  difference.mean < 0.0 ? "less" : "more");
  return verdict == "indistinguishable"
             ? fmt::format("The two designs cannot be told apart: {}.", costs)
             : fmt::format("The optimizer's design is {}: {}.", verdict, costs);
}

std::string of_convergence(const Json& summary) {
  const Json& residuals = summary.at("residual_after_loops_nm");
  const std::size_t loops = residuals.at("mean").size();
  return fmt::format(
      "After {} loops the residual WFE of {} wavefronts is {} nm; the stopping rule ends after {}.",
      loops, summary.at("aberrations_nm").size(),
      with_error({number_from_json(residuals.at("mean").at(loops - 1)),
                  number_from_json(residuals.at("standard_error").at(loops - 1))}),
      figure(summary.at("design").at("performance"), "loops"));
}

std::string of_response(const Json& summary) {
  const Json& frequencies = summary.at("cycles_per_pupil");
  const Json& shares = summary.at("design").at("response").at("recovered_share");
  std::string text = "Recovered share of a sinusoid: ";
  for (const std::size_t i : {std::size_t{0}, frequencies.size() - 1}) {
    text +=
        fmt::format("{}{} at {:g} {} per pupil", i == 0 ? "" : ", ",
                    with_error(mean_from_json(shares.at(i))), number_from_json(frequencies.at(i)),
                    number_from_json(frequencies.at(i)) == 1.0 ? "cycle" : "cycles");
    if (frequencies.size() == 1) break;
  }
  return text + '.';
}

std::string of_law(const Json& summary) {
  const Json& law = summary.at("law");
  return fmt::format("Fitted to {} searches, D/r0 = {:g} to {:g}.", summary.at("designs").size(),
                     number_from_json(law.at("least_d_over_r0")),
                     number_from_json(law.at("greatest_d_over_r0")));
}

std::string of_advise(const Json& summary) {
  const Json& predicted = summary.at("predicted");
  std::string text =
      fmt::format("Predicted: residual WFE {} nm after {} fractional loops",
                  figure(predicted, "residual_wfe_nm"), figure(predicted, "fractional_loops"));
  if (summary.at("design").contains("performance")) {
    text += fmt::format(". Simulated: {}", reached(summary.at("design"), "fresh screens"));
  }
  return text + (predicted.at("extrapolated").get<bool>()
                     ? ". This D/r0 is outside the law's range: an extrapolation."
                     : ".");
}

std::string of_scale(const Json& summary) {
  const Json& telescope = summary.at("scaled_telescope");
  return fmt::format("Moved to {} at {}, with the same Fresnel numbers and D/r0.",
                     format_length(number_from_json(telescope.at("diameter_m"))),
                     format_length(number_from_json(telescope.at("wavelength_m"))));
}

std::string of_screens(const Json& summary) {
  return fmt::format("{} screens: piston-removed variance {} rad^2, Kolmogorov's {:.4g} rad^2.",
                     integer_from_json(summary.at("screens")),
                     figure(summary, "piston_removed_variance_rad2"),
                     number_from_json(summary.at("kolmogorov_piston_removed_variance_rad2")));
}

std::string of_benchmark(const Json& summary) {
  const Json& timing = summary.at("timing");
  const int threads = integer_from_json(timing.at("threads"));
  return fmt::format("{} loops per second in double precision, {} in single, on {} thread{}.",
                     two_digits(number_from_json(timing.at("double").at("loops_per_second"))),
                     two_digits(number_from_json(timing.at("single").at("loops_per_second"))),
                     threads, threads == 1 ? "" : "s");
}

std::string of_export(const Json& summary) {
  return fmt::format("{} evaluations, {} of them failed.",
                     integer_from_json(summary.at("evaluations")),
                     integer_from_json(summary.at("failed")));
}

std::string of_reconstruct(const Json& summary) {
  const Json& consistency = summary.at("consistency");
  const double misfit = number_from_json(consistency.at("misfit"));
  return fmt::format(
      "A wavefront of {} nm RMS after {} loops. Measured and predicted images {}: {}.",
      figure(summary, "wavefront_rms_nm"), figure(summary, "loops"),
      consistency.at("verdict").get<std::string>(),
      misfit > 0.0 ? fmt::format("in plane {} they differ most, by {:.2g} % beyond what noise "
                                 "explains",
                                 integer_from_json(consistency.at("worst_plane")), 100.0 * misfit)
                   : "noise explains all their differences");
}

std::string of_reproduce(const Json& summary) {
  const Json& claims = summary.at("claims");
  std::string text;
  for (const auto& [setup, title] :
       {std::pair{"paper", "In the paper's set-up"}, {"extended", "with an extended truth"}}) {
    std::map<std::string, int> counts;
    for (const Json& claim : claims) ++counts[claim.at(setup).at("verdict").get<std::string>()];
    std::vector<std::string> parts;
    parts.reserve(counts.size());
    for (const auto& [verdict, count] : counts) {
      parts.push_back(fmt::format("{} {}", count, verdict));
    }
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", title, fmt::join(parts, ", "));
  }
  return fmt::format("Of {} claims: {}.", claims.size(), text);
}

}  // namespace

std::string verdict_sentence(const Json& summary) {
  static const std::map<std::string, std::function<std::string(const Json&)>> sentences{
      {"advise", of_advise},
      {"benchmark", of_benchmark},
      {"compare", of_compare},
      {"convergence", of_convergence},
      {"evaluate", of_evaluate},
      {"export", of_export},
      {"law", of_law},
      {"optimize", of_optimize},
      {"reconstruct", of_reconstruct},
      {"reproduce", of_reproduce},
      {"response", of_response},
      {"scale", of_scale},
      {"screens", of_screens},
      {"sweep", of_sweep},
      {"trade", of_trade}};
  const auto sentence = sentences.find(summary.at("command").get<std::string>());
  return sentence == sentences.end() ? "" : sentence->second(summary);
}

}  // namespace nlcwfs
