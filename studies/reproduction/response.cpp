// The response of the paper's planes to single spatial frequencies.
#include "studies/reproduction/figures.hpp"

namespace nlcwfs {
namespace {

/// Of the paper's planes, without noise and with photons, and of pairs of planes.
void add_runs(Plan& plan) {
  const Configuration base = plan.base(StudySetup::extended);
  plan.add("response/noise-free", "response", base, {{"response.distances", "5km:205km:21"}});
  plan.add("response/photons", "response", base, {{"detector.photons", "1e6"}});
}

void add_section(MarkdownReport& report, const ReproducedRuns& /*runs*/) {
  const std::string noise_free = "response/noise-free/response";
  report.add_table({"the paper's planes", "with photon noise"},
                   {{report.copy(noise_free, "response", "the paper's planes"),
                     report.copy("response/photons/response", "response-photons",
                                 "the paper's planes, with photon noise")}});
  report.add_table(
      {"pairs: recovered share", "residual WFE", "loops"},
      {{report.copy(noise_free + "-map-recovered", "response-pairs", "recovered"),
        report.copy(noise_free + "-map-residual", "response-pairs-residual", "residual WFE"),
        report.copy(noise_free + "-map-loops", "response-pairs-loops", "loops")}});
}

}  // namespace

PaperFigure reproduced_response() {
  return {.name = "response",
          .heading = "Response to single spatial frequencies",
          .text =
              "Sinusoidal aberrations of 10 nm with an extended truth: what the loop recovers "
              "of them with the paper's planes, without noise and with 1e6 photons per frame, "
              "and with single pairs of planes at their distance; beside it the Talbot "
              "prediction and the photon limit.",
          .plan_alone = add_runs,
          .report = add_section};
}

}  // namespace nlcwfs
