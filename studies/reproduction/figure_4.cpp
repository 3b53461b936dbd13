// Figure 4: three planes beside four.
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/map_report.hpp"

#include <array>

namespace nlcwfs {
namespace {

constexpr std::array<const char*, 2> three_planes{"without-p3", "without-p1"};

void add_runs(Plan& plan, StudySetup setup) {
  plan.add_plane_count_maps(setup);
  // One after the other, so that their times compare.
  plan.add_design(setup, "four-planes", {0, 1, 2, 3});
  plan.add_design(setup, "without-p3", {0, 1, 3});
  plan.add_design(setup, "without-p1", {1, 2, 3});
}

/// With the time as the paper has it: the loops, by the time that one takes.
void add_section(MarkdownReport& report, const ReproducedRuns& reproduced) {
  struct Column {
    const char* head;
    const char* design;
    bool is_figure_3s;
  };
  for (const StudySetup setup : setups) {
    const SetupRuns runs(reproduced, setup);
    Cells heads;
    std::vector<Cells> columns;
    for (const auto& [head, design, is_figure_3s] :
         {Column{"without P3", "without-p3", false}, Column{"without P1", "without-p1", false},
          Column{"four planes", "four-planes", true}}) {
      const double milliseconds =
          1e3 * runs.design(design, "seconds").mean / runs.design(design, "loops").mean;
      heads.push_back(fmt::format("{}, {:.3g} ms a loop", head, milliseconds));
      const std::string title = fmt::format("{}, D/r0 = 4, {}", head, title_of(setup));
      const PlaneMap map = is_figure_3s ? runs.map(4) : runs.three_plane_map(design);
      columns.push_back(draw_maps(
          report, map, 4, title,
          is_figure_3s ? file_name("figure-3", setup, "4") : file_name("figure-4", setup, design)));
      columns.back().push_back(draw_map(report, map,
                                        {"loops", "approximate time, ms", "ms", milliseconds}, 4,
                                        title, file_name("figure-4", setup, design) + "-time"));
    }
    report.add_columns(setup, heads, columns);
  }
}

// The claims --------------------------------------------------------------------------------------

ClaimFinding three_planes_are_as_accurate(const SetupRuns& runs) {
  const char* metric = "residual_wfe_nm";
  const std::vector<double> four = of_four_planes(runs, metric);
  const auto within = [&](double factor) {
    return std::ranges::all_of(three_planes, [&](const char* name) {
      return quantile(of_three_planes(runs, name, metric), 0.5) < factor * quantile(four, 0.5);
    });
  };
  return {fmt::format("without P3 {} nm, without P1 {} nm, four planes {} nm",
                      median_text(of_three_planes(runs, "without-p3", metric)),
                      median_text(of_three_planes(runs, "without-p1", metric)), median_text(four)),
          verdict_of(within(1.5), within(3.0))};
}

/// At the paper's distances, wavefront by wavefront.
ClaimFinding three_planes_take_more(const SetupRuns& runs, const char* metric, const char* unit) {
  const auto is_above = [&](const char* name) {
    return is_clearly_positive(runs.above_four_planes(name, metric));
  };
  const auto more = [&](const char* name) {
    return with_error(runs.above_four_planes(name, metric));
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

}  // namespace

PaperFigure reproduced_figure_4() {
  return {
      .name = "4",
      .heading = "Figure 4: three planes",
      .text =
          "D/r0 = 4. Residual WFE, loops, and the loops by the time that one takes on this "
          "machine, measured at 47 and 180 km.",
      .plan = add_runs,
      .report = add_section,
      .claims = {
          {"Three planes are about as accurate as four.", "comparable",
           "the recommended designs' median residual is below 1.5 times that of four planes; "
           "trend: 3 times",
           three_planes_are_as_accurate,
           "with one plane fewer, more wavefronts stop early by rms_change, far from the truth",
           "with one plane fewer, more light and more frequencies go unseen"},
          {"Three planes take more loops.", "more",
           "by two standard errors both without P3 and without P1; trend: one of them",
           three_planes_take_more_loops, "less information in each loop"},
          {"A three-plane loop takes less time than a four-plane loop.", "88 %",
           "80 to 95 % of the measured time for both; trend: below 100 %", time_per_loop,
           "four hops of two transforms instead of five, and what does not depend on the planes"},
          {"Three planes take longer in all.", "longer",
           "more transforms by two standard errors both without P3 and without P1; trend: one of "
           "them",
           three_planes_take_longer,
           "a fifth fewer transforms in a loop: a quarter more loops are needed to lose"}}};
}

}  // namespace nlcwfs
