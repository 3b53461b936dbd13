// Figure 3: residual and loops over the distances of the near and the far pair.
#include "results/text/design_text.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/map_report.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace nlcwfs {
namespace {

/// D/r0 of the maps.
constexpr std::array map_ratios{4, 6, 8};

void add_runs(Plan& plan, StudySetup setup) {
  for (const int ratio : map_ratios) {
    plan.add_map(run_folder("figure-3", setup, fmt::format("{}", ratio)), setup, ratio, "1234");
  }
  plan.add_design(setup, "four-planes", {0, 1, 2, 3});
  plan.add_design(setup, "pairs-exchanged", {2, 3, 0, 1});
}

/// D/r0 to the right.
void add_section(MarkdownReport& report, const ReproducedRuns& reproduced) {
  for (const StudySetup setup : setups) {
    Cells heads;
    std::vector<Cells> columns;
    for (const int ratio : map_ratios) {
      heads.push_back(fmt::format("D/r0 = {}", ratio));
      columns.push_back(draw_maps(report, SetupRuns(reproduced, setup).map(ratio), ratio,
                                  fmt::format("Four planes, D/r0 = {}, {}", ratio, title_of(setup)),
                                  file_name("figure-3", setup, fmt::format("{}", ratio))));
    }
    report.add_columns(setup, heads, columns);
  }
}

// The claims --------------------------------------------------------------------------------------

bool is_any(double /*near*/, double /*far*/) { return true; }

/// What a share of some designs is below, of residual and of loops.
struct Quantiles {
  double residual;  ///< nm
  double loops;

  Quantiles(const PlaneMap& map, const PlaneMap::Condition& wanted, double share)
      : residual(quantile(map.values_of("residual_wfe_nm", wanted), share)),
        loops(quantile(map.values_of("loops", wanted), share)) {}
};

/// A verdict that needs recommended designs, which coarse maps may not have.
ClaimVerdict with_recommended(const SetupRuns& runs, ClaimVerdict verdict) {
  const bool all_have_some = std::ranges::all_of(map_ratios, [&](int ratio) {
    return !runs.map(ratio).values_of("loops", recommended(ratio)).empty();
  });
  return all_have_some ? verdict : ClaimVerdict::open;
}

ClaimFinding poor_region(const SetupRuns& runs,
                         bool (*is_poor)(double near, double far, double step)) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const PlaneMap map = runs.map(ratio);
    const double step = map.near()[1] - map.near()[0];
    const auto is_here = [&](double near, double far) { return is_poor(near, far, step); };
    const Quantiles here(map, is_here, 0.5);
    const Quantiles good(map, recommended(ratio), 0.5);
    return std::tuple(here.residual, here.loops, good.residual, good.loops);
  });
  const auto is_poor_at = [](double residual, double loops, double, double) {
    return residual > 200.0 && loops > 10.0;
  };
  const auto is_worse_at = [](double residual, double loops, double good, double good_loops) {
    return residual > 3.0 * good && loops > 1.2 * good_loops;
  };
  return {found.text("{:.3g} nm, {:.1f} loops (recommended: {:.3g}, {:.1f})"),
          with_recommended(runs, verdict_of(found.fulfil(is_poor_at), found.fulfil(is_worse_at)))};
}

ClaimFinding too_near(const SetupRuns& runs) {
  return poor_region(runs, [](double near, double far, double step) {
    return near < 1.5 * step && far >= 100 * km;
  });
}

ClaimFinding too_close_together(const SetupRuns& runs) {
  return poor_region(runs, [](double near, double far, double step) {
    return far - near < 0.5 * step && near >= 50 * km;
  });
}

ClaimFinding low_region(const SetupRuns& runs) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const PlaneMap map = runs.map(ratio);
    const Quantiles medians(map, recommended(ratio), 0.5);
    return std::tuple(median_text(map.values_of("residual_wfe_nm", recommended(ratio))),
                      median_text(map.values_of("loops", recommended(ratio))), medians.residual,
                      medians.loops);
  });
  const auto within = [&](double slack) {
    return found.fulfil([&](const auto&, const auto&, double residual, double loops) {
      return residual >= 5.0 / slack && residual <= 10.0 * slack && loops >= 3.0 / slack &&
             loops <= 5.0 * slack;
    });
  };
  return {found.text("{} nm, {} loops"),
          with_recommended(runs, verdict_of(within(1.2), within(2.0)))};
}

/// How far a metric rises beyond the valley, over its value there.
double rise_beyond_valley(const PlaneMap& map, const char* metric) {
  const std::size_t valley = map.valley();
  double highest = 0.0;
  for (std::size_t near = valley; near < map.near().size(); ++near) {
    highest = std::fmax(highest, map.median_at_near(metric, near));
  }
  return highest / map.median_at_near(metric, valley);
}

ClaimFinding valley_is_of_loops(const SetupRuns& runs) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const PlaneMap map = runs.map(ratio);
    return std::tuple(rise_beyond_valley(map, "loops"), rise_beyond_valley(map, "residual_wfe_nm"));
  });
  const bool is_deep = found.fulfil([](double loops, double) { return loops > 1.1; });
  const bool is_faint = found.fulfil(
      [](double loops, double residual) { return residual > 1.0 && residual < loops; });
  return {found.text("loops rise {:.2f} times, the residual {:.2f} times"),
          verdict_of(is_deep && is_faint, is_deep)};
}

double valley_of(const PlaneMap& map) { return map.near()[map.valley()]; }

ClaimFinding valley_at_talbot_distance(const SetupRuns& runs) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    return std::tuple(valley_of(runs.map(ratio)) / talbot_distance_of_seeing(ratio));
  });
  const auto within = [&](double factor) {
    return found.fulfil([&](double here) { return here > 1.0 / factor && here < factor; });
  };
  return {found.text("{:.2f} Z_T"), verdict_of(within(1.5), within(2.5))};
}

/// Whether distances fall from D/r0 to D/r0; in trend, from the first to the last.
ClaimVerdict falling(const std::vector<double>& distances) {
  return verdict_of(distances[0] > distances[1] && distances[1] > distances[2],
                    distances[0] > distances[2]);
}

ClaimFinding valley_moves_in(const SetupRuns& runs) {
  std::vector<double> all;
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    all.push_back(valley_of(runs.map(ratio)));
    return std::tuple(all.back() / km);
  });
  return {found.text("{:.3g} km"), falling(all)};
}

/// @param verdict  of the least Z_far at D/r0 = 4, 6 and 8
ClaimFinding of_least_far(const SetupRuns& runs,
                          ClaimVerdict (*verdict)(const std::vector<double>& far)) {
  std::vector<double> all;
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const double talbot = talbot_distance_of_seeing(ratio);
    const std::optional<double> far = runs.map(ratio).least_good_far(talbot);
    if (far) all.push_back(*far);
    return std::tuple(far ? fmt::format("{:.3g} km = {:.1f} Z_T", *far / km, *far / talbot)
                          : "none on this map");
  });
  return {found.text("{}"), all.size() == map_ratios.size() ? verdict(all) : ClaimVerdict::open};
}

ClaimFinding valley_moves_in_far_too(const SetupRuns& runs) { return of_least_far(runs, falling); }

ClaimFinding least_far_is_at(const SetupRuns& runs) {
  return of_least_far(runs, [](const std::vector<double>& found) {
    const auto within = [&](double slack) {
      return std::ranges::all_of(
          found, [&](double far) { return far >= 100 * km / slack && far <= 200 * km * slack; });
    };
    return verdict_of(within(1.1), within(1.8));
  });
}

ClaimFinding no_multiple_of_talbot_distance(const SetupRuns& runs) {
  return of_least_far(runs, [](const std::vector<double>& far) {
    const double growth =
        far[2] / talbot_distance_of_seeing(8) / (far[0] / talbot_distance_of_seeing(4));
    const auto changes = [&](double factor) { return growth > factor || growth < 1 / factor; };
    return verdict_of(changes(1.5), changes(1.2));
  });
}

// A design's residual and loops are near the best of its map where they are below twice and below
// 1.25 times what a tenth of the map's designs are below.

ClaimFinding two_rules_suffice(const SetupRuns& runs) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const PlaneMap map = runs.map(ratio);
    const Quantiles best(map, is_any, 0.1);
    const Quantiles most(map, recommended(ratio), 0.9);
    return std::tuple(most.residual / best.residual, most.loops / best.loops);
  });
  const auto within = [&](double most_residual, double most_loops) {
    return found.fulfil([&](double residual, double loops) {
      return residual < most_residual && loops < most_loops;
    });
  };
  return {found.text("{:.2f} times the residual, {:.2f} times the loops"),
          with_recommended(runs, verdict_of(within(2.0, 1.25), within(4.0, 1.6)))};
}

ClaimFinding wide_range(const SetupRuns& runs) {
  const FoundAtRatios found(map_ratios, [&](int ratio) {
    const PlaneMap map = runs.map(ratio);
    const Quantiles best(map, is_any, 0.1);
    const std::vector<double> residuals = map.values_of("residual_wfe_nm", is_any);
    const std::vector<double> loops = map.values_of("loops", is_any);
    std::size_t good = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (residuals[i] < 2.0 * best.residual && loops[i] < 1.25 * best.loops) ++good;
    }
    const double share = double(good) / double(loops.size());
    return std::tuple(share, 100.0 * share);
  });
  const auto above = [&](double least) {
    return found.fulfil([&](double share, double) { return share > least; });
  };
  return {found.text("{1:.0f} % of the map"), verdict_of(above(0.1), above(0.03))};
}

ClaimFinding pairs_exchange(const SetupRuns& runs) {
  const auto text = [&](const std::string& design) {
    return fmt::format("{} nm, {} loops", with_error(runs.design(design, "residual_wfe_nm")),
                       with_error(runs.design(design, "loops")));
  };
  const auto difference = [&](const char* metric) {
    return runs.above_four_planes("pairs-exchanged", metric);
  };
  const auto within = [&](const char* metric, double share) {
    const MeanAndError found = difference(metric);
    return std::abs(found.mean) + 2.0 * found.standard_error <
           share * runs.design("four-planes", metric).mean;
  };
  // Neither different nor the same: there are too few wavefronts.
  const auto is_clear = [&](const char* metric) {
    const MeanAndError found = difference(metric);
    return std::abs(found.mean) > 2.0 * found.standard_error || within(metric, 0.3);
  };
  const auto both_within = [&](double share) {
    return within("residual_wfe_nm", share) && within("loops", share);
  };
  const bool is_told = is_clear("residual_wfe_nm") && is_clear("loops");
  return {fmt::format("near pair first {}; far pair first {}: {} nm and {} loops more, wavefront "
                      "by wavefront",
                      text("four-planes"), text("pairs-exchanged"),
                      with_error(difference("residual_wfe_nm")), with_error(difference("loops"))),
          is_told ? verdict_of(both_within(0.1), both_within(0.3)) : ClaimVerdict::open};
}

/// Long, as it is the table of them.
std::vector<ClaimRule> claims() {
  constexpr std::string_view by_chance =
      "rms_change ends where the RMS passes an extremum, right or not, so residuals scatter";
  constexpr std::string_view far_why =
      "without the low frequencies that only far planes show, the loop takes longer";
  constexpr std::string_view extended_far_why =
      "far planes lose light beyond the detector's window, so nearer ones are better";
  return {
      {"Planes very close to the pupil reconstruct poorly.", "over 200 nm, over 10 loops",
       "both for each D/r0 at the smallest Z_near, as medians; trend: 3 times the residual and 1.2 "
       "times the loops of the recommended designs",
       too_near,
       "at Z_near = 8 km the far pair still sees the low frequencies; the paper's axis may begin "
       "nearer",
       "the same; stopping by difference, the loop goes on for longer"},
      {"Near and far planes close together reconstruct poorly.", "over 200 nm, over 10 loops",
       "both for each D/r0 where the pairs coincide beyond 50 km, as medians; trend: as above",
       too_close_together,
       "two coinciding pairs are a two-plane sensor, which rms_change leaves early",
       "two coinciding pairs are a two-plane sensor: it does not converge in 20 loops"},
      {"Recommended designs are accurate and quick.", "5 to 10 nm, 3 to 5 loops",
       "the medians within a fifth of these for each D/r0; trend: a factor 2", low_region,
       by_chance,
       "difference ends later than rms_change, and the light beyond the window sets the residual"},
      {"The valley shows in the loops, and faintly in the residual.", "faintly",
       "for each D/r0 the loops rise by a tenth beyond the valley, the residual less; trend: the "
       "loops do",
       valley_is_of_loops,
       "the valley is where both are low; beyond it the residual rises more than the loops",
       "beyond the valley the residual rises more than the loops"},
      {"The valley lies at the Talbot distance of r0.", "1 Z_T",
       "within a factor 1.5 for each D/r0; trend: 2.5", valley_at_talbot_distance,
       "the valley moves in more slowly than Z_T, which goes with (r0/D)^2",
       "the best near pair stays at 20 to 40 km whatever the seeing"},
      {"The valley moves towards the pupil as D/r0 grows.", "from 4 to 8",
       "nearer at each step; trend: nearer at 8 than at 4", valley_moves_in,
       "finer aberrations show nearer to the pupil",
       "the best near pair stays at 20 to 40 km whatever the seeing"},
      {"The valley moves in partly in Z_far too.", "from 4 to 8",
       "the least good Z_far is nearer at each step; trend: nearer at 8 than at 4",
       valley_moves_in_far_too, far_why, extended_far_why},
      {"The least optimal Z_far.", "100 to 200 km",
       "within a tenth of that range for each D/r0; trend: a factor 1.8", least_far_is_at, far_why,
       extended_far_why},
      {"The least optimal Z_far is no multiple of the Talbot distance.", "no easy multiple",
       "in Z_T it changes by half from D/r0 = 4 to 8; trend: by a fifth",
       no_multiple_of_talbot_distance, far_why, extended_far_why},
      {"Z_near at the Talbot distance and Z_far beyond 100 to 200 km are all that it takes.",
       "optimal or near it",
       "nine tenths of the recommended designs are below twice the residual and 1.25 times the "
       "loops that a tenth of the map is below; trend: 4 and 1.6 times",
       two_rules_suffice, by_chance,
       "the low frequencies decide as soon as the near pair is right"},
      {"Optimal distances encompass a wide range.", "wide",
       "over a tenth of the map is below twice the residual and 1.25 times the loops that a tenth "
       "of it is below; trend: 3 %",
       wide_range, "the valley is broad"},
      {"Near and far pair may be exchanged.", "the same",
       "at 47 and 180 km the same within a tenth, with two standard errors; trend: three tenths; "
       "cannot be told where the errors are wider than that",
       pairs_exchange, "the order in which planes are read is part of the loop",
       "the order in which planes are read is part of the loop: far pair first takes fewer loops"}};
}

}  // namespace

PaperFigure reproduced_figure_3() {
  return {.name = "3",
          .heading = "Figure 3: four planes",
          .text =
              "In the order -near, +near, -far, +far. Residual WFE above, loops below, "
              "over Z_far (right) and Z_near (up); lines: the Talbot distance of r0. Where "
              "Z_near is larger than Z_far the designs are left out, as in the paper.",
          .plan = add_runs,
          .report = add_section,
          .claims = claims()};
}

}  // namespace nlcwfs
