#pragma once

#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"

namespace nlcwfs {

/// Two screens of D/r0 = 4 on 16 samples: enough for what does not depend on the optics.
inline Simulation tiny_simulation(const Telescope& telescope) {
  constexpr int samples = 16;
  const TurbulenceScreenGenerator generator({.fried_parameter = telescope.diameter / 4.0}, samples,
                                            telescope.diameter, 1);
  return {telescope, generate_screens(generator, 2), {}};
}

/// A sensor on 16 pixels for that simulation, its planes at the Fresnel numbers of the paper's.
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
