// Names and units of axes, for people.
#include "results/text/axis_text.hpp"

#include "objectives/design_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {

std::string label_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> labels{
      {{"residual_wfe_nm", "residual WFE, nm"},
       {"fractional_loops", "fractional loops"},
       {"z_near", "distance of the near pair"},
       {"z_far", "distance of the far pair"},
       {"z_third", "distance of the third pair"},
       {"order", "visiting order"}}};
  const auto* const known = std::ranges::find(labels, name, &decltype(labels)::value_type::first);
  if (known != labels.end()) return std::string(known->second);
  if (const DesignField* property = find_design_property(name)) return std::string(property->label);
  if (name.size() == 2 && name[0] == 'z') return fmt::format("distance of plane {}", name[1]);
  std::string label(name);
  std::ranges::replace(label, '_', ' ');
  return label;
}

std::string column_of_variable(std::string_view name) {
  const std::string_view unit = unit_of_variable(name);
  return unit.empty() ? std::string(name) : fmt::format("{}_{}", name, unit);
}

AxisUnit axis_unit_of(std::string_view unit, std::span<const double> values) {
  if (unit != "m") return {1.0, std::string(unit)};
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  constexpr std::array<std::pair<double, std::string_view>, 4> units{
      {{1e3, "km"}, {1.0, "m"}, {1e-3, "mm"}, {1e-9, "nm"}}};
  const auto* const chosen = std::ranges::find_if(
      units, [&](const auto& candidate) { return greatest >= candidate.first; });
  const auto& [size, word] = chosen == units.end() ? units.back() : *chosen;
  return {size, std::string(word)};
}

}  // namespace nlcwfs
