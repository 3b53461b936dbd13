// response: How much of single spatial frequencies one design recovers, and pairs of planes do,
// beside what theory expects.
#include "model/frequency_response.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/frequency_responses.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

Json responses_object(const ResponseTask& task, const std::vector<FrequencyResponse>& responses) {
  Json json;
  for (const FrequencyResponse& response : responses) {
    const auto [share, error] = response.share;
    json["recovered_share"].push_back(to_json(response.share));
    json["recovered_amplitude_nm"].push_back(
        to_json(MeanAndError{share * task.amplitude_nm(), error * task.amplitude_nm()}));
    json["residual_wfe_nm"].push_back(to_json(response.residual_wfe));
    json["fractional_loops"].push_back(to_json(response.loops));
    json["talbot_contrast_per_rad"].push_back(response.talbot_contrast);
    json["effective_contrast_per_rad"].push_back(response.effective_contrast);
    if (!response.noise) continue;
    const auto [deviation, its_error] = response.noise->measured;
    json["amplitude_noise_nm"].push_back(
        {{"standard_deviation", deviation}, {"standard_error", its_error}});
    json["predicted_amplitude_noise_nm"].push_back(response.noise->predicted);
  }
  return json;
}

/// For people: the configured design.
std::string design_table(const ResponseTask& task,
                         const std::vector<FrequencyResponse>& responses) {
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

/// One row per design and frequency.
std::string response_table(const ResponseTask& task, const Responses& responses) {
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
      const auto [share, share_error] = response.share;
      table.row()
          .add(design == 0 ? "design" : "pair")
          .add(design == 0 ? std::nullopt : std::optional(task.distances[design - 1]))
          .add(task.frequencies[i])
          .add(task.telescope.diameter / task.frequencies[i])
          .add(response.share)
          .add(share * task.amplitude_nm())
          .add(share_error * task.amplitude_nm())
          .add(response.residual_wfe)
          .add(response.loops)
          .add(response.talbot_contrast)
          .add(response.effective_contrast);
      if (response.noise) {
        table.add(response.noise->measured).add(response.noise->predicted);
      } else {
        table.add("").add("").add("");
      }
    }
  }
  return table.text();
}

PictureAxis frequency_axis(const ResponseTask& task) {
  return {.label = "cycles per pupil diameter", .values = task.frequencies};
}

/// @param value  of a frequency
template <class Value>
PictureCurve curve_of(const ResponseTask& task, const std::string& label, const Value& value) {
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
std::vector<PictureCurve> landmarks(const ResponseTask& task) {
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

std::string picture_title(const ResponseTask& task) {
  return fmt::format("{:.4g} m telescope at {}, sinusoids of {}", task.telescope.diameter,
                     format_length(task.telescope.wavelength), format_length(task.amplitude));
}

/// The configured design.
LinePicture line_picture(const ResponseTask& task,
                         const std::vector<FrequencyResponse>& responses) {
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
MapPicture map_picture(const ResponseTask& task, const Responses& responses,
                       const std::string& label, MeanAndError FrequencyResponse::*figure) {
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

/// A line of the design's responses, maps of the pairs'.
/// @return notes where there is no picture
std::vector<std::string> write_pictures(const ResponseTask& task, const Responses& responses,
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
  ResponseTask task(request.configuration);
  const std::size_t asked = task.frequencies.size();
  RunRecord record(request);
  const Responses responses = measured_responses(task, request.whole);
  if (task.frequencies.size() < asked || task.wavefronts < task.screens.count) {
    record.note_interrupted(fmt::format("{} of {} frequencies were done in {} wavefronts each",
                                        task.frequencies.size(), asked, task.wavefronts));
  }

  record.folder().write("response.csv", response_table(task, responses));
  std::vector<std::string> notes = write_pictures(task, responses, record.folder());
  if (!task.screens.file.empty()) {
    notes.emplace_back("the wavefronts are sinusoids, none of screens.file");
  }
  Json design = to_json(task.designs.front(), task.telescope, task.seeing().fried_parameter);
  design["response"] = responses_object(task, responses.front());
  Json summary{{"cycles_per_pupil", task.frequencies},
               {"amplitude_m", task.amplitude},
               {"wavefronts", task.wavefronts},
               {"design", design}};
  if (!task.distances.empty()) {
    summary["pairs"]["distances_m"] = task.distances;
    for (std::size_t pair = 1; pair < responses.size(); ++pair) {
      summary["pairs"]["responses"].push_back(responses_object(task, responses[pair]));
    }
  }
  record.write_summary(summary);

  for (const std::string& note : notes) record.print("note: {}\n", note);
  record.print("{}\n\n{}\n", telescope_line(task.telescope, task.seeing()),
               planes_table(task.designs.front(), task.telescope, task.seeing()));
  record.print(
      "Sinusoids of {} (peak), cycles per pupil diameter, in {} orientations and phases, {} "
      "truth;\n"
      "beside what was recovered the contrast of a radian in the images, RMS of the planes:\n{}",
      format_length(task.amplitude), task.wavefronts, word_of(task.options.truth),
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
