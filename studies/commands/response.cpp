// response: How much of single spatial frequencies one design recovers, and pairs of planes do,
// beside what theory expects.
#include "results/tables/design_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/commands/response_files.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"

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

void run_response(const Request& request) {
  ResponseTask task(request.configuration);
  const std::size_t asked = task.frequencies.size();
  RunRecord record(request);
  const Responses responses = measured_responses(task, request.whole);
  if (task.frequencies.size() < asked || task.wavefronts < task.screens.count) {
    record.note_interrupted(fmt::format("{} of {} frequencies were done in {} wavefronts each",
                                        task.frequencies.size(), asked, task.wavefronts));
  }

  std::vector<std::string> notes = write_response_files(task, responses, record.folder());
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
      .files = response_files(),
      .verdict = of_response};
}

}  // namespace nlcwfs
