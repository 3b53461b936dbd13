// Designs are tried on fresh screens, and ranked there.
#include "studies/search/verified_ranking.hpp"

#include "model/input_error.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/spdlog.h>

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// "-115.4 km, 115.4 km"
std::string planes_text(const SensorDesign& design) {
  std::vector<std::string> distances;
  for (const double z : design.planes) distances.push_back(format_length(z));
  return fmt::format("{}", fmt::join(distances, ", "));
}

/// By how much it costs more than the best.
MeanAndError cost_above_best(const RankedDesign& ranked) {
  const MeanAndError& gain = ranked.against_best.cost;
  return {-gain.mean, gain.standard_error};
}

}  // namespace

Progress verification_progress(const DesignTrial& verification, std::size_t designs,
                               std::string then, const Progress* whole) {
  const std::size_t conditions = verification.conditions().size();
  return {"verification", double(designs * conditions) * verification.screen_count(),
          "fresh screens", std::move(then), whole};
}

bool is_whole(const TriedDesign& tried, const DesignTrial& trial) {
  return static_cast<int>(tried.costs.size()) == trial.screen_count();
}

void require_verifiable(const DesignTrial& verification, const std::vector<SensorDesign>& designs,
                        const FreshScreens& fresh) {
  try {
    for (const SensorDesign& design : designs) verification.checked(design);
  } catch (const InputError& error) {
    throw InputError("verify.truth_factor", fresh.truth_factor,
                     fmt::format("the finer truth does not suit the design: {}", error.what()));
  }
}

TriedDesign verified_design(const SensorDesign& design, const DesignTrial& verification,
                            RunRecord& record, const ScreenWatch& watch) {
  const Stopwatch stopwatch;
  const Condition& first = verification.conditions().front();
  ArchivedEvaluation evaluation{
      .stage = "verify",
      .design = to_json(design, first.simulation->telescope(), first.fried_parameter).dump(),
      .cost = std::numeric_limits<double>::quiet_NaN(),
      .key = design_key(design)};
  std::optional<TriedDesign> tried;
  try {
    tried = verification.run(design, {}, watch);
  } catch (const TrialMemoryFailed&) {
    throw;  // no design is to blame
  } catch (const std::exception& error) {
    evaluation.failure = error.what();
  }
  evaluation.seconds = stopwatch.seconds();
  if (tried) {
    if (!is_whole(*tried, verification)) return *tried;
    evaluation.cost = mean_and_standard_error(tried->costs).mean;
    evaluation.performance = to_json(pooled(tried->performances)).dump();
  }
  record.add(evaluation);
  if (tried) return *tried;
  throw VerificationFailed(
      fmt::format("the design of the planes {} failed on the fresh screens: {}",
                  planes_text(design), evaluation.failure),
      record.how_to_try_again());
}

std::optional<TriedDesign> verified_candidate(const SensorDesign& design,
                                              const DesignTrial& verification, RunRecord& record,
                                              const ScreenWatch& watch, bool is_last_hope) {
  try {
    return verified_design(design, verification, record, watch);
  } catch (const VerificationFailed& failure) {
    if (is_last_hope) throw;
    spdlog::warn("{}; it is left out", without_controls(failure.what_failed()));
    return std::nullopt;
  }
}

std::vector<RankedDesign> ranked(std::vector<RankedDesign> ranking) {
  std::ranges::stable_sort(ranking, {}, [](const RankedDesign& design) {
    return std::pair(design.verified.violation,
                     mean_and_standard_error(design.verified.costs).mean);
  });
  for (RankedDesign& design : ranking) {
    design.against_best = improvement(design.verified, ranking.front().verified);
  }
  return ranking;
}

nlohmann::ordered_json to_json(const std::vector<RankedDesign>& ranking,
                               const DesignTrial& verification) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const RankedDesign& design : ranking) {
    nlohmann::ordered_json json = to_json(design.verified, verification);
    json["cost_above_best"] = to_json(cost_above_best(design));
    const Verdict verdict = design.against_best.verdict;
    json["verdict"] = array.empty()                           ? "best"
                      : verdict == Verdict::indistinguishable ? "tied"
                                                              : word_of(verdict);
    array.push_back(std::move(json));
  }
  return array;
}

std::string ranking_text(const std::vector<RankedDesign>& ranking, std::string_view of) {
  if (ranking.size() < 2) return {};
  std::vector<std::string> planes;
  std::size_t width = 0;
  for (const RankedDesign& design : ranking) {
    planes.push_back(planes_text(design.verified.design));
    width = std::max(width, planes.back().size());
  }
  std::string text =
      fmt::format("{}'s best {} designs on the fresh screens:\n", of, ranking.size());
  for (std::size_t i = 0; i < ranking.size(); ++i) {
    MeanAndError above = cost_above_best(ranking[i]);
    // Of designs that tie, one that keeps a limit better may cost more.
    const char* const direction = above.mean < 0.0 ? "less" : "more";
    above.mean = std::abs(above.mean);
    text += fmt::format("  cost {:>18}  {:<{}}  {}\n",
                        with_error(mean_and_standard_error(ranking[i].verified.costs)), planes[i],
                        width,
                        i == 0 ? "the best"
                        : ranking[i].against_best.verdict == Verdict::indistinguishable
                            ? fmt::format("a tie: {} {}", with_error(above), direction)
                            : fmt::format("worse by {}", with_error(above)));
  }
  return text + '\n';
}

}  // namespace nlcwfs
