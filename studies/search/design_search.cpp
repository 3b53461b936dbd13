// One best design is searched, verified, and how far it may move is scanned.
#include "studies/search/design_search.hpp"

#include "model/input_error.hpp"
#include "objectives/design_problem.hpp"
#include "results/tables/design_summary.hpp"
#include "studies/search/search_log.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>

namespace nlcwfs {
namespace {

/// The method, limits and seed of the section search.
SearchOptions search_options_of(const Configuration& configuration,
                                const std::vector<SubSpace>& sub_spaces) {
  SearchOptions options;
  options.optimizer = configuration.text("search.optimizer");
  options.seed = configuration.seed("search.seed");
  EvaluatorOptions& evaluation = options.evaluation;
  evaluation.budget = configuration.integer("search.budget");
  evaluation.time_limit = configuration.optional_time("search.time_limit");
  evaluation.stagnation = configuration.integer("search.stagnation");
  evaluation.race_significance = configuration.number("search.race");
  if (configuration.is_set("search.target")) {
    evaluation.target = configuration.number("search.target");
  }
  require_variables(sub_spaces);
  try {
    search_method(options.optimizer, sub_spaces);
  } catch (const std::invalid_argument& error) {
    throw InputError("search.optimizer", options.optimizer, error.what());
  }
  return options;
}

}  // namespace

void require_variables(const std::vector<SubSpace>& sub_spaces) {
  for (const SubSpace& sub_space : sub_spaces) {
    if (!sub_space.variables.empty()) continue;
    throw InputError("search.plane_count", sub_space.name,
                     "nothing of this design may vary; give a key of the section search a range or "
                     "a list");
  }
}

std::vector<SensorDesign> outstanding_designs(const DesignSpace& space) {
  std::vector<SensorDesign> designs;
  const std::vector<SubSpace> sub_spaces = space.sub_spaces();
  for (std::size_t s = 0; s < sub_spaces.size(); ++s) {
    const std::vector<Variable>& variables = sub_spaces[s].variables;
    const SearchPoint point = lowest_point(sub_spaces[s], static_cast<int>(s));
    designs.push_back(space.design(point));
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (space.name(point.sub_space, i) == "order") continue;  // all are equally valid
      SearchPoint moved = point;
      for (const double value : variables[i].outstanding_values()) {
        moved.x[Eigen::Index(i)] = value;
        designs.push_back(space.design(moved));
      }
    }
  }
  return designs;
}

void require_valid_designs(const DesignSpace& space, const DesignTrial& trial) {
  for (const SensorDesign& design : outstanding_designs(space)) trial.checked(design);
}

DesignSearch::DesignSearch(const Configuration& configuration)
    : TrialSetup(configuration),
      space(search_space_of(configuration, telescope, simulated())),
      options(search_options_of(configuration, space.sub_spaces())),
      trial(make_trial(space.varies("pupil_pixels"))),
      verification(make_verification(space.varies("pupil_pixels"))),
      scan(make_scan(space.varies("pupil_pixels"))),
      baseline(trial.checked(baseline_of(configuration))),
      candidates_(configuration.integer("verify.candidates")) {
  require_valid_designs(space, trial);
  require_verifiable(verification, {baseline}, fresh);
  require_verifiable(verification, outstanding_designs(space), fresh);
  // The user's own designs are tried first.
  for (const SensorDesign& known : {design, baseline}) {
    if (const auto point = space.point_of(known)) options.starts.push_back(*point);
  }
  if (configuration.integer("search.cheap_budget") > 0) add_cheap_stage(configuration);
}

void DesignSearch::add_cheap_stage(const Configuration& configuration) {
  const double share = configuration.number("search.cheap_window");
  SensorDesign base = simulated();
  base.reconstruction.window = rounded_window(
      std::max(share * base.reconstruction.window, base.detector.window), base.pupil_samples());
  SearchOptions cheap_options = options;
  cheap_options.evaluation.budget = configuration.integer("search.cheap_budget");
  cheap_options.evaluation.target.reset();  // it is one of the search proper
  TrialSetup setup(*this);
  setup.screen_source.count = configuration.integer("search.cheap_screens");
  setup.search_precision = Precision::single_precision;
  cheap_.emplace(CheapStage{setup.make_trial(space.varies("pupil_pixels")),
                            search_space_of(configuration, telescope, base), cheap_options});
  try {
    require_valid_designs(cheap_->space, cheap_->trial);
  } catch (const InputError& error) {
    throw InputError("search.cheap_window", share,
                     fmt::format("does not suit the design: {}", error.what()));
  }
}

std::vector<DesignTrial*> DesignSearch::trials() {
  std::vector<DesignTrial*> all{&trial, &verification, &scan};
  if (cheap_) all.push_back(&cheap_->trial);
  return all;
}

DesignSearchResult DesignSearch::run(RunRecord& record, const Progress* whole) const {
  DesignSearchResult result;
  const InterruptWatch watch;
  std::vector<SearchPoint> starts = options.starts;
  const Stopwatch stopwatch;
  if (cheap_) {
    const SearchResult cheap =
        search_stage("cheap search", cheap_->space, cheap_->trial, cheap_->options, record,
                     "then the search and the verification", whole, result);
    result.cheap_evaluations = cheap.evaluations;
    // Not the costs: they are of another simulation. First, as an interrupted search tries one.
    std::vector<SearchPoint> leaders;
    for (const EvaluatedDesign& leader : cheap.best_designs) leaders.push_back(leader.point);
    starts.insert(starts.begin(), leaders.begin(), leaders.end());
  }
  SearchOptions from_starts = options;
  from_starts.starts = starts;
  if (std::optional<double>& limit = from_starts.evaluation.time_limit) {
    limit = std::max(0.0, *limit - stopwatch.seconds());
  }
  result.search = search_stage("search", space, trial, from_starts, record, "then the verification",
                               whole, result);
  result.search_seconds = stopwatch.seconds();
  result.reconstructions = result.search_reconstructions;
  if (result.search.termination == Termination::stop_requested) {
    result.interrupted_when = fmt::format("{} of {} designs were tried", result.search.evaluations,
                                          from_starts.evaluation.budget);
  }
  verify(record, whole, result);
  if (result.interrupted_when.empty()) scan_ranges(whole, result);
  return result;
}

void DesignSearch::verify(RunRecord& record, const Progress* whole,
                          DesignSearchResult& result) const {
  // An interrupt that ended the search does not end this too.
  const bool may_end = result.interrupted_when.empty();
  const auto& leaders = result.search.best_designs;
  const std::size_t count = std::min(leaders.size(), static_cast<std::size_t>(candidates_));
  Progress progress = verification_progress(
      verification, count + 1, may_end ? "then how far each variable may move" : "", whole);
  const auto watch = [&] { return may_end ? interruptible(progress) : counted(progress); };
  const auto count_screens = [&](const TriedDesign& tried) {
    result.reconstructions +=
        static_cast<long>(verification.conditions().size() * tried.costs.size());
  };
  // The baseline first: whatever is done later can then be held against it.
  result.baseline = verified_design(baseline, verification, record, watch());
  count_screens(result.baseline);
  std::vector<RankedDesign> candidates;
  std::size_t failures = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<TriedDesign> tried =
        verified_candidate(space.design(leaders[i].point), verification, record, watch(),
                           candidates.empty() && i + 1 == count);
    if (!tried) {
      ++failures;
      continue;
    }
    count_screens(*tried);
    if (!is_whole(*tried, verification) && !candidates.empty()) break;
    candidates.push_back({.candidate = i, .verified = std::move(*tried)});
    if (may_end && InterruptWatch::interrupted()) break;
  }
  TriedDesign& first = candidates.front().verified;
  const std::size_t screens = std::min(result.baseline.costs.size(), first.costs.size());
  if (static_cast<int>(screens) < verification.screen_count()) {
    result.baseline = verification.on_first_screens(std::move(result.baseline), screens);
    candidates.resize(1);
    first = verification.on_first_screens(std::move(first), screens);
    result.interrupted_when = fmt::format("the best design was verified on {} of {} screens",
                                          screens, verification.screen_count());
  } else if (candidates.size() + failures < count) {
    result.interrupted_when =
        fmt::format("{} of {} designs were verified", candidates.size(), count - failures);
  }
  result.ranking = ranked(std::move(candidates));
  result.gain = improvement(result.best(), result.baseline);
}

void DesignSearch::scan_ranges(const Progress* whole, DesignSearchResult& result) const {
  const SearchPoint& best = result.search.best_designs[result.ranking.front().candidate].point;
  Progress progress("how far each variable may move", 1.0, "of the scan", "", whole);
  OptimumScan scanned;
  try {
    scanned = optimum_ranges(
        space, scan, best,
        [&](double share) {
          progress.describe(fmt::format("{:.0f} %", 100.0 * share));
          progress.at(share);
        },
        [] { return !InterruptWatch::interrupted(); });
  } catch (const TrialMemoryFailed&) {
    throw;  // no design is to blame
  } catch (const std::exception& error) {
    result.interrupted_when =
        fmt::format("the best design failed in the scan of how far its variables may move: {}",
                    without_controls(error.what()));
    return;
  }
  result.ranges = std::move(scanned.ranges);
  result.reconstructions +=
      static_cast<long>(scan.conditions().size()) * scan.screen_count() * scanned.designs;
  const int variables =
      space.sub_spaces()[static_cast<std::size_t>(best.sub_space)].continuous_count();
  if (static_cast<int>(result.ranges.size()) < variables) {
    result.interrupted_when =
        fmt::format("it was known of {} of {} variables how far they may move",
                    result.ranges.size(), variables);
  }
}

SearchResult DesignSearch::search_stage(const std::string& name, const DesignSpace& stage_space,
                                        const DesignTrial& stage_trial, SearchOptions stage_options,
                                        RunRecord& record, std::string then, const Progress* whole,
                                        DesignSearchResult& result) const {
  SearchLog log(name, stage_space, *this, stage_options.evaluation, record, std::move(then), whole);
  DesignProblem problem(stage_space, stage_trial, {}, log.interruptible());
  SearchResult found = search(problem, stage_options);
  result.search_reconstructions += log.reconstructions();
  result.given_up += log.given_up();
  const long screens =
      static_cast<long>(stage_trial.conditions().size()) * stage_trial.screen_count();
  result.saved_reconstructions +=
      screens * (found.evaluations - found.failures) - log.reconstructions();
  result.table = log.table();
  result.steps = log.steps();
  return found;
}

}  // namespace nlcwfs
