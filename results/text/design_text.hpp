// Designs and performances, for people.
#pragma once

#include "model/performance.hpp"
#include "model/seeing.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"
#include "objectives/design_comparison.hpp"
#include "objectives/design_space.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// "0.52 +- 0.03": a mean with its standard error, to the error's second digit.
std::string with_error(const MeanAndError& value);

/// "0.5 m telescope at 532 nm, D/r0 = 4"
std::string picture_title(const Telescope& telescope, const Seeing& seeing);

/// One line: "0.5 m telescope at 532 nm, D/r0 = 4: r0 = 12.5 cm, its Talbot distance 58.74 km".
std::string telescope_line(const Telescope& telescope, const Seeing& seeing);

/// A table of the planes in visiting order: km, Talbot distances of r0, Fresnel numbers, distance
/// on the bench behind a relay, captured light where the performance is known.
std::string planes_table(const SensorDesign& design, const Telescope& telescope,
                         const Seeing& seeing, const Performance* performance = nullptr);

/// The value of a design's variable as people write it, with its unit: "47 km", "0.25", "flat".
std::string variable_text(std::string_view name, double value);

/// A line with what a space decides on other than the planes; empty where that is nothing.
std::string choices_text(const DesignSpace& space, const SensorDesign& design);

/// A column of a performance table.
struct PerformanceColumn {
  std::string heading;             ///< above the column
  const Performance* performance;  ///< what is in it
  std::vector<double> costs;       ///< of each screen
};

/// A table of the metrics that people look at first, one column per design.
std::string performance_table(const std::vector<PerformanceColumn>& columns);

/// Whether the best design of a search beats the baseline, as a sentence.
/// @param improvement    of the best design on the baseline
/// @param baseline_cost  the mean
std::string baseline_verdict_text(const Improvement& improvement, double baseline_cost);

/// A line for each plane whose window catches less than 90 % of the light; empty where none does.
std::string captured_energy_warnings(const SensorDesign& design, const Performance& performance);

}  // namespace nlcwfs
