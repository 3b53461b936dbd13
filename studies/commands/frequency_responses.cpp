// The responses of a design and of pairs of planes are measured.
#include "studies/commands/frequency_responses.hpp"

#include "model/frequency_response.hpp"
#include "model/input_error.hpp"
#include "objectives/design_grid.hpp"
#include "studies/run/interrupt.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// The values of an axis; none where it is not set.
std::vector<double> axis_of(const Configuration& configuration, std::string_view key) {
  return configuration.axis(key).value_or(std::vector<double>{});
}

/// In cycles per pupil diameter.
std::vector<double> frequencies_of(const Configuration& configuration, int pupil_pixels) {
  constexpr double most_by_default = 16.0;
  // The truth's samples are at least as many as the pixels.
  const double too_high = 0.5 * pupil_pixels;
  std::vector<double> frequencies = axis_of(configuration, "response.frequencies");
  for (const double frequency : frequencies) {
    if (frequency < too_high) continue;
    throw InputError("response.frequencies", frequency,
                     fmt::format("below {:g} cycles per pupil diameter, half of "
                                 "detector.pupil_pixels: more they cannot show",
                                 too_high));
  }
  if (configuration.is_set("response.frequencies")) return frequencies;
  for (double frequency = 1.0; frequency <= most_by_default && frequency < too_high; ++frequency) {
    frequencies.push_back(frequency);
  }
  return frequencies;
}

}  // namespace

ResponseTask::ResponseTask(const Configuration& configuration)
    : Setup(configuration),
      screens(configuration),
      wavefronts(screens.count),
      amplitude(configuration.length("response.amplitude")),
      designs{simulated()},
      frequencies(frequencies_of(configuration, designs.front().detector.pupil_pixels)),
      distances(axis_of(configuration, "response.distances")) {
  require_one_condition(configuration);
  require_memory("screens.count", std::to_string(wavefronts), wavefronts, samples);
  if (double(frequencies.size()) * double(distances.size()) > double(DesignGrid::most_points)) {
    throw InputError("response.distances", fmt::format("{} distances", distances.size()),
                     fmt::format("at most {} with {} frequencies",
                                 DesignGrid::most_points / frequencies.size(), frequencies.size()));
  }
  for (const double distance : distances) {
    SensorDesign pair = design;
    pair.planes = {-distance, distance};
    try {
      designs.push_back(simulated_design(pair, telescope, options, samples));
    } catch (const InputError& error) {
      throw InputError("response.distances", distance,
                       fmt::format("no pair of planes can be there: {}", error.what()));
    }
  }
}

Simulation ResponseTask::simulation_of(double frequency) const {
  const double radians = amplitude / telescope.wavelength * 2.0 * std::numbers::pi;
  return {telescope, sinusoid_screens(frequency, radians, samples, wavefronts, screens.seed),
          options};
}

namespace {

double share_of(const ScreenPerformance& screen) { return screen.wavefront.recovered_share; }

/// How far noise moves the recovered amplitude from what the same wavefronts give without noise.
AmplitudeNoise noise_of(const ResponseTask& task, const Simulation& simulation,
                        const SensorDesign& design, const Performance& noisy, double contrast,
                        const ScreenWatch& watch) {
  SensorDesign noise_free = design;
  noise_free.detector.photons = 0.0;
  noise_free.detector.photon_rate = 0.0;
  noise_free.detector.read_noise = 0.0;
  std::vector<double> differences = noisy.samples_of(share_of);
  const std::vector<double> without = simulation.evaluate(noise_free, watch).samples_of(share_of);
  differences.resize(std::min(differences.size(), without.size()));
  for (std::size_t i = 0; i < differences.size(); ++i) {
    differences[i] = (differences[i] - without[i]) * task.amplitude_nm();
  }
  return {standard_deviation_and_error(differences), static_cast<int>(differences.size()),
          1e9 * task.telescope.wavelength / (2.0 * std::numbers::pi) *
              photon_limited_amplitude_error(design.detector.photons_per_frame(), contrast)};
}

bool has_noise(const ResponseTask& task, const SensorDesign& design) {
  return design.detector.photons_per_frame() > 0.0 && task.wavefronts > 1;
}

FrequencyResponse measured(const ResponseTask& task, const Simulation& simulation,
                           const SensorDesign& design, double frequency, Progress& progress) {
  const Performance performance = simulation.evaluate(design, interruptible(progress));
  const auto contrasts =
      sinusoid_contrasts(task.telescope, design.planes, frequency, task.options.source);
  FrequencyResponse response{
      .share = performance.mean_of(share_of),
      .residual_wfe = performance.mean_of(performance_metric("residual_wfe_nm")),
      .loops = performance.mean_of(performance_metric("fractional_loops")),
      .talbot_contrast = rms_contrast(contrasts, &SinusoidContrast::talbot),
      .effective_contrast = rms_contrast(contrasts, &SinusoidContrast::effective),
      .noise = {},
      .wavefronts = static_cast<int>(performance.screens.size())};
  if (has_noise(task, design)) {
    response.noise = noise_of(task, simulation, design, performance, response.effective_contrast,
                              interruptible(progress));
    response.wavefronts = response.noise->wavefronts;
  }
  return response;
}

}  // namespace

Responses measured_responses(ResponseTask& task, const Progress* whole) {
  double evaluations = 0.0;
  for (const SensorDesign& design : task.designs) evaluations += has_noise(task, design) ? 2 : 1;
  Progress progress("response", evaluations * double(task.frequencies.size()) * task.wavefronts,
                    "wavefronts", "", whole);
  Responses responses(task.designs.size());
  for (std::size_t i = 0; i < task.frequencies.size(); ++i) {
    const Simulation simulation = task.simulation_of(task.frequencies[i]);
    int least = task.wavefronts;
    for (std::size_t design = 0; design < task.designs.size(); ++design) {
      responses[design].push_back(
          measured(task, simulation, task.designs[design], task.frequencies[i], progress));
      least = std::min(least, responses[design].back().wavefronts);
    }
    if (!InterruptWatch::interrupted()) continue;
    const bool is_whole = least == task.wavefronts;
    task.frequencies.resize(is_whole ? i + 1 : std::max(i, std::size_t{1}));
    if (i == 0) task.wavefronts = least;
  }
  for (auto& of_design : responses) of_design.resize(task.frequencies.size());
  return responses;
}

}  // namespace nlcwfs
