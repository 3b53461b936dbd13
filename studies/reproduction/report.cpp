// What a reproduction leaves beside its runs.
#include "studies/reproduction/report.hpp"

#include "studies/reproduction/figures.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::string introduction(const std::vector<Claim>& claims, int screens) {
  return fmt::format(
      "# Letchev, Crass, Crepp & Potier 2022, claim by claim\n\n"
      "Made by `nlcwfs reproduce` on {} wavefronts; the designs at the paper's distances on {}.\n"
      "Of {} claims, in the paper's set-up {}; with an extended truth {}.\n\n"
      "Telescope, planes, sampling, tolerance (1 nm) and 20 loops at most are the paper's. Two "
      "set-ups are compared:\n\n"
      "- *The paper's set-up*: the data are made on the reconstruction's own periodic grid of 4 "
      "pupil diameters, the aberration is the same phase at every wavelength, and the loop stops "
      "where the *RMS of the wavefront* changes by less than the tolerance (`rms_change`). The "
      "paper's text (section 2.3) speaks of the RMS of the *difference*; with that rule its "
      "numbers do not come out, with this one most do: see the numerics at the end.\n"
      "- *Extended truth, rule difference*: the light is propagated without an edge, from a "
      "pupil "
      "sampled twice as finely as the detector (at figures 6 and 8 as finely: 128), the detector "
      "is 4 diameters wide, the aberration is the same path at every wavelength, and the loop "
      "stops where the RMS of the phase's difference falls below the tolerance.\n\n"
      "The wavefronts at all D/r0 are the same ones at other strengths, which makes differences "
      "clearer; the paper has a series for each. Z_T is the Talbot distance 2 r0^2 / lambda, S_F "
      "the field-estimated Strehl ratio; *recommended designs* have Z_near within a factor 1.5 "
      "of "
      "Z_T and Z_far from 150 km on. `a +- b` is a mean with its standard error, `a (b to c)` a "
      "median with what eight tenths are within. Maps are searched in single precision, all else "
      "is in double.",
      screens, more_screens * screens, claims.size(), count_text(claims, StudySetup::paper),
      count_text(claims, StudySetup::extended));
}

/// The claims that a figure's runs check.
void add_claims(MarkdownReport& report, const std::vector<Claim>& claims, std::string_view figure) {
  std::vector<Cells> rows;
  for (const Claim& claim : claims) {
    if (claim.figure != figure) continue;
    rows.push_back({claim.sentence, claim.papers});
    for (const StudySetup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      rows.back().push_back(
          fmt::format("**{}**: {}. *{}*", to_string(finding.verdict), finding.number, finding.why));
    }
    rows.back().push_back(claim.rule);
  }
  report.add_table({"the paper says", "its number", title_of(StudySetup::paper),
                    title_of(StudySetup::extended), "counts as reproduced"},
                   rows);
}

}  // namespace

std::vector<std::string> write_reproduction_report(const OutputFolder& folder,
                                                   const ReproducedRuns& runs,
                                                   const std::vector<Claim>& claims,
                                                   const std::vector<std::string>& figures,
                                                   int screens) {
  MarkdownReport report(folder);
  report.add(introduction(claims, screens));
  for (const PaperFigure& figure : paper_figures()) {
    if (std::ranges::count(figures, figure.name) == 0) continue;
    report.add(fmt::format("## {}", figure.heading));
    report.add(figure.text);
    figure.report(report, runs);
    if (!figure.claims.empty()) add_claims(report, claims, figure.name);
  }
  report.write();
  folder.write("claims.csv", claims_table(claims));
  return report.notes();
}

}  // namespace nlcwfs
