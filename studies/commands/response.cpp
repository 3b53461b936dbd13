// response: How much of single spatial frequencies one design recovers, and pairs of planes do,
// beside what theory expects.
#include "model/frequency_response.hpp"
#include "model/input_error.hpp"
#include "objectives/design_grid.hpp"
#include "results/archive/run_files.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/command.hpp"
#include "studies/run/interrupt.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/request.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/setup.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

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

/// What the configuration asks for, checked as a whole before anything is written.
struct Task {
  explicit Task(const Configuration& configuration);

  /// Sinusoids of a frequency as the simulation's wavefronts.
  Simulation simulation_of(double frequency) const;

  double nm_per_radian() const { return 1e9 * telescope.wavelength / (2.0 * std::numbers::pi); }
  double amplitude_nm() const { return 1e9 * amplitude; }

  Telescope telescope;
  Seeing seeing;
  SimulationOptions options;
  int samples;
  int wavefronts;
  std::uint64_t seed;
  double amplitude;  ///< peak, m
  /// The configured one, then a pair of planes at each distance.
  std::vector<SensorDesign> designs;
  std::vector<double> frequencies;  ///< cycles per pupil diameter
  std::vector<double> distances;    ///< of the pairs, m
};

Task::Task(const Configuration& configuration)
    : telescope(telescope_of(configuration)),
      seeing(seeing_of(configuration, telescope)),
      options(simulation_options_of(configuration, "simulation.precision")),
      samples(truth_samples(configuration)),
      wavefronts(configuration.integer("screens.count")),
      seed(configuration.seed("screens.seed")),
      amplitude(configuration.length("response.amplitude")),
      designs{simulated_design(design_of(configuration), telescope, options, samples)},
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
    SensorDesign pair = design_of(configuration);
    pair.planes = {-distance, distance};
    try {
      designs.push_back(simulated_design(pair, telescope, options, samples));
    } catch (const InputError& error) {
      throw InputError("response.distances", distance,
                       fmt::format("no pair of planes can be there: {}", error.what()));
    }
  }
}

Simulation Task::simulation_of(double frequency) const {
  const double radians = amplitude / telescope.wavelength * 2.0 * std::numbers::pi;
  return {telescope, sinusoid_screens(frequency, radians, samples, wavefronts, seed), options};
}

/// What photon and read noise do to the recovered amplitude.
struct AmplitudeNoise {
  MeanAndError measured;  ///< standard deviation, nm
  int wavefronts;         ///< that it is of
  double predicted;       ///< of photon noise alone, nm
};

/// How a sensor did at one frequency.
struct FrequencyResponse {
  MeanAndError share = {};          ///< recovered amplitude over the true one
  MeanAndError residual_wfe = {};   ///< nm
  MeanAndError loops = {};          ///< fractional
  double talbot_contrast = 0.0;     ///< 1/rad, root mean square over the planes
  double effective_contrast = 0.0;  ///< the same
  std::optional<AmplitudeNoise> noise = {};
  int wavefronts = 0;  ///< that it is of
};

double share_of(const ScreenPerformance& screen) { return screen.wavefront.recovered_share; }

/// How far noise moves the recovered amplitude from what the same wavefronts give without noise.
AmplitudeNoise noise_of(const Task& task, const Simulation& simulation, const SensorDesign& design,
                        const Performance& noisy, double contrast, const ScreenWatch& watch) {
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
          task.nm_per_radian() *
              photon_limited_amplitude_error(design.detector.photons_per_frame(), contrast)};
}

bool has_noise(const Task& task, const SensorDesign& design) {
  return design.detector.photons_per_frame() > 0.0 && task.wavefronts > 1;
}

FrequencyResponse measured(const Task& task, const Simulation& simulation,
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

/// Of each design, of each frequency.
using Responses = std::vector<std::vector<FrequencyResponse>>;

/// At each of the task's frequencies. An interrupt ends it with those that are done, or with the
/// first alone in as few wavefronts as give a mean its error; the task then has no others.
Responses measured(Task& task, const Progress* whole) {
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

Json to_json(const Task& task, const std::vector<FrequencyResponse>& responses) {
  Json json;
  for (const FrequencyResponse& response : responses) {
    const auto [share, error] = response.share;
    json["recovered_share"].push_back(nlcwfs::to_json(response.share));
    json["recovered_amplitude_nm"].push_back(
        nlcwfs::to_json(MeanAndError{share * task.amplitude_nm(), error * task.amplitude_nm()}));
    json["residual_wfe_nm"].push_back(nlcwfs::to_json(response.residual_wfe));
    json["fractional_loops"].push_back(nlcwfs::to_json(response.loops));
    json["talbot_contrast_per_rad"].push_back(response.talbot_contrast);
    json["effective_contrast_per_rad"].push_back(response.effective_contrast);
    if (!response.noise) continue;
    json["amplitude_noise_nm"].push_back(
        {{"standard_deviation", response.noise->measured.mean},
         {"standard_error", response.noise->measured.standard_error}});
    json["predicted_amplitude_noise_nm"].push_back(response.noise->predicted);
  }
  return json;
}

/// One row per design and frequency.
std::string response_table(const Task& task, const Responses& responses) {
  CsvTable table({"planes", "pair_distance_m", "cycles_per_pupil", "period_m", "recovered_share",
                  "recovered_share_standard_error", "recovered_amplitude_nm",
                  "recovered_amplitude_nm_standard_error", "residual_wfe_nm",
                  "residual_wfe_nm_standard_error", "fractional_loops",
                  "fractional_loops_standard_error", "talbot_contrast_per_rad",
                  "effective_contrast_per_rad", "amplitude_noise_nm",
                  "amplitude_noise_nm_standard_error", "predicted_amplitude_noise_nm"});
  for (std::size_t design = 0; design < responses.size(); ++design) {
    for (std::size_t i = 0; i < task.frequencies.size(); ++i) {
      const FrequencyResponse& response = responses[design][i];
      table.row().add(design == 0 ? "design" : "pair");
      design == 0 ? table.add("") : table.add(task.distances[design - 1]);
      table.add(task.frequencies[i])
          .add(task.telescope.diameter / task.frequencies[i])
          .add(response.share.mean)
          .add(response.share.standard_error)
          .add(response.share.mean * task.amplitude_nm())
          .add(response.share.standard_error * task.amplitude_nm())
          .add(response.residual_wfe.mean)
          .add(response.residual_wfe.standard_error)
          .add(response.loops.mean)
          .add(response.loops.standard_error)
          .add(response.talbot_contrast)
          .add(response.effective_contrast);
      if (response.noise) {
        table.add(response.noise->measured.mean)
            .add(response.noise->measured.standard_error)
            .add(response.noise->predicted);
      } else {
        table.add("").add("").add("");
      }
    }
  }
  return table.text();
}

/// For people: the configured design.
std::string design_table(const Task& task, const std::vector<FrequencyResponse>& responses) {
  const bool has_noise = responses.front().noise.has_value();
  std::string table =
      fmt::format("  {:>6} {:>22} {:>20} {:>18} {:>8} {:>10}", "cycles", "recovered share",
                  "residual WFE, nm", "fractional loops", "Talbot", "effective");
  if (has_noise) table += fmt::format(" {:>18} {:>10}", "noise, nm", "predicted");
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const FrequencyResponse& response = responses[i];
    table += fmt::format("\n  {:>6.4g} {:>22} {:>20} {:>18} {:>8.3f} {:>10.3f}",
                         task.frequencies[i], with_error(response.share),
                         with_error(response.residual_wfe), with_error(response.loops),
                         response.talbot_contrast, response.effective_contrast);
    if (response.noise) {
      table += fmt::format(" {:>18} {:>10.3g}", with_error(response.noise->measured),
                           response.noise->predicted);
    }
  }
  return table + '\n';
}

PictureAxis frequency_axis(const Task& task) {
  return {.label = "cycles per pupil diameter", .values = task.frequencies};
}

/// @param value  of a frequency
template <class Value>
PictureCurve curve_of(const Task& task, const std::string& label, const Value& value) {
  const auto [least, greatest] = std::ranges::minmax(task.frequencies);
  constexpr int steps = 400;
  PictureCurve curve{label, {}};
  for (int step = 0; step <= steps; ++step) {
    const double frequency = least * std::pow(greatest / least, double(step) / steps);
    curve.points.push_back({frequency, value(frequency)});
  }
  return curve;
}

/// What decides on what a pair sees: distances in km over the frequencies.
std::vector<PictureCurve> landmarks(const Task& task) {
  const auto distance = [&](double fresnel_number) {
    return 1e-3 * distance_at_fresnel_number(task.telescope, fresnel_number);
  };
  std::vector<PictureCurve> curves{
      curve_of(task, "half the Talbot distance", [&](double f) { return distance(f * f); }),
      curve_of(task, "the two beams part", [&](double f) { return distance(2.0 * f); })};
  if (task.options.truth == TruthModel::extended) {
    const double window = task.designs.front().detector.window;
    curves.push_back(curve_of(task, "half outside the window",
                              [&](double f) { return distance(2.0 * f / window); }));
  }
  return curves;
}

std::string picture_title(const Task& task) {
  return fmt::format("{:.4g} m telescope at {}, sinusoids of {}", task.telescope.diameter,
                     format_length(task.telescope.wavelength), format_length(task.amplitude));
}

/// The configured design.
LinePicture line_picture(const Task& task, const std::vector<FrequencyResponse>& responses) {
  LinePicture picture{picture_title(task), frequency_axis(task), "recovered share", {}, {}};
  for (const FrequencyResponse& response : responses) picture.values.push_back(response.share);
  picture.overlay.curves.push_back(
      curve_of(task, "effective contrast, 1/rad", [&](double frequency) {
        return rms_contrast(sinusoid_contrasts(task.telescope, task.designs.front().planes,
                                               frequency, task.options.source),
                            &SinusoidContrast::effective);
      }));
  return picture;
}

/// A figure of the pairs.
MapPicture map_picture(const Task& task, const Responses& responses, const std::string& label,
                       MeanAndError FrequencyResponse::*figure) {
  MapPicture picture{.title = picture_title(task),
                     .x = frequency_axis(task),
                     .y = {.label = "distance of the pair, km", .values = {}},
                     .value_label = label,
                     .values = {},
                     .overlay = {.curves = landmarks(task)},
                     .is_linear = figure == &FrequencyResponse::share};
  for (const double distance : task.distances) picture.y.values.push_back(1e-3 * distance);
  for (std::size_t i = 0; i < task.frequencies.size(); ++i) {
    picture.values.emplace_back();
    for (std::size_t design = 1; design < responses.size(); ++design) {
      picture.values.back().push_back((responses[design][i].*figure).mean);
    }
  }
  return picture;
}

/// @return notes where there is no picture
std::vector<std::string> write_pictures(const Task& task, const Responses& responses,
                                        const OutputFolder& folder) {
  std::vector<std::string> notes;
  const auto write = [&](const auto& picture, const std::string& name) {
    if (const auto reason = write_picture(picture, folder.file(name))) {
      notes.push_back(fmt::format("there is no {}.svg: {}", name, *reason));
    }
  };
  write(line_picture(task, responses.front()), "response");
  if (task.distances.empty()) return notes;
  write(map_picture(task, responses, "recovered share", &FrequencyResponse::share),
        "response-map-recovered");
  write(map_picture(task, responses, "residual WFE, nm", &FrequencyResponse::residual_wfe),
        "response-map-residual");
  write(map_picture(task, responses, "fractional loops", &FrequencyResponse::loops),
        "response-map-loops");
  return notes;
}

void run_response(const Request& request) {
  const Configuration& configuration = request.configuration;
  Task task(configuration);
  const std::size_t asked = task.frequencies.size();
  RunRecord record(request);
  const Responses responses = measured(task, request.whole);
  if (task.frequencies.size() < asked || task.wavefronts < configuration.integer("screens.count")) {
    record.note_interrupted(fmt::format("{} of {} frequencies were done in {} wavefronts each",
                                        task.frequencies.size(), asked, task.wavefronts));
  }

  record.folder().write("response.csv", response_table(task, responses));
  std::vector<std::string> notes = write_pictures(task, responses, record.folder());
  if (!configuration.text("screens.file").empty()) {
    notes.emplace_back("the wavefronts are sinusoids, none of screens.file");
  }
  Json design = nlcwfs::to_json(task.designs.front(), task.telescope, task.seeing.fried_parameter);
  design["response"] = to_json(task, responses.front());
  Json summary{{"cycles_per_pupil", task.frequencies},
               {"amplitude_m", task.amplitude},
               {"wavefronts", task.wavefronts},
               {"design", design}};
  if (!task.distances.empty()) {
    summary["pairs"]["distances_m"] = task.distances;
    for (std::size_t pair = 1; pair < responses.size(); ++pair) {
      summary["pairs"]["responses"].push_back(to_json(task, responses[pair]));
    }
  }
  record.write_summary(summary);

  for (const std::string& note : notes) record.print("note: {}\n", note);
  record.print("{}\n\n{}\n", telescope_line(task.telescope, task.seeing),
               planes_table(task.designs.front(), task.telescope, task.seeing));
  record.print(
      "Sinusoids of {} (peak), cycles per pupil diameter, in {} orientations and phases, {} "
      "truth;\n"
      "beside what was recovered the contrast of a radian in the images, RMS of the planes:\n{}",
      format_length(task.amplitude), task.wavefronts, configuration.choice("simulation.truth"),
      design_table(task, responses.front()));
  if (!task.distances.empty()) {
    record.print("\nPairs of planes at {} distances are in response.csv and response-map-*.svg.\n",
                 task.distances.size());
  }
  record.print("\n");
  record.close();
}

std::string of_response(const Json& summary) {
  const Json& frequencies = summary.at("cycles_per_pupil");
  const Json& shares = summary.at("design").at("response").at("recovered_share");
  std::string text = "Recovered share of a sinusoid: ";
  for (const std::size_t i : {std::size_t{0}, frequencies.size() - 1}) {
    text +=
        fmt::format("{}{} at {:g} {} per pupil", i == 0 ? "" : ", ",
                    with_error(mean_from_json(shares.at(i))), number_from_json(frequencies.at(i)),
                    number_from_json(frequencies.at(i)) == 1.0 ? "cycle" : "cycles");
    if (frequencies.size() == 1) break;
  }
  return text + '.';
}

}  // namespace

Command response_command() {
  return {
      .name = "response",
      .group = "One design",
      .description =
          "measure how much of single spatial frequencies a design recovers, beside prediction",
      .about =
          "Puts sinusoidal wavefronts before the sensor, one frequency at a time, and "
          "measures the recovered share; with response.distances also that of pairs of "
          "planes at these distances, as maps. Beside it stand the contrast and the photon "
          "noise that theory lets expect.",
      .keys = keys::joined({keys::site, keys::simulation, {"response"}}),
      .examples = {"nlcwfs response --response.distances 1km:200km:20:log --detector.photons 1e7"},
      .run = run_response,
      .files = joined(
          {{{"response.csv", FileRole::table}}, picture_files({"response", "response-map-*"})}),
      .verdict = of_response};
}

}  // namespace nlcwfs
