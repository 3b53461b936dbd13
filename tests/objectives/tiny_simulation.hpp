// A simulation of milliseconds, for tests.
#pragma once

#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"
#include "objectives/design_trial.hpp"

#include <memory>

namespace nlcwfs {

/// Screens on 16 samples: enough for what does not depend on the optics.
inline Condition tiny_condition(const Telescope& telescope, double d_over_r0 = 4.0,
                                int screen_count = 2) {
  constexpr int samples = 16;
  const double fried_parameter = telescope.diameter / d_over_r0;
  const TurbulenceScreenGenerator generator({.fried_parameter = fried_parameter}, samples,
                                            telescope.diameter, 1);
  return {.name = "tiny",
          .simulation = std::make_shared<const Simulation>(
              telescope, generate_screens(generator, screen_count), SimulationOptions()),
          .fried_parameter = fried_parameter};
}

/// A sensor on 16 pixels for that condition, its planes at the Fresnel numbers of the paper's.
inline SensorDesign tiny_design(const Telescope& telescope) {
  SensorDesign design{.planes = {},
                      .detector = {.pupil_pixels = 16, .window = 2.0},
                      .reconstruction = {.tolerance = telescope.wavelength / 500.0, .window = 4.0}};
  for (const double fresnel_number : {-2.6, 2.6, -10.0, 10.0}) {
    design.planes.push_back(distance_at_fresnel_number(telescope, fresnel_number));
  }
  return design;
}

}  // namespace nlcwfs
