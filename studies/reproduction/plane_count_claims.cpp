#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/claim_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr int ratio = 4;
constexpr std::array<const char*, 2> three_planes{"without-p3", "without-p1"};

/// A figure of the designs that the paper recommends.
std::vector<double> of_four(const SetupRuns& runs, const char* figure) {
  return runs.map(ratio).values_of(figure, recommended(ratio));
}
std::vector<double> of_three(const SetupRuns& runs, const char* name, const char* figure) {
  return runs.three_plane_map(name).values_of(figure, recommended(ratio));
}

std::string medians_text(const SetupRuns& runs, const char* figure, const char* unit) {
  return fmt::format("without P3 {}{unit}, without P1 {}{unit}, four planes {}{unit}",
                     median_text(of_three(runs, "without-p3", figure)),
                     median_text(of_three(runs, "without-p1", figure)),
                     median_text(of_four(runs, figure)), fmt::arg("unit", unit));
}

ClaimFinding three_planes_are_as_accurate(const SetupRuns& runs) {
  const double four = quantile(of_four(runs, "residual_wfe_nm"), 0.5);
  const auto within = [&](double factor) {
    return std::ranges::all_of(three_planes, [&](const char* name) {
      return quantile(of_three(runs, name, "residual_wfe_nm"), 0.5) < factor * four;
    });
  };
  return {medians_text(runs, "residual_wfe_nm", " nm"), verdict_of(within(1.5), within(3.0))};
}

/// At the paper's distances, wavefront by wavefront.
ClaimFinding three_planes_take_more(const SetupRuns& runs, const char* metric, const char* unit) {
  const auto is_above = [&](const char* name) {
    return is_clearly_positive(runs.design_difference(name, "four-planes", metric));
  };
  const auto more = [&](const char* name) {
    return with_error(runs.design_difference(name, "four-planes", metric));
  };
  return {fmt::format("at 47 and 180 km without P3 {}{unit} more, without P1 {}{unit} more than {}",
                      more("without-p3"), more("without-p1"),
                      with_error(runs.design("four-planes", metric)), fmt::arg("unit", unit)),
          verdict_of(std::ranges::all_of(three_planes, is_above),
                     std::ranges::any_of(three_planes, is_above))};
}

ClaimFinding three_planes_take_more_loops(const SetupRuns& runs) {
  return three_planes_take_more(runs, "loops", "");
}

ClaimFinding three_planes_take_longer(const SetupRuns& runs) {
  return three_planes_take_more(runs, "fft_count", " transforms");
}

ClaimFinding time_per_loop(const SetupRuns& runs) {
  const auto per_loop = [&](const char* design, const char* metric) {
    return runs.design(design, metric).mean / runs.design(design, "loops").mean;
  };
  const auto share = [&](const char* design, const char* metric) {
    return per_loop(design, metric) / per_loop("four-planes", metric);
  };
  const auto within = [&](double least, double most) {
    return std::ranges::all_of(three_planes, [&](const char* design) {
      return share(design, "seconds") > least && share(design, "seconds") < most;
    });
  };
  return {
      fmt::format("{:.0f} % (without P3) and {:.0f} % (without P1) of the measured time, "
                  "{:.0f} % of the transforms",
                  100.0 * share("without-p3", "seconds"), 100.0 * share("without-p1", "seconds"),
                  100.0 * share("without-p3", "fft_count")),
      verdict_of(within(0.8, 0.95), within(0.0, 1.0))};
}

/// The scan of the fifth plane.
class FifthPlane {
 public:
  explicit FifthPlane(const SetupRuns& runs) : grid_(runs.summary("figure-5", "").at("grid")) {
    for (const Json& axis : grid_.at("axes")) {
      if (axis.at("name") == "z5") distances_ = axis.at("values").get<std::vector<double>>();
    }
  }

  /// Where a hop of the loop has no length.
  bool is_zero_hop(std::size_t i) const {
    return distances_[i] == 0.0 || distances_[i] == 180 * km;
  }

  std::vector<double> all(const char* figure) const { return numbers_from_json(grid_.at(figure)); }

  /// Without these places.
  std::vector<double> values(const char* figure) const {
    std::vector<double> values = all(figure);
    for (std::size_t i = values.size(); i-- > 0;) {
      if (is_zero_hop(i)) values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return values;
  }

  /// Of each place without a length: by how much it is above the mean of its neighbours. Errors are
  /// as if the designs did not share their wavefronts.
  std::vector<MeanAndError> above_neighbours(const char* figure) const {
    const std::vector<double> means = all(figure);
    const std::vector<double> errors = numbers_from_json(grid_.at("standard_error").at(figure));
    std::vector<MeanAndError> found;
    for (std::size_t i = 1; i + 1 < means.size(); ++i) {
      if (!is_zero_hop(i)) continue;
      found.push_back({means[i] - 0.5 * (means[i - 1] + means[i + 1]),
                       std::hypot(errors[i], 0.5 * std::hypot(errors[i - 1], errors[i + 1]))});
    }
    return found;
  }

 private:
  const Json& grid_;
  std::vector<double> distances_;
};

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
  const double typical = quantile(runs.screens("designs", "four-planes", "residual_wfe_nm"), 0.5);
  return {
      fmt::format("{} nm (median {:.2g}), {} loops on {} wavefronts", with_error(residual), typical,
                  with_error(loops), runs.screens("designs", "four-planes", "loops").size()),
      verdict_of(within(1.25), within(2.0))};
}

ClaimFinding fifth_plane_gains_little(const SetupRuns& runs) {
  const FifthPlane scan(runs);
  const double residual = quantile(scan.values("residual_wfe_nm"), 0.5);
  const double loops = quantile(scan.values("loops"), 0.5);
  const double four_residual = quantile(of_four(runs, "residual_wfe_nm"), 0.5);
  const double four_loops = quantile(of_four(runs, "loops"), 0.5);
  const bool is_no_quicker = loops > 0.95 * four_loops;
  return {fmt::format("{:.3g} nm and {:.2f} loops; recommended four planes {:.3g} nm and {:.2f}",
                      residual, loops, four_residual, four_loops),
          verdict_of(is_no_quicker && residual > 0.75 * four_residual,
                     is_no_quicker || residual > 0.75 * four_residual)};
}

ClaimFinding fifth_plane_takes_longer(const SetupRuns& runs) {
  const double five = quantile(FifthPlane(runs).values("fft_count"), 0.5);
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
  const double four = quantile(of_four(runs, "fft_count"), 0.5);
  const double without_p3 = quantile(of_three(runs, "without-p3", "fft_count"), 0.5);
  const double without_p1 = quantile(of_three(runs, "without-p1", "fft_count"), 0.5);
  const double five = quantile(FifthPlane(runs).values("fft_count"), 0.5);
  const auto beaten = std::ranges::count_if(std::array{without_p3, without_p1, five},
                                            [&](double other) { return other > four; });
  return {
      fmt::format("medians: four planes {:.1f} transforms, three {:.1f} (without P3) and {:.1f} "
                  "(without P1), five {:.1f}",
                  four, without_p3, without_p1, five),
      verdict_of(beaten == 3, beaten == 2)};
}

}  // namespace

std::vector<ClaimRule> plane_count_claims() {
  return {
      {"4", "Three planes are about as accurate as four.", "comparable",
       "the recommended designs' median residual is below 1.5 times that of four planes; trend: 3 "
       "times",
       three_planes_are_as_accurate,
       "with one plane fewer, more wavefronts stop early by rms_change, far from the truth",
       "with one plane fewer, more light and more frequencies go unseen"},
      {"4", "Three planes take more loops.", "more",
       "by two standard errors both without P3 and without P1; trend: one of them",
       three_planes_take_more_loops, "less information in each loop",
       "less information in each loop"},
      {"4", "A three-plane loop takes less time than a four-plane loop.", "88 %",
       "80 to 95 % of the measured time for both; trend: below 100 %", time_per_loop,
       "four hops of two transforms instead of five, and what does not depend on the planes",
       "four hops of two transforms instead of five, and what does not depend on the planes"},
      {"4", "Three planes take longer in all.", "longer",
       "more transforms by two standard errors both without P3 and without P1; trend: one of them",
       three_planes_take_longer,
       "a fifth fewer transforms in a loop: a quarter more loops are needed to lose",
       "a fifth fewer transforms in a loop: a quarter more loops are needed to lose"},
      {"5", "A fifth plane between the last and the pupil.", "3 to 14 nm, 4 to 5 loops",
       "eight tenths of the scan within a factor 1.2 of these; trend: 2", five_planes_range,
       "rms_change decides both",
       "difference goes on for longer, and ends lower where the light is "
       "in the window"},
      {"5", "Four planes at 47 and 180 km.", "6.5 nm, 4.2 loops",
       "both within a factor 1.25; trend: 2", four_planes_at_papers_distances,
       "a few wavefronts that rms_change ends early make the mean; most end far below it",
       "difference ends later than rms_change"},
      {"5", "The fifth plane gains little.", "little, and no loops",
       "the scan's median is above 0.75 times the recommended four planes' residual and 0.95 times "
       "their loops; trend: one of them",
       fifth_plane_gains_little, "four planes have most of the information",
       "a fifth plane adds information to each loop"},
      {"5", "Five planes take longer than four.", "longer",
       "the scan's median has more transforms by two standard errors; trend: more",
       fifth_plane_takes_longer, "six hops instead of five", "six hops instead of five"},
      {"5", "Where the fifth plane is at the pupil or at P4 the results are off.", "gaps and peaks",
       "above the neighbours by two standard errors in residual and loops at both; trend: in the "
       "loops of one",
       zero_hops_break, "a hop of no length is left out here: nothing breaks",
       "nothing breaks, but a plane at the pupil shows no phase and only costs"},
      {"5", "Four planes are the best overall choice.", "quicker than three and five",
       "the fewest transforms, as medians; trend: fewer than two of the three others",
       four_planes_are_best, "loops against transforms in a loop",
       "loops against transforms in a loop"}};
}

}  // namespace nlcwfs
