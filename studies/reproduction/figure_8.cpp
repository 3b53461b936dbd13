// Figure 8: from loop to loop in all bands.
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/paper_bands.hpp"

namespace nlcwfs {
namespace {

void add_runs(Plan& plan, StudySetup setup) {
  for (const PaperBand& band : paper_bands) add_band(plan, setup, band);
}

void add_section(MarkdownReport& report, const ReproducedRuns& runs) {
  report.add_both([&](StudySetup setup) {
    CurvePicture picture{.title = fmt::format("D/r0 = 6, bands of Table 1, {}", title_of(setup)),
                         .x_label = "loops",
                         .y_label = "residual WFE, nm",
                         .curves = {}};
    CsvTable table(
        {"band", "loop", "residual_wfe_nm", "standard_error_nm", "standard_deviation_nm"});
    for (const PaperBand& band : paper_bands) {
      const auto& residuals = residuals_of(SetupRuns(runs, setup), band.name);
      Curve curve{.label = std::string(band.name),
                  .y = numbers_from_json(residuals.at("mean")),
                  .spread = numbers_from_json(residuals.at("standard_deviation")),
                  .colour = static_cast<int>(picture.curves.size())};
      const std::vector<double> errors = numbers_from_json(residuals.at("standard_error"));
      for (std::size_t loop = 0; loop < errors.size(); ++loop) {
        curve.x.push_back(double(loop + 1));
        table.row().add(band.name).add(curve.x[loop]).add(curve.y[loop]);
        table.add(errors[loop]).add(curve.spread[loop]);
      }
      picture.curves.push_back(std::move(curve));
    }
    report.write(file_name("figure-8", setup), table);
    return report.draw(file_name("figure-8", setup), picture);
  });
}

// The claims --------------------------------------------------------------------------------------

/// Of each wavefront.
using OfScreens = std::vector<double> (*)(const SetupRuns& runs, std::string_view band);

/// The residual after the last loop, nm.
std::vector<double> floors(const SetupRuns& runs, std::string_view band) {
  return numbers_from_json(residuals_of(runs, band).at("screens").back());
}

std::vector<double> loops(const SetupRuns& runs, std::string_view band) {
  return runs.screens("figure-8", band, "loops");
}

/// Whether they clearly rise from one band to another, wavefront by wavefront.
bool rises(const SetupRuns& runs, OfScreens values, const PaperBand& from, const PaperBand& to) {
  return is_clearly_positive(mean_difference(values(runs, to.name), values(runs, from.name)));
}

ClaimFinding rises_with_bandwidth(const SetupRuns& runs, OfScreens values, const char* unit) {
  std::vector<std::string> texts;
  for (const PaperBand& band : paper_bands) {
    texts.push_back(fmt::format("{} {}", band.name,
                                with_error(mean_and_standard_error(values(runs, band.name)))));
  }
  bool rises_each_time = true;
  for (std::size_t i = 1; i < paper_bands.size(); ++i) {
    rises_each_time = rises_each_time && rises(runs, values, paper_bands[i - 1], paper_bands[i]);
  }
  return {
      fmt::format("{} {}", fmt::join(texts, ", "), unit),
      verdict_of(rises_each_time, rises(runs, values, paper_bands.front(), paper_bands.back()))};
}

ClaimFinding floor_grows(const SetupRuns& runs) { return rises_with_bandwidth(runs, floors, "nm"); }

ClaimFinding converges_later(const SetupRuns& runs) {
  return rises_with_bandwidth(runs, loops, "loops");
}

ClaimFinding floor_is_low(const SetupRuns& runs) {
  const MeanAndError floor = mean_and_standard_error(floors(runs, "wide"));
  return {fmt::format("{} nm", with_error(floor)),
          verdict_of(floor.mean < 50.0, floor.mean < 100.0)};
}

}  // namespace

PaperFigure reproduced_figure_8() {
  return {
      .name = "8",
      .heading = "Figure 8: bands",
      .text =
          "The same for one wavelength and the bands of Table 1 (the wide band's P2 as 500 to "
          "699 nm). Bars are standard deviations, as in the paper.",
      .plan = add_runs,
      .report = add_section,
      .claims = {
          {"The floor rises with the bandwidth.", "rises",
           "by two standard errors from each band to the next, wavefront by wavefront; trend: from "
           "one wavelength to the widest band",
           floor_grows,
           "one wavelength on the reconstruction's own grid has no floor at all; bands have one",
           "the same path at every wavelength is another phase at each, and the more so in a wide "
           "band"},
          {"Wider bands converge later.", "later", "as above", converges_later,
           "rms_change hardly sees the floor",
           "at the floor the phase still changes by more than 1 nm a loop, up to the last of 20"},
          {"The floor of the widest band stays low.", "below 50 nm",
           "below 50 nm; trend: below 100 nm", floor_is_low,
           "the same phase at every wavelength is what makes it low",
           "the same path at every wavelength, as air gives it, costs several times as much"}}};
}

}  // namespace nlcwfs
