// Figure 5: a fifth plane between the paper's last and the pupil.
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"

#include <array>
#include <cmath>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// The paper's last plane, m.
constexpr double last_plane = 180 * km;

/// Between the last and the pupil, and on both of these.
std::string fifth_planes(int half_count) {
  std::vector<double> planes;
  for (int i = -half_count; i <= half_count; ++i) {
    planes.push_back(farthest * i / half_count);
  }
  const auto after = std::ranges::lower_bound(planes, last_plane);
  if (*after != last_plane) planes.insert(after, last_plane);
  return list_text(planes);
}

void add_runs(Plan& plan, StudySetup setup) {
  Configuration configuration = plan.base(setup);
  const std::vector<double> planes = configuration.lengths("sensor.planes");
  Settings values{{"sweep.layout", "free"},
                  {"sweep.z5", fifth_planes(plan.given().integer("reproduce.grid"))}};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    values.emplace_back(fmt::format("sweep.z{}", i + 1), fmt::format("{}", planes[i]));
  }
  plan.add(run_folder("figure-5", setup), "sweep", std::move(configuration), values);
  plan.add_design(setup, "four-planes", {0, 1, 2, 3});
  plan.add_plane_count_maps(setup);  // which its claims compare it with
}

/// The scan of the fifth plane.
class FifthPlane {
 public:
  explicit FifthPlane(const SetupRuns& runs)
      : grid_(runs.summary("figure-5", "").at("grid")), distances_(axis_values(grid_, "z5")) {}

  /// m
  const std::vector<double>& distances() const { return distances_; }

  /// Where a hop of the loop has no length.
  bool is_zero_hop(std::size_t i) const {
    return distances_[i] == 0.0 || distances_[i] == last_plane;
  }

  std::vector<double> all(const char* metric) const { return numbers_from_json(grid_.at(metric)); }
  std::vector<double> errors(const char* metric) const {
    return numbers_from_json(grid_.at("standard_error").at(metric));
  }

  /// Without these places.
  std::vector<double> values(const char* metric) const {
    std::vector<double> values = all(metric);
    for (std::size_t i = values.size(); i-- > 0;) {
      if (is_zero_hop(i)) values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return values;
  }

  double median(const char* metric) const { return quantile(values(metric), 0.5); }

  /// Of each place without a length: by how much it is above the mean of its neighbours. Errors are
  /// as if the designs did not share their wavefronts.
  std::vector<MeanAndError> above_neighbours(const char* metric) const {
    const std::vector<double> means = all(metric);
    const std::vector<double> error = errors(metric);
    std::vector<MeanAndError> found;
    for (std::size_t i = 1; i + 1 < means.size(); ++i) {
      if (!is_zero_hop(i)) continue;
      found.push_back({means[i] - 0.5 * (means[i - 1] + means[i + 1]),
                       std::hypot(error[i], 0.5 * std::hypot(error[i - 1], error[i + 1]))});
    }
    return found;
  }

 private:
  const Json& grid_;
  std::vector<double> distances_;
};

void add_section(MarkdownReport& report, const ReproducedRuns& reproduced) {
  for (const StudySetup setup : setups) {
    const SetupRuns runs(reproduced, setup);
    const FifthPlane scan(runs);
    const auto draw = [&](const char* metric, const char* label, const std::string& name) {
      Curve five{.label = "five planes", .y = scan.all(metric), .spread = scan.errors(metric)};
      for (const double distance : scan.distances()) five.x.push_back(distance / km);
      const double four = runs.design("four-planes", metric).mean;
      const Curve line{.label = "four planes",
                       .x = {five.x.front(), five.x.back()},
                       .y = {four, four},
                       .colour = 1};
      return report.draw(file_name("figure-5", setup, name),
                         CurvePicture{.title = fmt::format("Fifth plane, {}", title_of(setup)),
                                      .x_label = "Z of the fifth plane, km",
                                      .y_label = label,
                                      .curves = {five, line}});
    };
    report.add_columns(setup, {"residual WFE", "loops"},
                       {{draw("residual_wfe_nm", "residual WFE, nm", "residual_wfe")},
                        {draw("loops", "loops", "loops")}});
    CsvTable table({"z5_m", "residual_wfe_nm", "residual_wfe_standard_error_nm", "loops",
                    "loops_standard_error"});
    for (std::size_t i = 0; i < scan.distances().size(); ++i) {
      table.row().add(scan.distances()[i]);
      for (const char* metric : {"residual_wfe_nm", "loops"}) {
        table.add(scan.all(metric)[i]).add(scan.errors(metric)[i]);
      }
    }
    report.write(file_name("figure-5", setup), table);
  }
}

// The claims --------------------------------------------------------------------------------------

ClaimFinding five_planes_range(const SetupRuns& runs) {
  const FifthPlane scan(runs);
  const std::vector<double> residuals = scan.values("residual_wfe_nm");
  const std::vector<double> loops = scan.values("loops");
  const auto within = [&](double slack) {
    return quantile(residuals, 0.1) > 3.0 / slack && quantile(residuals, 0.9) < 14.0 * slack &&
           quantile(loops, 0.1) > 4.0 / slack && quantile(loops, 0.9) < 5.0 * slack;
  };
  return {fmt::format("{} nm, {} loops", median_text(residuals), median_text(loops)),
          verdict_of(within(1.2), within(2.0))};
}

ClaimFinding four_planes_at_papers_distances(const SetupRuns& runs) {
  const MeanAndError residual = runs.design("four-planes", "residual_wfe_nm");
  const MeanAndError loops = runs.design("four-planes", "loops");
  const auto within = [&](double slack) {
    return std::abs(std::log(residual.mean / 6.5)) < std::log(slack) &&
           std::abs(std::log(loops.mean / 4.2)) < std::log(slack);
  };
  const std::vector<double> residuals = runs.screens("designs", "four-planes", "residual_wfe_nm");
  return {fmt::format("{} nm (median {:.2g}), {} loops on {} wavefronts", with_error(residual),
                      quantile(residuals, 0.5), with_error(loops), residuals.size()),
          verdict_of(within(1.25), within(2.0))};
}

ClaimFinding fifth_plane_gains_little(const SetupRuns& runs) {
  const FifthPlane scan(runs);
  const double residual = scan.median("residual_wfe_nm");
  const double loops = scan.median("loops");
  const double four_residual = quantile(of_four_planes(runs, "residual_wfe_nm"), 0.5);
  const double four_loops = quantile(of_four_planes(runs, "loops"), 0.5);
  const bool is_no_quicker = loops > 0.95 * four_loops;
  const bool is_no_better = residual > 0.75 * four_residual;
  return {fmt::format("{:.3g} nm and {:.2f} loops; recommended four planes {:.3g} nm and {:.2f}",
                      residual, loops, four_residual, four_loops),
          verdict_of(is_no_quicker && is_no_better, is_no_quicker || is_no_better)};
}

ClaimFinding fifth_plane_takes_longer(const SetupRuns& runs) {
  const double five = FifthPlane(runs).median("fft_count");
  const MeanAndError four = runs.design("four-planes", "fft_count");
  return {
      fmt::format("{:.1f} transforms; four planes {}", five, with_error(four)),
      verdict_of(is_clearly_positive({five - four.mean, four.standard_error}), five > four.mean)};
}

ClaimFinding zero_hops_break(const SetupRuns& runs) {
  const FifthPlane scan(runs);
  const std::vector<MeanAndError> residuals = scan.above_neighbours("residual_wfe_nm");
  const std::vector<MeanAndError> loops = scan.above_neighbours("loops");
  return {fmt::format("at the pupil {} nm and {} loops more than beside it, at P4 {} nm and {}",
                      with_error(residuals.front()), with_error(loops.front()),
                      with_error(residuals.back()), with_error(loops.back())),
          verdict_of(std::ranges::all_of(residuals, is_clearly_positive) &&
                         std::ranges::all_of(loops, is_clearly_positive),
                     std::ranges::any_of(loops, is_clearly_positive))};
}

ClaimFinding four_planes_are_best(const SetupRuns& runs) {
  const double four = quantile(of_four_planes(runs, "fft_count"), 0.5);
  const double without_p3 = quantile(of_three_planes(runs, "without-p3", "fft_count"), 0.5);
  const double without_p1 = quantile(of_three_planes(runs, "without-p1", "fft_count"), 0.5);
  const double five = FifthPlane(runs).median("fft_count");
  const auto beaten = std::ranges::count_if(std::array{without_p3, without_p1, five},
                                            [&](double other) { return other > four; });
  return {
      fmt::format("medians: four planes {:.1f} transforms, three {:.1f} (without P3) and {:.1f} "
                  "(without P1), five {:.1f}",
                  four, without_p3, without_p1, five),
      verdict_of(beaten == 3, beaten == 2)};
}

}  // namespace

PaperFigure reproduced_figure_5() {
  return {
      .name = "5",
      .heading = "Figure 5: a fifth plane",
      .text =
          "D/r0 = 4, four planes at 47 and 180 km, the fifth read last. Bars are standard "
          "errors; the line is the mean of the four planes alone.",
      .plan = add_runs,
      .report = add_section,
      .claims = {
          {"A fifth plane between the last and the pupil.", "3 to 14 nm, 4 to 5 loops",
           "eight tenths of the scan within a factor 1.2 of these; trend: 2", five_planes_range,
           "rms_change decides both",
           "difference goes on for longer, and ends lower where the light is in the window"},
          {"Four planes at 47 and 180 km.", "6.5 nm, 4.2 loops",
           "both within a factor 1.25; trend: 2", four_planes_at_papers_distances,
           "a few wavefronts that rms_change ends early make the mean; most end far below it",
           "difference ends later than rms_change"},
          {"The fifth plane gains little.", "little, and no loops",
           "the scan's median is above 0.75 times the recommended four planes' residual and 0.95 "
           "times their loops; trend: one of them",
           fifth_plane_gains_little, "four planes have most of the information",
           "a fifth plane adds information to each loop"},
          {"Five planes take longer than four.", "longer",
           "the scan's median has more transforms by two standard errors; trend: more",
           fifth_plane_takes_longer, "six hops instead of five"},
          {"Where the fifth plane is at the pupil or at P4 the results are off.", "gaps and peaks",
           "above the neighbours by two standard errors in residual and loops at both; trend: in "
           "the loops of one",
           zero_hops_break, "a hop of no length is left out here: nothing breaks",
           "nothing breaks, but a plane at the pupil shows no phase and only costs"},
          {"Four planes are the best overall choice.", "quicker than three and five",
           "the fewest transforms, as medians; trend: fewer than two of the three others",
           four_planes_are_best, "loops against transforms in a loop"}}};
}

}  // namespace nlcwfs
