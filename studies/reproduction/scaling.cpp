// The paper's design at other telescopes, at its Fresnel numbers.
#include "model/telescope.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/settings/setup.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

/// A telescope that the paper's design is moved to.
struct OtherTelescope {
  std::string name;  ///< in names of runs
  Settings settings;
};

const std::vector<OtherTelescope>& telescopes() {
  static const std::vector<OtherTelescope> all{
      {"0.5m-532nm", {}},
      {"1.2m-532nm", {{"telescope.diameter", "1.2m"}}},
      {"0.5m-850nm", {{"telescope.wavelength", "850nm"}}},
      {"8.2m-1650nm", {{"telescope.diameter", "8.2m"}, {"telescope.wavelength", "1650nm"}}}};
  return all;
}

/// With the tolerance in waves.
void add_runs(Plan& plan, StudySetup setup) {
  for (const OtherTelescope& telescope : telescopes()) {
    Configuration configuration = plan.base(setup);
    const Telescope from = telescope_of(configuration);
    std::vector<double> planes = configuration.lengths("sensor.planes");
    for (const auto& [key, value] : telescope.settings) configuration.set(key, value, "there");
    const Telescope to = telescope_of(configuration);
    for (double& plane : planes) plane = scaled_distance(plane, from, to);
    const double tolerance =
        configuration.length("reconstruction.tolerance") * to.wavelength / from.wavelength;
    Settings settings = telescope.settings;
    settings.emplace_back("sensor.planes", list_text(planes));
    settings.emplace_back("reconstruction.tolerance", fmt::format("{}", tolerance));
    plan.add(run_folder("scaling", setup, telescope.name), "evaluate", plan.base(setup), settings);
  }
}

MeanAndError mean_of(const SetupRuns& runs, const OtherTelescope& telescope, const char* metric) {
  return mean_from_json(
      runs.summary("scaling", telescope.name).at("design").at("performance").at(metric));
}

void add_section(MarkdownReport& report, const ReproducedRuns& runs) {
  Cells heads{"telescope"};
  for (const StudySetup setup : setups) heads.emplace_back(title_of(setup));
  std::vector<Cells> rows;
  for (const OtherTelescope& telescope : telescopes()) {
    rows.push_back({telescope.name});
    for (const StudySetup setup : setups) {
      const SetupRuns here(runs, setup);
      rows.back().push_back(fmt::format("{} nm, {} loops",
                                        with_error(mean_of(here, telescope, "residual_wfe_nm")),
                                        with_error(mean_of(here, telescope, "loops"))));
    }
  }
  report.add_table(heads, rows);
}

ClaimFinding scales_by_fresnel_number(const SetupRuns& runs) {
  const auto in_waves = [&](const OtherTelescope& telescope) {
    Configuration configuration;
    configuration.set("telescope.wavelength",
                      runs.summary("scaling", telescope.name)
                          .at("config")
                          .at("telescope.wavelength")
                          .get<std::string>(),
                      "there");
    return mean_of(runs, telescope, "residual_wfe_nm").mean /
           configuration.length("telescope.wavelength");
  };
  const OtherTelescope& papers = telescopes().front();
  double largest = 0.0;
  for (const OtherTelescope& telescope : telescopes()) {
    const double loops =
        mean_of(runs, telescope, "loops").mean / mean_of(runs, papers, "loops").mean;
    largest = std::max(
        {largest, std::abs(in_waves(telescope) / in_waves(papers) - 1.0), std::abs(loops - 1.0)});
  }
  return {
      fmt::format("largest relative difference of residual (in waves) and loops {:.1e}", largest),
      verdict_of(largest < 1e-3, largest < 0.05)};
}

}  // namespace

PaperFigure reproduced_scaling() {
  return {.name = "scaling",
          .heading = "Scaling by Fresnel numbers",
          .text =
              "The paper's planes moved to other telescopes, with the tolerance as the same "
              "share of the wavelength.",
          .plan = add_runs,
          .report = add_section,
          .claims = {{"Designs scale to other telescopes by their Fresnel numbers.",
                      "found accurate", "equal to 0.1 %; trend: 5 %", scales_by_fresnel_number,
                      "the Fresnel integral depends on nothing else"}}};
}

}  // namespace nlcwfs
