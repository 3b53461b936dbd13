// A configuration becomes the types of the physics.
#pragma once

#include "model/light_source.hpp"
#include "model/seeing.hpp"
#include "model/sensor_design.hpp"
#include "model/simulation.hpp"
#include "model/telescope.hpp"
#include "objectives/design_cost.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/design_space.hpp"
#include "studies/settings/configuration.hpp"

#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

// A configuration's texts as the types of the physics. All throw InputError where values that are
// allowed each do not go together.

/// Of the section telescope.
Telescope telescope_of(const Configuration& configuration);

/// The planes that stand by default or by the paper's preset, which are those of the paper's
/// telescope, moved to the configured telescope at constant Fresnel numbers.
void scale_default_planes(Configuration& configuration);

/// The command trade's own defaults of the section search, for the keys that the user did not set.
void set_trade_defaults(Configuration& configuration);

/// trade.objectives.
std::vector<DesignMetric> trade_objectives_of(const Configuration& configuration);

/// Refuses several seeings or lights, for commands that simulate one condition.
void require_one_condition(const Configuration& configuration);

/// Whether the seeing is another's than the defaults'.
bool is_seeing_given(const Configuration& configuration);

/// With the Fried parameters brought to the telescope's wavelength.
std::vector<Seeing> seeings_of(const Configuration& configuration, const Telescope& telescope);

/// The first of them.
Seeing seeing_of(const Configuration& configuration, const Telescope& telescope);

/// The design of the sections sensor, detector and reconstruction, in the first light.
SensorDesign design_of(const Configuration& configuration);

/// The same with the planes, relaxation and first estimate of the section baseline.
SensorDesign baseline_of(const Configuration& configuration);

/// The section objective.
/// @param pixels_vary  whether the designs to be compared differ in the pixels across the pupil: by
///                     default they are then compared by their total WFE
DesignCost cost_of(const Configuration& configuration, bool pixels_vary);

/// What the section search lets vary.
/// @param base  gives everything else
DesignSpaceOptions search_space_options_of(const Configuration& configuration, SensorDesign base);

/// The space of these.
DesignSpace search_space_of(const Configuration& configuration, const Telescope& telescope,
                            SensorDesign base);

/// Sets the planes and everything else that a space decides on to a design's values.
void set_design(Configuration& configuration, const SensorDesign& design, const DesignSpace& space,
                std::string_view source);

/// Samples of the true field across the pupil; a matched truth has the detector's.
int truth_samples(const Configuration& configuration);

/// The section source.
LightSource light_source_of(const Configuration& configuration);

/// The key simulation.precision or search.precision.
Precision precision_of(const Configuration& configuration, std::string_view key);

/// The section simulation.
SimulationOptions simulation_options_of(const Configuration& configuration);

/// What a configuration asks to be simulated, read once: where a command begins.
struct Setup {
  /// @throws InputError where values do not go together
  explicit Setup(const Configuration& configuration);

  /// The first of them.
  const Seeing& seeing() const { return seeings.front(); }
  /// The design as it is simulated.
  /// @throws InputError where it cannot be
  SensorDesign simulated() const;

  Telescope telescope;          ///< that looks
  std::vector<Seeing> seeings;  ///< Fried parameters at the telescope's wavelength
  /// What replaces the design's light, per condition; nothing where there is one light alone.
  std::vector<std::optional<double>> lights;
  SensorDesign design;             ///< as configured
  SimulationOptions options;       ///< with simulation.precision
  int samples;                     ///< of the true field across the pupil
  std::string values;              ///< a line for each key that is set: "telescope.diameter 0.5m"
  std::vector<std::string> notes;  ///< for the user, on what was made of it
};

}  // namespace nlcwfs
