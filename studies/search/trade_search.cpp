// The front of several objectives is searched and verified.
#include "studies/search/trade_search.hpp"

#include "model/input_error.hpp"
#include "objectives/design_problem.hpp"
#include "studies/search/design_search.hpp"
#include "studies/search/search_log.hpp"

#include <algorithm>
#include <tuple>

namespace nlcwfs {
namespace {

constexpr double nm = 1e-9;

ParetoOptions pareto_options_of(const Configuration& configuration) {
  ParetoOptions options;
  options.algorithm = configuration.choice("trade.algorithm");
  options.population = configuration.integer("trade.population");
  options.seed = configuration.seed("search.seed");
  options.evaluation.budget = configuration.integer("trade.budget");
  options.evaluation.time_limit = configuration.optional_time("search.time_limit");
  if (options.population % 4 != 0) {
    throw InputError("trade.population", options.population, "a multiple of 4, such as 8");
  }
  return options;
}

/// The greatest figure of a space's designs, for one that every variable moves in one direction
/// whatever the others are.
template <class Figure>
double greatest(const DesignSpace& space, const Figure& figure) {
  double greatest = 0.0;
  const std::vector<SubSpace> sub_spaces = space.sub_spaces();
  for (std::size_t s = 0; s < sub_spaces.size(); ++s) {
    const std::vector<Variable>& variables = sub_spaces[s].variables;
    SearchPoint point = lowest_point(sub_spaces[s], static_cast<int>(s));
    double best = 0.0;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      SearchPoint moved = point;
      for (const double value_of_variable : variables[i].outstanding_values()) {
        moved.x[Eigen::Index(i)] = value_of_variable;
        const double value = figure(space.design(moved));
        if (value <= best) continue;
        best = value;
        point = moved;
      }
    }
    greatest = std::max(greatest, best);
  }
  return greatest;
}

/// What a metric may be before a design is worthless, whatever a search finds: the same for every
/// run of a configuration, so that hypervolumes can be compared, and no less than any design of the
/// space has, where that is known. Nothing for a metric without such a value.
std::optional<double> worthless_value(const DesignMetric& metric, const DesignSpace& space,
                                      const Operation& operation) {
  // One more than a sensor may have.
  constexpr double planes = 7.0;
  if (metric.name == "total_wfe_nm" || metric.name == "residual_wfe_nm" ||
      metric.name == "wrapped_wfe_nm") {
    // A Strehl ratio below 0.1.
    return 0.25 * operation.wavelength / nm;
  }
  if (metric.name == "model_seconds") {
    // Two transforms between planes, and from and to the pupil.
    return greatest(space, [&](const SensorDesign& design) {
      const double transforms = 2.0 * (planes + 1.0) * design.reconstruction.max_loops;
      return transforms * operation.transform_seconds(design);
    });
  }
  if (metric.name == "detector_pixels") {
    return greatest(space, [](const SensorDesign& design) {
      return planes * design.detector.width() * design.detector.width();
    });
  }
  if (metric.name == "plane_count") return planes;
  return std::nullopt;
}

std::vector<std::optional<double>> reference_of(const Configuration& configuration,
                                                const std::vector<DesignMetric>& objectives,
                                                const DesignSpace& space,
                                                const Operation& operation) {
  const bool is_given = configuration.is_set("trade.reference");
  const std::vector<double> given =
      is_given ? configuration.numbers("trade.reference") : std::vector<double>{};
  if (is_given && given.size() != objectives.size()) {
    throw InputError("trade.reference", configuration.value_text("trade.reference"),
                     fmt::format("{} numbers, one for each of trade.objectives, {}",
                                 objectives.size(), configuration.text("trade.objectives")));
  }
  std::vector<std::optional<double>> reference;
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    reference.push_back(is_given ? given[i] : worthless_value(objectives[i], space, operation));
    if (reference.back()) reference.back() = objectives[i].minimised(*reference.back());
  }
  return reference;
}

/// The order in which people read a front.
bool stands_before(const TradedDesign& a, const TradedDesign& b) {
  const auto rank = [](const TradedDesign& traded) {
    const SensorDesign& design = traded.verified.design;
    return std::tuple(design.planes.size(), design.detector.pupil_pixels,
                      traded.evaluated.objectives);
  };
  return rank(a) < rank(b);
}

/// Whether one is the other's equal or better in each objective, and better in one.
bool is_no_worse(const TradedDesign& one, const TradedDesign& other) {
  const std::vector<double>& ours = one.evaluated.objectives;
  const std::vector<double>& theirs = other.evaluated.objectives;
  return ours != theirs && std::ranges::equal(ours, theirs, std::ranges::less_equal());
}

/// Whether that is more than chance in one objective.
/// @pre is_no_worse
bool is_clearly_better(const TradedDesign& one, const TradedDesign& other) {
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    // The means say in which direction.
    if (improvement(one.samples[i], other.samples[i]).verdict != Verdict::indistinguishable) {
      return true;
    }
  }
  return false;
}

/// Whether another of the front betters or ties with a design.
void hold_against(const std::vector<TradedDesign>& front, TradedDesign& traded) {
  for (std::size_t i = 0; i < front.size(); ++i) {
    const TradedDesign& rival = front[i];
    if (rival.evaluated.violation > 0.0 || !is_no_worse(rival, traded)) continue;
    if (is_clearly_better(rival, traded)) traded.dominated = true;
    if (!traded.tied_with) traded.tied_with = i;
  }
  if (traded.dominated) traded.tied_with.reset();
}

}  // namespace

TradeSearch::TradeSearch(const Configuration& configuration)
    : TrialSetup(configuration),
      space(search_space_of(configuration, telescope, simulated())),
      objectives(trade_objectives_of(configuration)),
      options(pareto_options_of(configuration)),
      trial(make_trial(space.varies("pupil_pixels"))),
      verification(make_verification(space.varies("pupil_pixels"))),
      most_verified_(static_cast<std::size_t>(configuration.integer("trade.verified"))) {
  require_variables(space.sub_spaces());
  require_valid_designs(space, trial);
  require_verifiable(verification, outstanding_designs(space), fresh);
  const Operation& operation = trial.cost().operation;
  for (const DesignMetric& objective : objectives) objective.validate(operation);
  const SensorDesign configured = trial.checked(design);
  reference_ = reference_of(configuration, objectives, space, operation);
  if (TrialSetup::options.truth == TruthModel::matched) {
    notes.emplace_back(
        "with simulation.truth = matched all designs share one grid: pupil_pixels and "
        "reconstruction_oversampling do not vary");
  }
  if (trial.conditions().size() > 1 && trial.cost().aggregate.kind != AggregateKind::mean) {
    notes.push_back(
        fmt::format("objectives are aggregated over the conditions as "
                    "objective.aggregate = {} says; other figures are means",
                    configuration.choice("objective.aggregate")));
  }
  if (const auto point = space.point_of(configured)) options.starts.push_back(*point);
}

TradeResult TradeSearch::run(RunRecord& record) const {
  TradeResult result;
  const InterruptWatch watch;
  const Stopwatch stopwatch;
  ParetoOptions watched = options;
  SearchLog log("search", space, *this, watched.evaluation, record, "then the verification",
                nullptr, objectives);
  const auto first_designs = options.population * static_cast<int>(space.sub_spaces().size());
  std::vector<double> worst(objectives.size(), -std::numeric_limits<double>::infinity());
  watched.evaluation.observer =
      [&, add = watched.evaluation.observer](const EvaluationRecord& evaluation) {
        add(evaluation);
        if (evaluation.index > first_designs || !evaluation.failure.empty()) return;
        std::ranges::transform(worst, evaluation.objectives, worst.begin(), std::ranges::max);
      };
  DesignProblem problem(space, trial, objectives, log.interruptible());
  result.search = pareto_search(problem, watched);
  result.search_seconds = stopwatch.seconds();
  result.reconstructions = log.reconstructions();
  result.table = log.table();

  for (std::size_t i = 0; i < objectives.size(); ++i) {
    result.reference_is_of_the_run = result.reference_is_of_the_run || !reference_[i];
    result.reference_point.push_back(objectives[i].minimised(reference_[i].value_or(worst[i])));
  }
  verify_front(result, record);
  judge_front(result);
  return result;
}

void TradeSearch::verify_front(TradeResult& result, RunRecord& record) const {
  const std::vector<EvaluatedDesign>& front = result.search.front;
  std::vector<std::string> groups;
  for (const EvaluatedDesign& found : front) {
    const SensorDesign of_front = space.design(found.point);
    groups.push_back(
        fmt::format("{} planes {} pixels", of_front.planes.size(), of_front.detector.pupil_pixels));
  }
  const std::vector<std::size_t> chosen = evenly_chosen(groups, most_verified_);
  // One that ended the search does not end this too.
  const bool was_interrupted = InterruptWatch::interrupted();
  result.chosen_count = chosen.size();
  Progress progress = verification_progress(verification, chosen.size());
  for (const std::size_t i : chosen) {
    const EvaluatedDesign& found = front[i];
    std::optional<TriedDesign> tried =
        verified_candidate(space.design(found.point), verification, record,
                           was_interrupted ? counted(progress) : interruptible(progress),
                           result.front.empty() && i == chosen.back());
    if (!tried) {
      --result.chosen_count;
      continue;
    }
    TradedDesign traded;
    traded.verified = std::move(*tried);
    result.reconstructions +=
        static_cast<long>(verification.conditions().size() * traded.verified.costs.size());
    const bool was_ended = !is_whole(traded.verified, verification);
    result.verification_interrupted = was_ended;
    if (was_ended && !result.front.empty()) return;
    traded.evaluated = {.point = found.point,
                        .key = found.key,
                        .cost = mean_and_standard_error(traded.verified.costs).mean,
                        .violation = traded.verified.violation};
    for (const DesignMetric& objective : objectives) {
      traded.samples.push_back(verification.objective_of(traded.verified, objective));
      traded.objectives.push_back(mean_and_standard_error(traded.samples.back()));
      traded.evaluated.objectives.push_back(objective.minimised(traded.objectives.back().mean));
    }
    result.front.push_back(std::move(traded));
    if (!was_interrupted && InterruptWatch::interrupted()) {
      result.verification_interrupted = was_ended || result.front.size() < result.chosen_count;
      return;
    }
  }
}

void TradeSearch::judge_front(TradeResult& result) const {
  std::ranges::stable_sort(result.front, stands_before);
  std::vector<std::size_t> standing;
  std::vector<EvaluatedDesign> designs;
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    TradedDesign& traded = result.front[i];
    if (traded.evaluated.violation > 0.0) continue;
    hold_against(result.front, traded);
    if (traded.dominated) continue;
    standing.push_back(i);
    designs.push_back(traded.evaluated);
  }
  result.bests.resize(objectives.size() - 1);
  if (standing.empty()) return;
  result.knee = standing[knee(designs)];

  std::vector<double> reference;
  double box = 1.0;
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    reference.push_back(objectives[i].minimised(result.reference_point[i]));
    box *= reference.back() - (objectives[i].higher_is_better ? -1.0 : 0.0);
  }
  result.hypervolume = hypervolume(designs, reference);
  result.hypervolume_fraction = box > 0.0 ? result.hypervolume / box : 0.0;

  for (std::size_t i = 1; i < objectives.size(); ++i) {
    std::vector<std::size_t> by_bound = standing;
    std::ranges::stable_sort(by_bound, {}, [&](std::size_t place) {
      const std::vector<double>& figure = result.front[place].evaluated.objectives;
      return std::pair(figure[i], figure[0]);
    });
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t place : by_bound) {
      const std::vector<double>& figure = result.front[place].evaluated.objectives;
      if (figure[0] >= least) continue;
      least = figure[0];
      result.bests[i - 1].push_back({result.front[place].objectives[i].mean, place});
    }
  }
}

}  // namespace nlcwfs
