// The responses of a design and of pairs of planes are measured.
#pragma once

#include "studies/run/progress.hpp"
#include "studies/settings/trials.hpp"

#include <numbers>

namespace nlcwfs {

/// What the configuration asks for, checked as a whole before anything is written.
struct ResponseTask : Setup {
  /// @throws InputError where values do not go together
  explicit ResponseTask(const Configuration& configuration);

  /// Sinusoids of a frequency as the simulation's wavefronts.
  Simulation simulation_of(double frequency) const;

  /// Peak.
  double amplitude_nm() const { return 1e9 * amplitude; }

  ScreenSource screens;  ///< whose number and seed the sinusoids have
  int wavefronts;        ///< orientations and phases of each frequency
  double amplitude;      ///< peak, m
  /// The configured one, then a pair of planes at each distance.
  std::vector<SensorDesign> designs;
  std::vector<double> frequencies;  ///< cycles per pupil diameter
  std::vector<double> distances;    ///< of the pairs, m
};

/// What photon and read noise do to the recovered amplitude.
struct AmplitudeNoise {
  MeanAndError measured;  ///< standard deviation, nm
  int wavefronts;         ///< that it is of
  double predicted;       ///< of photon noise alone, nm
};

/// How a sensor did at one frequency.
struct FrequencyResponse {
  MeanAndError share = {};                   ///< recovered amplitude over the true one
  MeanAndError residual_wfe = {};            ///< nm
  MeanAndError loops = {};                   ///< fractional
  double talbot_contrast = 0.0;              ///< 1/rad, root mean square over the planes
  double effective_contrast = 0.0;           ///< the same
  std::optional<AmplitudeNoise> noise = {};  ///< where there is noise
  int wavefronts = 0;                        ///< that it is of
};

/// Of each design, of each frequency.
using Responses = std::vector<std::vector<FrequencyResponse>>;

/// At each of the task's frequencies. An interrupt ends it with those that are done, or with the
/// first alone in as few wavefronts as give a mean its error; the task then has no others.
Responses measured_responses(ResponseTask& task, const Progress* whole);

}  // namespace nlcwfs
