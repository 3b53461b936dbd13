// The search that the program makes unless told otherwise, to be timed.
#pragma once

#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"

#include <vector>

namespace nlcwfs {

// What the program simulates unless told otherwise.

/// Screens at D/r0 = 4.
inline std::vector<PhaseScreen> default_screens(int samples, int count = 16) {
  const double diameter = Telescope().diameter;
  return generate_screens({{.fried_parameter = diameter / 4.0}, samples, diameter, 1}, count);
}

/// Samples of the true field across the pupil.
inline int default_truth_samples(TruthModel truth) {
  return truth == TruthModel::matched ? Detector().pupil_pixels : 128;
}

/// A new one has made no images yet.
inline Simulation default_simulation(const SimulationOptions& options, int screen_count = 16) {
  return {Telescope(), default_screens(default_truth_samples(options.truth), screen_count),
          options};
}

}  // namespace nlcwfs
