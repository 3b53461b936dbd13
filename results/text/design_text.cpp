// Designs and performances, for people.
#include "results/text/design_text.hpp"

#include "results/text/quantity_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

constexpr double least_captured_energy = 0.9;

/// A Fresnel number without more digits than it means; the pupil's own is infinite.
std::string fresnel_text(double fresnel_number) {
  return std::isfinite(fresnel_number) ? fmt::format("{:.3g}", fresnel_number) : "-";
}

}  // namespace

std::string with_error(const MeanAndError& value) {
  // The second digit of the error, for errors from the size of the mean to a millionth of it.
  const int decimals =
      value.standard_error > 0.0
          ? std::clamp(1 - static_cast<int>(std::floor(std::log10(value.standard_error))), 0, 9)
          : 2;
  return fmt::format("{:.{}f} +- {:.{}f}", value.mean, decimals, value.standard_error, decimals);
}

std::string picture_title(const Telescope& telescope, const Seeing& seeing) {
  return fmt::format("{:.4g} m telescope at {}, D/r0 = {:.4g}", telescope.diameter,
                     format_length(telescope.wavelength),
                     telescope.diameter / seeing.fried_parameter);
}

std::string telescope_line(const Telescope& telescope, const Seeing& seeing) {
  std::string line =
      fmt::format("{}: r0 = {:.3g} cm, its Talbot distance {}", picture_title(telescope, seeing),
                  100.0 * seeing.fried_parameter,
                  format_length(talbot_distance(seeing.fried_parameter, telescope.wavelength)));
  if (seeing.outer_scale) line += ", outer scale " + format_length(*seeing.outer_scale);
  return line;
}

std::string planes_table(const SensorDesign& design, const Telescope& telescope,
                         const Seeing& seeing, const Performance* performance) {
  const double talbot = talbot_distance(seeing.fried_parameter, telescope.wavelength);
  const auto& relay = telescope.relay_beam_diameter;
  std::string table = fmt::format("  {:>8} {:>12} {:>18} {:>15}", "visited", "distance",
                                  "Talbot distances", "Fresnel number");
  if (relay) table += fmt::format(" {:>12}", "on the bench");
  if (performance != nullptr) table += fmt::format(" {:>15}", "light captured");
  table += '\n';
  const std::vector<double> captured =
      performance != nullptr ? performance->captured_energy() : std::vector<double>{};
  for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
    const double z = design.planes[plane];
    table += fmt::format("  {:>8} {:>12} {:>18.3f} {:>15}", plane + 1, format_length(z), z / talbot,
                         fresnel_text(fresnel_number(telescope, z)));
    if (relay) table += fmt::format(" {:>12}", format_length(bench_distance(z, telescope)));
    if (performance != nullptr) table += fmt::format(" {:>13.1f} %", 100.0 * captured[plane]);
    table += '\n';
  }
  return table;
}

std::string variable_text(std::string_view name, double value) {
  const DesignField* property = find_design_property(name);
  if (property != nullptr && !property->words.empty()) {
    return std::string(property->words[static_cast<std::size_t>(value)]);
  }
  const std::string_view unit = unit_of_variable(name);
  if (unit == "m") return format_length(value);
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string choices_text(const DesignSpace& space, const SensorDesign& design) {
  std::string text;
  for (const DesignField& property : design_properties()) {
    if (!space.decides(property.variable)) continue;
    text += fmt::format("{}{} {}", text.empty() ? "  with " : ", ", property.variable,
                        variable_text(property.variable, property.get(design)));
  }
  return text.empty() ? text : text + '\n';
}

std::string performance_table(const std::vector<PerformanceColumn>& columns) {
  using Row = std::pair<std::string_view, std::string_view>;  // metric and heading
  static constexpr std::array<Row, 7> rows{{{"residual_wfe_nm", "residual WFE, nm"},
                                            {"wrapped_wfe_nm", "wrapped WFE, nm"},
                                            {"total_wfe_nm", "total WFE, nm"},
                                            {"field_strehl", "field-estimated Strehl"},
                                            {"loops", "loops"},
                                            {"fractional_loops", "fractional loops"},
                                            {"seconds", "seconds per wavefront"}}};
  std::string table = fmt::format("  {:<24}", "");
  for (const PerformanceColumn& column : columns) table += fmt::format(" {:>22}", column.heading);
  const auto add_row = [&](std::string_view heading, const auto& text_of) {
    table += fmt::format("\n  {:<24}", heading);
    for (const PerformanceColumn& column : columns) {
      table += fmt::format(" {:>22}", text_of(column));
    }
  };
  for (const auto& [metric, heading] : rows) {
    add_row(heading, [metric = performance_metric(metric)](const PerformanceColumn& column) {
      return with_error(column.performance->mean_of(metric));
    });
  }
  add_row("converged", [](const PerformanceColumn& column) {
    return fmt::format("{:.1f} %", 100.0 * column.performance->converged_fraction());
  });
  add_row("cost", [](const PerformanceColumn& column) {
    return with_error(mean_and_standard_error(column.costs));
  });
  return table + '\n';
}

std::string baseline_verdict_text(const Improvement& improvement, double baseline_cost) {
  switch (improvement.verdict) {
    case Verdict::better:
      return fmt::format(
          "The best design beats the baseline: it costs {} less ({:.0f} %), screen by screen.",
          with_error(improvement.cost), 100.0 * improvement.cost.mean / baseline_cost);
    case Verdict::indistinguishable:
      return fmt::format(
          "The baseline is NOT beaten: on fresh screens its cost minus the best design's is {}, "
          "which may well be chance.",
          with_error(improvement.cost));
    case Verdict::worse:
      break;
  }
  return fmt::format(
      "The baseline is NOT beaten: on fresh screens the best design that was found costs {} more. "
      "Search longer (search.budget) or on more screens (screens.count).",
      with_error({-improvement.cost.mean, improvement.cost.standard_error}));
}

std::string captured_energy_warnings(const SensorDesign& design, const Performance& performance) {
  std::string warnings;
  const std::vector<double> captured = performance.captured_energy();
  for (std::size_t plane = 0; plane < captured.size(); ++plane) {
    if (captured[plane] >= least_captured_energy) continue;
    warnings += fmt::format(
        "warning: the detector's window ({:g} pupil diameters) catches only {:.1f} % of the light "
        "at {}\n",
        design.detector.window, 100.0 * captured[plane], format_length(design.planes[plane]));
  }
  return warnings;
}

}  // namespace nlcwfs
