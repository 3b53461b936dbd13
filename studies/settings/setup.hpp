#pragma once

#include "model/light_source.hpp"
#include "model/seeing.hpp"
#include "model/sensor_design.hpp"
#include "model/simulation.hpp"
#include "model/telescope.hpp"
#include "objectives/design_cost.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/design_space.hpp"
#include "objectives/design_trial.hpp"
#include "studies/settings/configuration.hpp"

#include <functional>
#include <limits>
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
DesignSpace search_space_of(const Configuration& configuration, const Telescope& telescope,
                            SensorDesign base);

/// Sets the planes and everything else that a space decides on to a design's values.
void set_design(Configuration& configuration, const SensorDesign& design, const DesignSpace& space,
                std::string_view source);

/// Samples of the true field across the pupil; a matched truth has the detector's.
int truth_samples(const Configuration& configuration);

/// The section source.
LightSource light_source_of(const Configuration& configuration);

/// @param precision_key  the key of the reconstruction's precision: simulation.precision, or
///                       search.precision for a search
SimulationOptions simulation_options_of(const Configuration& configuration,
                                        std::string_view precision_key);

/// Refuses more screens than memory is allowed for, before they are made.
/// @param key, value  what asks for so many
/// @param samples     of a screen along each side
void require_memory(std::string_view key, const std::string& value, double count, int samples);

/// The wavefronts of the section screens in the first seeing, simulated or from a file, at the
/// truth's samples.
/// @param notes  gets a line where screens had to be resampled
/// @param most   no more than the first so many are simulated; a file's are read all the same
/// @param watch  see generate_screens
std::vector<PhaseScreen> screens_of(const Configuration& configuration,
                                    std::vector<std::string>& notes,
                                    int most = std::numeric_limits<int>::max(),
                                    const std::function<bool(int)>& watch = {});

/// What designs are tried under: the simulations of the sections screens and simulation in each
/// seeing, with each light; precision and notes as above.
/// @param pixels_vary  see cost_of
DesignTrial trial_of(const Configuration& configuration, std::string_view precision_key,
                     std::vector<std::string>& notes, bool pixels_vary = false);

/// The same on as many fresh screens, those of the verification, but on 8 at least: fewer cannot
/// tell designs apart.
DesignTrial fresh_trial_of(const Configuration& configuration, std::string_view precision_key,
                           bool pixels_vary = false);

/// The trial that results are verified in: verify.screens fresh screens of verify.seed, on a truth
/// verify.truth_factor times as fine, in double precision. A matched truth that is refined no
/// longer matches the reconstruction's grid, so it becomes an extended one.
DesignTrial verification_trial_of(const Configuration& configuration, bool pixels_vary = false);

/// The trial that one of these functions has made, from its DesignTrial::spec: the same
/// performances, but with the costs of designs whose pixels do not vary.
/// @throws InputError where this process cannot make it, such as without screens.file
DesignTrial trial_from_spec(const std::string& spec);

}  // namespace nlcwfs
