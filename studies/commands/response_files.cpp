// What response writes: a table and pictures.
#include "studies/commands/response_files.hpp"

#include "model/frequency_response.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/text/quantity_text.hpp"

#include <cmath>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

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

}  // namespace

std::vector<RunFile> response_files() {
  return joined(
      {{{"response.csv", FileRole::table}}, picture_files({"response", "response-map-*"})});
}

std::vector<std::string> write_response_files(const ResponseTask& task, const Responses& responses,
                                              const OutputFolder& folder) {
  folder.write("response.csv", response_table(task, responses));
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

}  // namespace nlcwfs
