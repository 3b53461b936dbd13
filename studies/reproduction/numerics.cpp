// What the numerics decide: the paper's set-up with one thing changed.
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/paper_bands.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

/// A change of the numerics.
struct Variant {
  std::string name;  ///< in names of runs
  Settings settings = {};
  int times_screens = 1;  ///< how many times as many wavefronts
};

/// Long, as it is the table of them.
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{
      {"as-the-paper"},
      {"window-2", {{"reconstruction.window", "2"}}},
      {"window-8", {{"reconstruction.window", "8"}}},
      {"window-16", {{"reconstruction.window", "16"}}},
      {"stopping-difference", {{"reconstruction.stopping", "difference"}}},
      {"unwrapping-quality-guided", {{"reconstruction.unwrapping", "quality_guided"}}},
      {"truth-periodic-128",
       {{"simulation.truth", "periodic"}, {"simulation.pupil_samples", "128"}}},
      {"truth-periodic-256",
       {{"simulation.truth", "periodic"}, {"simulation.pupil_samples", "256"}}},
      {"truth-extended-64", {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "64"}}},
      {"truth-extended-128",
       {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "128"}}},
      {"truth-extended-256",
       {{"simulation.truth", "extended"}, {"simulation.pupil_samples", "256"}}},
      {"truth-extended-128-difference",
       {{"simulation.truth", "extended"},
        {"simulation.pupil_samples", "128"},
        {"reconstruction.stopping", "difference"}}},
      {"screens-times-4", {}, 4},
      {"screens-times-16", {}, 16}};
  return all;
}

/// A number of the paper that is looked at with each of them.
struct Probe {
  std::string name;  ///< in names of runs
  std::string head;  ///< in report.md
  Settings settings = {};
  std::string command = "evaluate";
};

const std::vector<Probe>& probes() {
  static const std::vector<Probe> all{
      {"four-planes-4", "D/r0 = 4"},
      {"four-planes-6", "D/r0 = 6", {{"seeing.d_over_r0", "6"}}},
      {"four-planes-8", "D/r0 = 8", {{"seeing.d_over_r0", "8"}}},
      {"without-p3", "without P3", {{"sensor.planes", "-47km,47km,180km"}}},
      {"without-p1", "without P1", {{"sensor.planes", "47km,-180km,180km"}}},
      {"fifth-plane",
       "fifth plane at 100 km",
       {{"sensor.planes", "-47km,47km,-180km,180km,100km"}}},
      {"four-pixels",
       "4 pixels per r0 at D/r0 = 8",
       {{"seeing.d_over_r0", "8"},
        {"sensor.planes", "-14.7km,14.7km,-180km,180km"},
        {"detector.pupil_pixels", "32"}}},
      {"medium-band", "medium band at D/r0 = 6", medium_band.settings(), "convergence"}};
  return all;
}

std::string folder_of(const Variant& variant, const Probe& probe) {
  return fmt::format("numerics/{}/{}", variant.name, probe.name);
}

void add_runs(Plan& plan) {
  for (const Variant& variant : variants()) {
    for (const Probe& probe : probes()) {
      Settings settings = variant.settings;
      if (variant.times_screens > 1) {
        settings.emplace_back(
            "screens.count",
            fmt::format("{}", variant.times_screens * plan.given().integer("screens.count")));
      }
      settings.insert(settings.end(), probe.settings.begin(), probe.settings.end());
      plan.add(folder_of(variant, probe), probe.command, plan.base(StudySetup::paper), settings);
    }
  }
}

/// The residual after the last loop of a convergence, nm; NaN of other runs.
MeanAndError floor_of(const nlohmann::ordered_json& summary) {
  const auto loops = summary.find("residual_after_loops_nm");
  if (loops == summary.end()) return {std::nan(""), std::nan("")};
  return {loops->at("mean").back(), loops->at("standard_error").back()};
}

/// Adds a row to the table, and returns what report.md has of it.
std::string add_row(CsvTable& table, const ReproducedRuns& runs, const Variant& variant,
                    const Probe& probe) {
  const auto& summary = runs.summary(folder_of(variant, probe));
  const auto& performance = summary.at("design").at("performance");
  const auto mean = [&](const char* metric) { return mean_from_json(performance.at(metric)); };
  const MeanAndError floor = floor_of(summary);
  table.row().add(variant.name).add(probe.name);
  for (const char* metric : {"residual_wfe_nm", "loops", "field_strehl"}) {
    table.add(mean(metric).mean).add(mean(metric).standard_error);
  }
  table.add(performance.at("converged_fraction").get<double>());
  table.add(floor.mean).add(floor.standard_error);
  if (std::isfinite(floor.mean)) return fmt::format("{} nm", with_error(floor));
  if (probe.name == "four-pixels") return "S_F " + with_error(mean("field_strehl"));
  return fmt::format("{} nm, {} loops", with_error(mean("residual_wfe_nm")),
                     with_error(mean("loops")));
}

void add_section(MarkdownReport& report, const ReproducedRuns& runs) {
  CsvTable table({"variant", "probe", "residual_wfe_nm", "residual_wfe_standard_error_nm", "loops",
                  "loops_standard_error", "field_strehl", "field_strehl_standard_error",
                  "converged_fraction", "floor_nm", "floor_standard_error_nm"});
  Cells heads{"changed"};
  for (const Probe& probe : probes()) heads.push_back(probe.head);
  std::vector<Cells> rows;
  for (const Variant& variant : variants()) {
    rows.push_back({variant.name});
    for (const Probe& probe : probes()) {
      rows.back().push_back(add_row(table, runs, variant, probe));
    }
  }
  report.add_table(heads, rows);
  report.write("numerics", table);
}

}  // namespace

PaperFigure reproduced_numerics() {
  return {.name = "numerics",
          .heading = "What the numerics decide",
          .text =
              "The paper's set-up with one thing changed; planes at 47 and 180 km unless said "
              "otherwise. Where the truth's samples change, so do the wavefronts, not their "
              "statistics.",
          .plan_alone = add_runs,
          .report = add_section};
}

}  // namespace nlcwfs
