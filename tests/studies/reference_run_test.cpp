// Whether today's code still gives the numbers of the committed reference run, at a few of its
// points. Where a change of the physics is meant, the reference is made anew
// (results/reference/README.md).

#include "results/tables/csv_table.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/settings/trials.hpp"
#include "tests/paths.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

std::vector<CsvRow> reference_rows(const std::string& file) {
  return read_csv(reference_run_folder() + "/" + file);
}

double number(const CsvRow& row, const std::string& column) { return std::stod(row.at(column)); }

Configuration configuration_of(const std::string& run) {
  for (const PlannedRun& planned : planned_runs(Configuration())) {
    if (planned.folder == run) return planned.configuration;
  }
  ADD_FAILURE() << "no run " << run;
  return {};
}

/// Processors round differently, and the loop makes that larger, the more so in single precision.
void expect_same(double today, double reference) {
  EXPECT_NEAR(today, reference, 1e-4 * std::abs(reference));
}

/// @param row  with the means of what `configuration` evaluates
/// @param precision  its key: sweeps have that of a search
void expect_same_means(const Configuration& configuration, const CsvRow& row,
                       const std::vector<std::string>& metrics, std::string_view precision) {
  Setup setup(configuration);
  const DesignTrial trial =
      trial_of(setup, ScreenSource(configuration), precision_of(configuration, precision),
               cost_of(configuration, false));
  const TriedDesign tried = trial.run(design_of(configuration));
  for (const std::string& metric : metrics) {
    SCOPED_TRACE(metric);
    const MeanAndError today = tried.performances.front().mean_of(performance_metric(metric));
    expect_same(today.mean, number(row, metric));
    std::string error = metric.ends_with("_nm")
                            ? metric.substr(0, metric.size() - 3) + "_standard_error_nm"
                            : metric + "_standard_error";
    expect_same(today.standard_error, number(row, error));
  }
}

/// Name of a map, and the order in which it visits -near, near, -far, far.
struct MapCase {
  std::string folder;
  std::string name;
  std::string planes;
};

void PrintTo(const MapCase& map, std::ostream* out) { *out << map.folder << '/' << map.name; }

class ReferenceMap : public testing::TestWithParam<MapCase> {};

TEST_P(ReferenceMap, IsWhatTheCodeGives) {
  const auto& [folder, name, planes] = GetParam();
  const std::vector<CsvRow> rows = reference_rows(fmt::format("{}-{}.csv", folder, name));
  const auto distance = [](const CsvRow& row) {
    return std::abs(number(row, "z_near_m") - 47e3) + std::abs(number(row, "z_far_m") - 180e3);
  };
  const CsvRow& row = *std::ranges::min_element(rows, {}, distance);
  Configuration configuration = configuration_of(folder + "/" + name);
  configuration.set("sensor.planes",
                    fmt::format(fmt::runtime(planes), row.at("z_near_m"), row.at("z_far_m")),
                    "here");
  expect_same_means(configuration, row, {"residual_wfe_nm", "loops"}, "search.precision");
}

INSTANTIATE_TEST_SUITE_P(Paper, ReferenceMap,
                         testing::Values(MapCase{"figure-3", "paper-4", "-{0},{0},-{1},{1}"},
                                         MapCase{"figure-3", "paper-6", "-{0},{0},-{1},{1}"},
                                         MapCase{"figure-3", "paper-8", "-{0},{0},-{1},{1}"},
                                         MapCase{"figure-4", "paper-without-p3", "-{0},{0},{1}"},
                                         MapCase{"figure-4", "paper-without-p1", "{0},-{1},{1}"}));
INSTANTIATE_TEST_SUITE_P(Extended, ReferenceMap,
                         testing::Values(MapCase{"figure-3", "extended-4", "-{0},{0},-{1},{1}"},
                                         MapCase{"figure-4", "extended-without-p3",
                                                 "-{0},{0},{1}"}));

TEST(ReferenceRun, FifthPlaneIsWhatTheCodeGives) {
  const std::vector<CsvRow> rows = reference_rows("figure-5-paper.csv");
  // At the pupil, where a hop of no length is left out.
  const auto row = std::ranges::find(rows, "0", [](const CsvRow& r) { return r.at("z5_m"); });
  ASSERT_NE(row, rows.end());
  Configuration configuration = configuration_of("figure-5/paper");
  configuration.set("sensor.planes", configuration.value_text("sensor.planes") + ",0", "here");
  expect_same_means(configuration, *row, {"residual_wfe_nm", "loops"}, "search.precision");
}

TEST(ReferenceRun, SamplingIsWhatTheCodeGives) {
  for (const CsvRow& row : reference_rows("figure-6-paper.csv")) {
    if (number(row, "pupil_pixels") > 16.0) continue;
    SCOPED_TRACE(row.at("d_over_r0"));
    Configuration configuration = configuration_of("figure-6/paper-" + row.at("d_over_r0"));
    configuration.set("detector.pupil_pixels", row.at("pupil_pixels"), "here");
    expect_same_means(configuration, row, {"field_strehl"}, "search.precision");
  }
}

TEST(ReferenceRun, BroadbandIsWhatTheCodeGives) {
  Configuration configuration = configuration_of("figure-8/paper-medium");
  configuration.set("screens.count", "1", "here");
  nlcwfs::Setup setup(configuration);
  const DesignTrial trial = trial_of(setup, ScreenSource(configuration), setup.options.precision,
                                     cost_of(configuration, false));
  const Performance first = trial.conditions().front().simulation->follow(design_of(configuration));
  const std::vector<CsvRow> rows = reference_rows("figure-7-paper.csv");
  const std::vector<double>& today = first.screens.front().residual_after_loops;
  ASSERT_EQ(today.size(), rows.size());
  for (std::size_t loop = 0; loop < rows.size(); ++loop) {
    expect_same(1e9 * today[loop], number(rows[loop], "screen_0_nm"));
  }
}

TEST(ReferenceRun, NumericsAreWhatTheCodeGives) {
  const std::vector<CsvRow> rows = reference_rows("numerics.csv");
  for (const std::string run :
       {"as-the-paper/four-planes-6", "window-2/without-p1", "stopping-difference/fifth-plane"}) {
    SCOPED_TRACE(run);
    const auto row = std::ranges::find_if(
        rows, [&](const CsvRow& r) { return r.at("variant") + "/" + r.at("probe") == run; });
    ASSERT_NE(row, rows.end());
    expect_same_means(configuration_of("numerics/" + run), *row, {"residual_wfe_nm", "loops"},
                      "simulation.precision");
  }
}

}  // namespace
}  // namespace nlcwfs
