// Tried designs become JSON and tables.
#include "results/tables/trial_summary.hpp"

#include "results/tables/csv_table.hpp"
#include "results/text/design_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace nlcwfs {

using Json = nlohmann::ordered_json;

Json to_json(const TriedDesign& tried, const DesignTrial& trial) {
  const Condition& first = trial.conditions().front();
  const Telescope& telescope = first.simulation->telescope();
  Json json = to_json(first.lit(tried.design), telescope, first.fried_parameter);
  json["cost"] = to_json(mean_and_standard_error(tried.costs));
  json["violation"] = tried.violation;
  json["performance"] = to_json(pooled(tried.performances));
  const std::string futility = futility_text(tried, trial);
  json["futility"] = futility.empty() ? Json(nullptr) : Json(futility);
  if (trial.conditions().size() == 1) return json;
  for (std::size_t k = 0; k < trial.conditions().size(); ++k) {
    const Condition& condition = trial.conditions()[k];
    json["conditions"].push_back(
        {{"name", condition.name},
         {"d_over_r0", telescope.diameter / condition.fried_parameter},
         {"photons", condition.lit(tried.design).detector.photons_per_frame()},
         {"performance", to_json(tried.performances[k])}});
  }
  return json;
}

std::string futility_text(const TriedDesign& tried, const DesignTrial& trial) {
  constexpr double fewest_photons = 100.0;
  constexpr double share_of_random = 0.8;
  constexpr double least_strehl = 0.2;
  for (std::size_t k = 0; k < trial.conditions().size(); ++k) {
    const Condition& condition = trial.conditions()[k];
    const double photons = condition.lit(tried.design).detector.photons_per_frame();
    const double random_nm = 1e9 * condition.simulation->telescope().wavelength / std::sqrt(12.0);
    const MeanAndError wrapped =
        tried.performances[k].mean_of(performance_metric("wrapped_wfe_nm"));
    const std::string where =
        trial.conditions().size() == 1 ? "" : fmt::format(" under {}", condition.name);
    if (photons > 0.0 && photons < fewest_photons) {
      return fmt::format(
          "This design does not work as a sensor{}: {:g} photons a frame tell next to nothing. It "
          "takes more light (detector.photons)",
          where, photons);
    }
    const MeanAndError strehl = tried.performances[k].mean_of(performance_metric("field_strehl"));
    if (wrapped.mean < share_of_random * random_nm && strehl.mean > least_strehl) continue;
    return fmt::format(
        "This design does not work as a sensor{}: its wrapped error, {} nm, and field-estimated "
        "Strehl ratio, {}, are near those of a random phase, {:.0f} nm and 0. Try a ramp of the "
        "relaxation (reconstruction.relaxation = 0.5:0), more loops (reconstruction.max_loops), "
        "more pixels (detector.pupil_pixels) or other planes",
        where, with_error(wrapped), with_error(strehl), random_nm);
  }
  return {};
}

std::string design_warnings(const TriedDesign& tried, const DesignTrial& trial) {
  std::string warnings = futility_text(tried, trial);
  if (!warnings.empty()) warnings = fmt::format("warning: {}\n", warnings);
  const Performance performance = pooled(tried.performances);
  if (std::ranges::none_of(performance.screens, &ScreenPerformance::converged)) {
    warnings += fmt::format(
        "warning: none of {} wavefronts converged in reconstruction.max_loops = {} loops\n",
        performance.screens.size(), tried.design.reconstruction.max_loops);
  }
  return warnings + captured_energy_warnings(tried.design, performance);
}

std::string conditions_table(const TriedDesign& tried, const DesignTrial& trial) {
  if (trial.conditions().size() == 1) return {};
  std::string table = fmt::format("\n  {:<32} {:>20} {:>20} {:>18}\n", "under each condition",
                                  "residual WFE, nm", "total WFE, nm", "fractional loops");
  for (std::size_t k = 0; k < trial.conditions().size(); ++k) {
    const auto figure = [&](std::string_view metric) {
      return with_error(tried.performances[k].mean_of(performance_metric(metric)));
    };
    table +=
        fmt::format("  {:<32} {:>20} {:>20} {:>18}\n", trial.conditions()[k].name,
                    figure("residual_wfe_nm"), figure("total_wfe_nm"), figure("fractional_loops"));
  }
  return table;
}

std::string limits_text(const TriedDesign& tried, const DesignTrial& trial) {
  std::string text;
  for (std::size_t k = 0; k < trial.conditions().size(); ++k) {
    const Condition& condition = trial.conditions()[k];
    const SensorDesign design = condition.lit(tried.design);
    const MetricContext context{design, trial.cost().operation, condition.fried_parameter};
    for (const MetricBound& limit : trial.cost().limits) {
      const MeanAndError mean = tried.performances[k].mean_of(
          [&](const ScreenPerformance& screen) { return limit.metric.value(screen, context); });
      if (limit.excess(mean.mean) == 0.0) continue;
      text += fmt::format(
          "warning: objective.limits asks for {} {} {:g}, which is {}{}\n", limit.metric.name,
          limit.side == Side::above ? "below" : "above", limit.bound, with_error(mean),
          trial.conditions().size() == 1 ? "" : fmt::format(" under {}", condition.name));
    }
  }
  return text;
}

std::string screens_table(const Performance& performance) {
  std::vector<std::string> columns{"screen"};
  for (const PerformanceMetric& metric : performance_metrics()) columns.emplace_back(metric.name);
  columns.emplace_back("converged");
  CsvTable table(columns);
  double number = 0;
  for (const ScreenPerformance& screen : performance.screens) {
    table.row().add(number++);
    for (const PerformanceMetric& metric : performance_metrics()) table.add(metric(screen));
    table.add(screen.converged ? 1.0 : 0.0);
  }
  return table.text();
}

}  // namespace nlcwfs
