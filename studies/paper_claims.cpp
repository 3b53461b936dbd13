#include "studies/paper_claims.hpp"

#include "model/telescope.hpp"
#include "results/json_numbers.hpp"
#include "studies/design_text.hpp"
#include "studies/plane_map.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <boost/math/statistics/bivariate_statistics.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double km = 1e3;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Telescope papers_telescope{.diameter = 0.5, .wavelength = 532e-9};
/// A difference of so many standard errors counts.
constexpr double clear = 2.0;

double talbot_distance_of_seeing(double d_over_r0) {
  return talbot_distance(papers_telescope.diameter / d_over_r0, papers_telescope.wavelength);
}

/// The first minus the second of independent means.
MeanAndError difference(const MeanAndError& a, const MeanAndError& b) {
  return {a.mean - b.mean, std::hypot(a.standard_error, b.standard_error)};
}

bool is_clearly_above(const MeanAndError& a, const MeanAndError& b) {
  const MeanAndError d = difference(a, b);
  return d.mean > clear * d.standard_error;
}

ClaimVerdict verdict_of(bool reproduced, bool in_trend) {
  if (reproduced) return ClaimVerdict::reproduced;
  return in_trend ? ClaimVerdict::in_trend : ClaimVerdict::not_reproduced;
}

/// The figures of one set-up's runs, as the claims ask for them.
class Findings {
 public:
  Findings(const ReproducedRuns& runs, Setup setup) : runs_(runs), setup_(setup) {}

  const Json& summary(std::string_view figure, const std::string& run) const {
    return runs_.summary(
        fmt::format("{}/{}{}{}", figure, to_string(setup_), run.empty() ? "" : "-", run));
  }
  PlaneMap map(int ratio) const {
    return PlaneMap(summary("figure-3", fmt::format("{}", ratio)).at("grid"));
  }
  const Json& performance(std::string_view figure, const std::string& run) const {
    return summary(figure, run).at("design").at("performance");
  }
  /// A mean of a design at the paper's distances, D/r0 = 4.
  MeanAndError design(const std::string& name, const char* metric) const {
    return mean_from_json(performance("designs", name).at(metric));
  }

 private:
  const ReproducedRuns& runs_;
  Setup setup_;
};

/// One text for each D/r0: "D/r0 = 4: ...; 6: ...".
template <class Text>
std::string for_each_ratio(const Text& text) {
  std::vector<std::string> texts;
  for (const int ratio : map_ratios) texts.push_back(fmt::format("{}: {}", ratio, text(ratio)));
  return fmt::format("D/r0 = {}", fmt::join(texts, "; "));
}

template <class Condition>
bool all_ratios(const Condition& condition) {
  return std::ranges::all_of(map_ratios, condition);
}

using Finder = ClaimFinding (*)(const Findings&);

/// A claim with how it is checked.
struct CheckedClaim {
  std::string_view figure;
  std::string_view sentence;
  std::string_view papers;
  std::string_view rule;
  std::string_view why;
  Finder find;
};

// Figure 3 ----------------------------------------------------------------------------------------

ClaimFinding poor_region(const Findings& findings,
                         bool (*is_poor)(double near, double far, double step)) {
  struct Means {
    double residual;
    double loops;
    double lowest;  ///< residual of the map
  };
  const auto means = [&](int ratio) {
    const PlaneMap map = findings.map(ratio);
    const double step = map.near()[1] - map.near()[0];
    const auto here = [&](double near, double far) { return is_poor(near, far, step); };
    return Means{map.mean_over("residual_wfe_nm", here), map.mean_over("loops", here),
                 map.lowest("residual_wfe_nm")};
  };
  return {for_each_ratio([&](int ratio) {
            const Means found = means(ratio);
            return fmt::format("{:.3g} nm, {:.1f} loops", found.residual, found.loops);
          }),
          verdict_of(all_ratios([&](int ratio) {
                       const Means found = means(ratio);
                       return found.residual > 200.0 && found.loops > 10.0;
                     }),
                     all_ratios([&](int ratio) {
                       const Means found = means(ratio);
                       return found.residual > 3.0 * found.lowest && found.loops > 6.0;
                     }))};
}

ClaimFinding too_near(const Findings& findings) {
  return poor_region(findings, [](double near, double far, double step) {
    return near < 1.5 * step && far >= 100 * km;
  });
}

ClaimFinding too_close_together(const Findings& findings) {
  return poor_region(findings, [](double near, double far, double step) {
    return far - near < 0.5 * step && near >= 50 * km;
  });
}

ClaimFinding low_region(const Findings& findings) {
  struct Lowest {
    MeanAndError residual;
    MeanAndError loops;
  };
  const auto lowest = [&](int ratio) {
    const PlaneMap map = findings.map(ratio);
    const std::size_t near = map.valley();
    const std::size_t far = map.nearest_far(180 * km);
    return Lowest{map.mean("residual_wfe_nm", near, far), map.mean("loops", near, far)};
  };
  const auto within = [&](double slack) {
    return all_ratios([&](int ratio) {
      const Lowest found = lowest(ratio);
      return found.residual.mean >= 5.0 / slack && found.residual.mean <= 10.0 * slack &&
             found.loops.mean >= 3.0 / slack && found.loops.mean <= 5.0 * slack;
    });
  };
  return {for_each_ratio([&](int ratio) {
            const Lowest found = lowest(ratio);
            return fmt::format("{} nm, {} loops", with_error(found.residual),
                               with_error(found.loops));
          }),
          verdict_of(within(1.2), within(2.0))};
}

/// How far a figure rises beyond the valley, over its value there.
double rise_beyond_valley(const PlaneMap& map, const char* figure) {
  const std::size_t valley = map.valley();
  double highest = 0.0;
  for (std::size_t near = valley; near < map.near().size(); ++near) {
    highest = std::fmax(highest, map.mean_at_near(figure, near));
  }
  return highest / map.mean_at_near(figure, valley);
}

ClaimFinding valley_is_of_loops(const Findings& findings) {
  const auto rise = [&](int ratio, const char* figure) {
    return rise_beyond_valley(findings.map(ratio), figure);
  };
  const auto is_deep = [&](int ratio) { return rise(ratio, "loops") > 1.1; };
  const auto is_faint = [&](int ratio) {
    const double residual = rise(ratio, "residual_wfe_nm");
    return residual > 1.0 && residual < rise(ratio, "loops");
  };
  return {for_each_ratio([&](int ratio) {
            return fmt::format("loops rise to {:.2f}, the residual to {:.2f} times the valley's",
                               rise(ratio, "loops"), rise(ratio, "residual_wfe_nm"));
          }),
          verdict_of(all_ratios([&](int ratio) { return is_deep(ratio) && is_faint(ratio); }),
                     all_ratios(is_deep))};
}

ClaimFinding valley_at_talbot_distance(const Findings& findings) {
  const auto in_talbot_distances = [&](int ratio) {
    const PlaneMap map = findings.map(ratio);
    return map.near()[map.valley()] / talbot_distance_of_seeing(ratio);
  };
  const auto within = [&](double factor) {
    return all_ratios([&](int ratio) {
      const double found = in_talbot_distances(ratio);
      return found > 1.0 / factor && found < factor;
    });
  };
  return {for_each_ratio(
              [&](int ratio) { return fmt::format("{:.2f} Z_T", in_talbot_distances(ratio)); }),
          verdict_of(within(1.5), within(2.5))};
}

ClaimFinding valley_moves_in(const Findings& findings) {
  const auto valley = [&](int ratio) {
    const PlaneMap map = findings.map(ratio);
    return map.near()[map.valley()];
  };
  return {for_each_ratio([&](int ratio) { return fmt::format("{:.3g} km", valley(ratio) / km); }),
          verdict_of(valley(4) > valley(6) && valley(6) > valley(8), valley(4) > valley(8))};
}

ClaimFinding least_far(const Findings& findings) {
  const auto within = [&](double slack) {
    return all_ratios([&](int ratio) {
      const double found = findings.map(ratio).least_good_far();
      return found >= 100 * km / slack && found <= 200 * km * slack;
    });
  };
  return {for_each_ratio([&](int ratio) {
            const double found = findings.map(ratio).least_good_far();
            return fmt::format("{:.3g} km = {:.1f} Z_T", found / km,
                               found / talbot_distance_of_seeing(ratio));
          }),
          verdict_of(within(1.1), within(2.0))};
}

ClaimFinding valley_moves_in_far_too(const Findings& findings) {
  const auto far = [&](int ratio) { return findings.map(ratio).least_good_far(); };
  return {for_each_ratio([&](int ratio) { return fmt::format("{:.3g} km", far(ratio) / km); }),
          verdict_of(far(8) < far(4), far(8) == far(4))};
}

ClaimFinding no_multiple_of_talbot_distance(const Findings& findings) {
  const auto multiple = [&](int ratio) {
    return findings.map(ratio).least_good_far() / talbot_distance_of_seeing(ratio);
  };
  const double growth = multiple(8) / multiple(4);
  return {for_each_ratio([&](int ratio) { return fmt::format("{:.1f} Z_T", multiple(ratio)); }),
          verdict_of(growth > 1.5, growth > 1.2)};
}

ClaimFinding two_rules_suffice(const Findings& findings) {
  struct Worst {
    double residual;  ///< over the lowest of the map
    double loops;     ///< over the fewest of the map
  };
  const auto worst = [&](int ratio) {
    const PlaneMap map = findings.map(ratio);
    const double talbot = talbot_distance_of_seeing(ratio);
    const auto is_good = [&](double near, double far) {
      return near > talbot / 1.25 && near < talbot * 1.25 && far >= 150 * km;
    };
    return Worst{map.greatest_over("residual_wfe_nm", is_good) / map.lowest("residual_wfe_nm"),
                 map.greatest_over("loops", is_good) / map.lowest("loops")};
  };
  const auto within = [&](double residual, double loops) {
    return all_ratios([&](int ratio) {
      const Worst found = worst(ratio);
      return found.residual < residual && found.loops < loops;
    });
  };
  return {for_each_ratio([&](int ratio) {
            const Worst found = worst(ratio);
            return fmt::format(
                "at worst {:.2f} times the lowest residual, {:.2f} times the fewest "
                "loops",
                found.residual, found.loops);
          }),
          verdict_of(within(2.0, 1.25), within(4.0, 1.6))};
}

ClaimFinding pairs_exchange(const Findings& findings) {
  const auto text = [&](const std::string& design) {
    return fmt::format("{} nm, {} loops", with_error(findings.design(design, "residual_wfe_nm")),
                       with_error(findings.design(design, "loops")));
  };
  const auto are_equal = [&](const char* metric) {
    const MeanAndError d = difference(findings.design("four-planes", metric),
                                      findings.design("pairs-exchanged", metric));
    return std::abs(d.mean) < clear * d.standard_error;
  };
  const auto are_near = [&](const char* metric) {
    return std::abs(findings.design("pairs-exchanged", metric).mean /
                        findings.design("four-planes", metric).mean -
                    1.0) < 0.05;
  };
  return {fmt::format("near pair first {}; far pair first {}", text("four-planes"),
                      text("pairs-exchanged")),
          verdict_of(are_equal("residual_wfe_nm") && are_equal("loops"),
                     are_near("residual_wfe_nm") && are_near("loops"))};
}

// Text: scaling -----------------------------------------------------------------------------------

ClaimFinding scales_by_fresnel_number(const Findings& findings) {
  double largest = 0.0;
  const auto in_waves = [&](const NamedSettings& telescope, const char* metric) {
    const Json& summary = findings.summary("scaling", telescope.name);
    const double value = summary.at("design").at("performance").at(metric).at("mean");
    if (metric == std::string_view("loops")) return value;
    Configuration configuration;
    configuration.set("telescope.wavelength",
                      summary.at("config").at("telescope.wavelength").get<std::string>(), "there");
    return value / configuration.length("telescope.wavelength");
  };
  const NamedSettings& first = scaled_telescopes().front();
  for (const NamedSettings& telescope : scaled_telescopes()) {
    for (const char* metric : {"residual_wfe_nm", "loops"}) {
      largest =
          std::max(largest, std::abs(in_waves(telescope, metric) / in_waves(first, metric) - 1.0));
    }
  }
  return {
      fmt::format("largest relative difference of residual (in waves) and loops {:.1e}", largest),
      verdict_of(largest < 1e-3, largest < 0.05)};
}

// Figure 4 ----------------------------------------------------------------------------------------

constexpr std::array<const char*, 2> three_planes{"without-p3", "without-p1"};

std::string plane_counts_text(const Findings& findings, const char* metric, const char* unit) {
  return fmt::format("without P3 {}{}, without P1 {}{}, four planes {}{}",
                     with_error(findings.design("without-p3", metric)), unit,
                     with_error(findings.design("without-p1", metric)), unit,
                     with_error(findings.design("four-planes", metric)), unit);
}

ClaimFinding three_planes_are_as_accurate(const Findings& findings) {
  const auto within = [&](double factor) {
    return std::ranges::all_of(three_planes, [&](const char* design) {
      return findings.design(design, "residual_wfe_nm").mean <
             factor * findings.design("four-planes", "residual_wfe_nm").mean;
    });
  };
  return {plane_counts_text(findings, "residual_wfe_nm", " nm"),
          verdict_of(within(1.5), within(3.0))};
}

ClaimFinding three_planes_take_more(const Findings& findings, const char* metric,
                                    const char* unit) {
  const auto is_above = [&](const char* design) {
    return is_clearly_above(findings.design(design, metric),
                            findings.design("four-planes", metric));
  };
  return {plane_counts_text(findings, metric, unit),
          verdict_of(std::ranges::all_of(three_planes, is_above),
                     std::ranges::any_of(three_planes, is_above))};
}

ClaimFinding three_planes_take_more_loops(const Findings& findings) {
  return three_planes_take_more(findings, "loops", "");
}

ClaimFinding three_planes_take_longer(const Findings& findings) {
  return three_planes_take_more(findings, "fft_count", " transforms");
}

ClaimFinding time_per_loop(const Findings& findings) {
  const auto per_loop = [&](const char* design, const char* metric) {
    return findings.design(design, metric).mean / findings.design(design, "loops").mean;
  };
  const auto share = [&](const char* metric) {
    return per_loop("without-p3", metric) / per_loop("four-planes", metric);
  };
  const double seconds = share("seconds");
  return {fmt::format("{:.0f} % of the transforms, {:.0f} % of the measured time",
                      100.0 * share("fft_count"), 100.0 * seconds),
          verdict_of(seconds > 0.8 && seconds < 0.95, seconds < 1.0)};
}

// Figure 5 ----------------------------------------------------------------------------------------

/// The scan of the fifth plane.
class FifthPlane {
 public:
  explicit FifthPlane(const Findings& findings)
      : four_(findings.performance("designs", "four-planes")) {
    const Json& grid = findings.summary("figure-5", "").at("grid");
    for (const Json& axis : grid.at("axes")) {
      if (axis.at("name") == "z5") distances_ = axis.at("values").get<std::vector<double>>();
    }
    for (const char* figure : {"residual_wfe_nm", "loops", "fft_count"}) {
      values_[figure] = numbers_from_json(grid.at(figure));
    }
  }

  bool is_zero_hop(std::size_t i) const {
    return distances_[i] == 0.0 || distances_[i] == 180 * km;
  }

  /// Without the places where a hop has no length.
  std::pair<double, double> range(const char* figure) const {
    double least = HUGE_VAL;
    double greatest = -HUGE_VAL;
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      if (is_zero_hop(i)) continue;
      least = std::min(least, values_.at(figure)[i]);
      greatest = std::max(greatest, values_.at(figure)[i]);
    }
    return {least, greatest};
  }

  /// By how much the figure is above the mean of its neighbours, at worst, where a hop has no
  /// length.
  double worst_zero_hop(const char* figure) const {
    const std::vector<double>& values = values_.at(figure);
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
      if (is_zero_hop(i))
        worst = std::max(worst, 2.0 * values[i] / (values[i - 1] + values[i + 1]));
    }
    return worst;
  }

  MeanAndError four(const char* figure) const { return mean_from_json(four_.at(figure)); }

 private:
  const Json& four_;
  std::vector<double> distances_;
  std::map<std::string, std::vector<double>> values_;
};

ClaimFinding five_planes_range(const Findings& findings) {
  const FifthPlane scan(findings);
  const auto [low, high] = scan.range("residual_wfe_nm");
  const auto [fewest, most] = scan.range("loops");
  const auto within = [low = low, high = high, fewest = fewest, most = most](double slack) {
    return low > 3.0 / slack && high < 14.0 * slack && fewest > 4.0 / slack && most < 5.0 * slack;
  };
  return {fmt::format("{:.2g} to {:.2g} nm, {:.1f} to {:.1f} loops", low, high, fewest, most),
          verdict_of(within(1.25), within(2.5))};
}

ClaimFinding four_planes_at_papers_distances(const Findings& findings) {
  const FifthPlane scan(findings);
  const MeanAndError residual = scan.four("residual_wfe_nm");
  const MeanAndError loops = scan.four("loops");
  const auto within = [&](double slack) {
    return std::abs(std::log(residual.mean / 6.5)) < std::log(slack) &&
           std::abs(std::log(loops.mean / 4.2)) < std::log(slack);
  };
  return {fmt::format("{} nm, {} loops", with_error(residual), with_error(loops)),
          verdict_of(within(1.25), within(2.0))};
}

ClaimFinding fifth_plane_gains_little(const Findings& findings) {
  const FifthPlane scan(findings);
  const double residual = scan.range("residual_wfe_nm").first;
  const double loops = scan.range("loops").first;
  const double four_residual = scan.four("residual_wfe_nm").mean;
  const double four_loops = scan.four("loops").mean;
  return {fmt::format("at best {:.3g} nm (four planes {:.3g}) and {:.2f} loops ({:.2f})", residual,
                      four_residual, loops, four_loops),
          verdict_of(residual > 0.8 * four_residual && loops > 0.9 * four_loops,
                     residual > 0.5 * four_residual && loops > 0.8 * four_loops)};
}

ClaimFinding fifth_plane_takes_longer(const Findings& findings) {
  const FifthPlane scan(findings);
  const double least = scan.range("fft_count").first;
  const MeanAndError four = scan.four("fft_count");
  return {fmt::format("at best {:.1f} transforms (four planes {})", least, with_error(four)),
          verdict_of(least > four.mean + clear * four.standard_error, least > 0.9 * four.mean)};
}

ClaimFinding zero_hops_break(const Findings& findings) {
  const FifthPlane scan(findings);
  const double residual = scan.worst_zero_hop("residual_wfe_nm");
  const double loops = scan.worst_zero_hop("loops");
  return {fmt::format("{:.2f} times the neighbours' residual, {:.2f} times their loops", residual,
                      loops),
          verdict_of(residual > 1.5 && loops > 1.5, residual > 1.5 || loops > 1.5)};
}

// Figure 6 ----------------------------------------------------------------------------------------

/// The pixels per r0 at which S_F crosses 0.8, between the samplings in their logarithm.
double crossing(const Json& grid, int ratio) {
  const auto pixels = grid.at("axes").front().at("values").get<std::vector<double>>();
  const auto strehl = grid.at("field_strehl").get<std::vector<double>>();
  for (std::size_t i = 0; i + 1 < pixels.size(); ++i) {
    // From fine to coarse.
    if (strehl[i] >= 0.8 && strehl[i + 1] < 0.8) {
      const double share = (strehl[i] - 0.8) / (strehl[i] - strehl[i + 1]);
      return std::exp(std::lerp(std::log(pixels[i]), std::log(pixels[i + 1]), share)) / ratio;
    }
  }
  return strehl.back() >= 0.8 ? 0.0 : nan;
}

ClaimFinding pixels_per_r0(const Findings& findings) {
  std::vector<std::string> texts;
  bool reproduced = true;
  bool in_trend = true;
  for (const int ratio : sampling_ratios) {
    const double found =
        crossing(findings.summary("figure-6", fmt::format("{}", ratio)).at("grid"), ratio);
    texts.push_back(found == 0.0 ? fmt::format("{}: below {:.2g}", ratio, 8.0 / ratio)
                                 : fmt::format("{}: {:.2g}", ratio, found));
    reproduced = reproduced && found >= 3.5 && found <= 5.5;
    in_trend = in_trend && found >= 2.0 && found <= 8.0;
  }
  return {fmt::format("S_F = 0.8 at so many pixels per r0, D/r0 = {}", fmt::join(texts, "; ")),
          verdict_of(reproduced, in_trend)};
}

ClaimFinding more_pixels_take_longer(const Findings& findings) {
  std::vector<std::string> texts;
  bool reproduced = true;
  bool in_trend = true;
  for (const int ratio : sampling_ratios) {
    const Json& grid = findings.summary("figure-6", fmt::format("{}", ratio)).at("grid");
    const std::vector<double> pixels = numbers_from_json(grid.at("axes").front().at("values"));
    const std::vector<double> seconds = numbers_from_json(grid.at("seconds"));
    // From fine to coarse.
    reproduced = reproduced && std::ranges::is_sorted(seconds, std::greater());
    in_trend = in_trend && seconds.front() > seconds.back();
    texts.push_back(
        fmt::format("{}: {:.3g} to {:.3g} ms", ratio, 1e3 * seconds.back(), 1e3 * seconds.front()));
  }
  return {fmt::format("8 to 128 pixels across the pupil, D/r0 = {}", fmt::join(texts, "; ")),
          verdict_of(reproduced, in_trend)};
}

// Figures 7 and 8 ---------------------------------------------------------------------------------

std::vector<double> mean_residuals(const Findings& findings, std::string_view band) {
  return findings.summary("figure-8", std::string(band))
      .at("residual_after_loops_nm")
      .at("mean")
      .get<std::vector<double>>();
}

/// The mean residual after the last loop, nm.
MeanAndError floor_of(const Findings& findings, std::string_view band) {
  const Json& loops = findings.summary("figure-8", std::string(band)).at("residual_after_loops_nm");
  return {loops.at("mean").back(), loops.at("standard_error").back()};
}

ClaimFinding reaches_a_floor(const Findings& findings) {
  const std::vector<double> residuals = mean_residuals(findings, "medium");
  const auto reached =
      std::ranges::find_if(residuals, [&](double value) { return value < 1.1 * residuals.back(); });
  const auto loops = static_cast<int>(reached - residuals.begin()) + 1;
  return {fmt::format("within a tenth of its last value after {} loops", loops),
          verdict_of(loops >= 5 && loops <= 9, loops >= 3 && loops <= 14)};
}

ClaimFinding each_reaches_a_floor(const Findings& findings) {
  const Json& loops =
      findings.summary("figure-8", "medium").at("residual_after_loops_nm").at("screens");
  const std::size_t half = (loops.size() + 1) / 2;
  const std::vector<double> middle = numbers_from_json(loops.at(half - 1));
  const std::vector<double> last = numbers_from_json(loops.back());
  std::size_t settled = 0;
  for (std::size_t screen = 0; screen < last.size(); ++screen) {
    if (std::abs(last[screen] / middle[screen] - 1.0) < 0.1) ++settled;
  }
  return {fmt::format("{} of {} change by less than a tenth from loop {} to loop {}", settled,
                      last.size(), half, loops.size()),
          verdict_of(settled == last.size(), 4 * settled >= 3 * last.size())};
}

ClaimFinding starts_with_strength(const Findings& findings) {
  const Json& summary = findings.summary("figure-8", "medium");
  const double correlation = boost::math::statistics::correlation_coefficient(
      numbers_from_json(summary.at("aberrations_nm")),
      numbers_from_json(summary.at("residual_after_loops_nm").at("screens").front()));
  return {fmt::format("correlation {:.2f} of the residual after one loop with the aberration's RMS",
                      correlation),
          verdict_of(correlation > 0.5, correlation > 0.0)};
}

std::string bands_text(const std::function<MeanAndError(std::string_view)>& value) {
  std::vector<std::string> texts;
  for (const PaperBand& band : paper_bands) {
    texts.push_back(fmt::format("{} {}", band.name, with_error(value(band.name))));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// Whether a figure grows from each band to the next wider one.
template <class Above>
bool grows(const std::function<MeanAndError(std::string_view)>& value, const Above& above) {
  for (std::size_t i = 1; i < paper_bands.size(); ++i) {
    if (!above(value(paper_bands[i].name), value(paper_bands[i - 1].name))) return false;
  }
  return true;
}

bool is_above(const MeanAndError& a, const MeanAndError& b) { return a.mean > b.mean; }

ClaimFinding floor_grows(const Findings& findings) {
  const auto floor = [&](std::string_view band) { return floor_of(findings, band); };
  return {bands_text(floor) + " nm",
          verdict_of(grows(floor, is_clearly_above), grows(floor, is_above))};
}

ClaimFinding converges_later(const Findings& findings) {
  const auto loops = [&](std::string_view band) {
    return mean_from_json(findings.performance("figure-8", std::string(band)).at("loops"));
  };
  return {bands_text(loops) + " loops",
          verdict_of(grows(loops, is_clearly_above),
                     is_clearly_above(loops("wide"), loops("monochromatic")))};
}

ClaimFinding floor_is_low(const Findings& findings) {
  const MeanAndError floor = floor_of(findings, "wide");
  return {fmt::format("{} nm", with_error(floor)),
          verdict_of(floor.mean < 50.0, floor.mean < 100.0)};
}

const std::vector<CheckedClaim>& known_claims() {
  static const std::vector<CheckedClaim> claims{
      {"3", "Planes very close to the pupil reconstruct poorly.", "over 200 nm, over 10 loops",
       "both for each D/r0 at the smallest Z_near; trend: 3 times the map's lowest residual, over "
       "6 "
       "loops",
       "a weak aberration of the reconstruction's start is kept where diffraction shows nothing",
       too_near},
      {"3", "Near and far planes close together reconstruct poorly.", "over 200 nm, over 10 loops",
       "both for each D/r0 where the pairs coincide beyond 50 km; trend: 3 times the map's lowest "
       "residual, over 6 loops",
       "two coinciding pairs are a two-plane sensor", too_close_together},
      {"3", "In the valley of the best designs.", "5 to 10 nm, 3 to 5 loops",
       "within a fifth of these at the valley and Z_far = 180 km; trend: a factor 2",
       "the stopping rule: rms_change ends sooner and earlier than difference", low_region},
      {"3", "The valley lies at the Talbot distance of r0.", "1 Z_T",
       "within a factor 1.5 for each D/r0; trend: 2.5",
       "the valley is broad; its lowest place is compared", valley_at_talbot_distance},
      {"3", "The valley moves towards the pupil as D/r0 grows.", "from 4 to 8",
       "nearer at each step; trend: nearer at 8 than at 4", "Z_T goes with (r0/D)^2",
       valley_moves_in},
      {"3", "The valley shows in the loops, and faintly in the residual.", "faintly",
       "for each D/r0 the loops rise by a tenth beyond the valley, the residual less; trend: the "
       "loops do",
       "where every design stops at a change of 1 nm, its residual hardly depends on the design",
       valley_is_of_loops},
      {"3", "The valley moves towards the pupil partly in Z_far too.", "from 4 to 8",
       "the least good Z_far is nearer at 8 than at 4; trend: the same",
       "from there on the loops stay within a tenth of their fewest", valley_moves_in_far_too},
      {"3", "The least optimal Z_far is no multiple of the Talbot distance.", "no easy multiple",
       "in Z_T it grows by half from D/r0 = 4 to 8; trend: by a fifth",
       "what the far pair adds are the low frequencies, which no scale of the seeing limits",
       no_multiple_of_talbot_distance},
      {"3", "Z_near at the Talbot distance and Z_far beyond 100 to 200 km are all that it takes.",
       "optimal or near it",
       "every design within a quarter of Z_T and from 150 km on: below twice the lowest residual "
       "and 1.25 times the fewest loops; trend: 4 and 1.6 times",
       "the worst of these designs is compared with the best of the map", two_rules_suffice},
      {"3", "Near and far pair may be exchanged.", "the same",
       "at 47 and 180 km within two standard errors in residual and loops; trend: within 5 %",
       "an exchange changes the order in which the planes are read, and with it the loop",
       pairs_exchange},
      {"3", "The least optimal Z_far.", "100 to 200 km",
       "within a tenth of that range for each D/r0; trend: a factor 2",
       "from there on the loops stay within a tenth of their fewest", least_far},
      {"scaling", "Designs scale to other telescopes by their Fresnel numbers.", "found accurate",
       "equal to 0.1 %; trend: 5 %",
       "the Fresnel integral depends on nothing else; equal up to rounding",
       scales_by_fresnel_number},
      {"4", "Three planes are about as accurate as four.", "comparable",
       "less than 1.5 times the residual at 47 and 180 km; trend: 3 times",
       "the stopping rule ends both at about the same error", three_planes_are_as_accurate},
      {"4", "Three planes take more loops.", "more",
       "by two standard errors both without P3 and without P1; trend: one of them",
       "less information in each loop", three_planes_take_more_loops},
      {"4", "A three-plane loop takes less time than a four-plane loop.", "88 %",
       "80 to 95 % of the measured time; trend: below 100 %",
       "four hops of two transforms instead of five, and what does not depend on the planes",
       time_per_loop},
      {"4", "Three planes take longer in all.", "longer",
       "more transforms by two standard errors both without P3 and without P1; trend: one of them",
       "a fifth fewer transforms in a loop, so a quarter more loops are needed to lose",
       three_planes_take_longer},
      {"5", "A fifth plane between the last and the pupil.", "3 to 14 nm, 4 to 5 loops",
       "all of the scan within a factor 1.25 of these; trend: 2.5",
       "the stopping rule and the truth's window", five_planes_range},
      {"5", "Four planes at 47 and 180 km.", "6.5 nm, 4.2 loops",
       "both within a factor 1.25; trend: 2", "the stopping rule and the truth's window",
       four_planes_at_papers_distances},
      {"5", "The fifth plane hardly gains anything.", "little",
       "at best a fifth less residual and a tenth fewer loops; trend: half and a fifth",
       "the best place is compared, which chance favours", fifth_plane_gains_little},
      {"5", "Five planes take longer than four.", "longer",
       "more transforms by two standard errors at the best place; trend: no tenth fewer",
       "six hops instead of five", fifth_plane_takes_longer},
      {"5", "Where the fifth plane is at the pupil or at P4 the results are off.", "gaps and peaks",
       "1.5 times the neighbours in residual and loops; trend: in one",
       "a hop of no length is left out here, so nothing breaks", zero_hops_break},
      {"6", "A field-estimated Strehl ratio of 0.8 takes enough pixels per r0.",
       "4 to 5 pixels per r0", "3.5 to 5.5 for each D/r0; trend: 2 to 8",
       "the truth's sampling and window, and what the plane distances are", pixels_per_r0},
      {"6", "More pixels take longer.", "longer",
       "at each doubling for each D/r0; trend: 128 longer than 8",
       "the transforms' time; too few pixels take more loops, too", more_pixels_take_longer},
      {"7", "In the medium band the residual reaches its floor.", "after 6 to 8 loops",
       "within a tenth of the last value after 5 to 9 loops; trend: 3 to 14",
       "the floor is of the band, the way to it of the planes", reaches_a_floor},
      {"7", "Every aberration reaches a floor that more loops do not lower.", "all 16",
       "all change by less than a tenth in the second half of the loops; trend: three quarters of "
       "them",
       "a band's images are no single wavelength's, so the loop cannot explain them",
       each_reaches_a_floor},
      {"7", "The residual starts where the strength of the aberration puts it.", "depends on it",
       "a correlation above 0.5 with its RMS; trend: above 0",
       "a stronger aberration is further from the flat start", starts_with_strength},
      {"8", "The floor rises with the bandwidth.", "rises",
       "by two standard errors from each band to the next; trend: on the mean",
       "in phase or in path: aberration and diffraction then change in another way over the band",
       floor_grows},
      {"8", "Wider bands converge later.", "later",
       "by two standard errors from each band to the next; trend: the widest than one wavelength",
       "the stopping rule does not see the floor", converges_later},
      {"8", "The floor of the widest band stays low.", "below 50 nm",
       "below 50 nm; trend: below 100 nm",
       "the same phase at every wavelength is what makes it low; the same path does not",
       floor_is_low}};
  return claims;
}

}  // namespace

const Json& ReproducedRuns::summary(const std::string& run) const {
  const auto known = read_.find(run);
  if (known != read_.end()) return known->second;
  const std::filesystem::path path = folder_ / run / "summary.json";
  try {
    std::ifstream file(path);
    return read_.emplace(run, Json::parse(file)).first->second;
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

std::string_view to_string(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::reproduced:
      return "reproduced";
    case ClaimVerdict::in_trend:
      return "reproduced in trend";
    case ClaimVerdict::not_reproduced:
      break;
  }
  return "not reproduced";
}

std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures) {
  std::vector<Claim> claims;
  for (const CheckedClaim& known : known_claims()) {
    // The maps of figure 3 are part of figure 4's comparison.
    if (std::ranges::count(figures, known.figure) == 0) continue;
    Claim claim{.figure = std::string(known.figure),
                .sentence = std::string(known.sentence),
                .papers = std::string(known.papers),
                .rule = std::string(known.rule),
                .findings = {},
                .why = std::string(known.why)};
    for (const Setup setup : setups) {
      claim.findings.emplace(setup, known.find(Findings(runs, setup)));
    }
    claims.push_back(std::move(claim));
  }
  return claims;
}

}  // namespace nlcwfs
