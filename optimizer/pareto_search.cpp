// Several objectives are minimised at once, with pagmo.
#include "optimizer/pareto_search.hpp"

#include "optimizer/latin_hypercube.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/nspso.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>

namespace nlcwfs {
namespace {

/// A population without a new design in so many generations is at its end.
constexpr int known_generations_allowed = 20;

/// Above all objectives, which the evaluator keeps below 1e100, and in order.
double penalty_of_violation(double violation) {
  return 1e101 * (1.0 + violation / (1.0 + violation));
}
constexpr double penalty_of_failure = 1e102;

std::vector<double> objectives_for_pagmo(const std::optional<EvaluatedDesign>& design,
                                         std::size_t count) {
  std::vector<double> penalties(count, penalty_of_failure);
  if (!design) return penalties;
  if (design->violation > 0.0) {
    penalties.assign(count, penalty_of_violation(design->violation));
    return penalties;
  }
  assert(design->objectives.size() == count);
  return design->objectives;
}

/// A sub-space as pagmo sees it: the continuous variables come first, and those that an algorithm
/// knows as whole numbers after them.
struct PagmoProblem {
  Evaluator* evaluator = nullptr;
  int sub_space = 0;
  std::size_t objective_count = 2;
  bool rounds = false;  ///< the algorithm itself knows whole numbers

  const std::vector<Variable>& variables() const {
    return evaluator->sub_spaces()[static_cast<std::size_t>(sub_space)].variables;
  }
  /// pagmo's order of the variables.
  std::vector<Eigen::Index> order() const {
    std::vector<Eigen::Index> order(variables().size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
    std::stable_partition(order.begin(), order.end(), [&](Eigen::Index i) {
      return variables()[static_cast<std::size_t>(i)].is_continuous();
    });
    return order;
  }
  SearchPoint to_point(const double* x) const {
    SearchPoint point{sub_space, Eigen::VectorXd(variables().size())};
    for (const Eigen::Index i : order()) point.x[i] = *x++;
    return point;
  }
  pagmo::vector_double from_point(const SearchPoint& point) const {
    pagmo::vector_double x;
    for (const Eigen::Index i : order()) x.push_back(point.x[i]);
    return x;
  }

  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    std::pair<pagmo::vector_double, pagmo::vector_double> bounds;
    for (const Eigen::Index i : order()) {
      const Variable& variable = variables()[static_cast<std::size_t>(i)];
      // Rounded, the values at the ends then have as wide a range as the others.
      const double margin = variable.is_continuous() || rounds ? 0.0 : 0.499;
      bounds.first.push_back(variable.lower - margin);
      bounds.second.push_back(variable.upper + margin);
    }
    return bounds;
  }
  pagmo::vector_double::size_type get_nobj() const { return objective_count; }
  pagmo::vector_double::size_type get_nix() const {
    return rounds ? static_cast<std::size_t>(std::ranges::count_if(
                        variables(),
                        [](const Variable& variable) { return !variable.is_continuous(); }))
                  : 0;
  }
  pagmo::vector_double fitness(const pagmo::vector_double& x) const { return batch_fitness(x); }
  pagmo::vector_double batch_fitness(const pagmo::vector_double& xs) const {
    std::vector<SearchPoint> points;
    for (std::size_t i = 0; i < xs.size(); i += variables().size()) {
      points.push_back(to_point(&xs[i]));
    }
    evaluator->evaluate(points);
    pagmo::vector_double all;
    for (const SearchPoint& point : points) {
      const auto objectives = objectives_for_pagmo(evaluator->known(point), objective_count);
      all.insert(all.end(), objectives.begin(), objectives.end());
    }
    return all;
  }
};

// Measured by the hypervolume with 200 and 600 evaluations on ZDT1 and ZDT2 (Zitzler, Deb & Thiele
// 2000) and on mixed problems of two and three objectives: nsga2 is ahead on mixed ones with 600,
// nspso on continuous ones and with 200. pagmo's MACO is behind on both, and refuses fronts of
// equal penalties; its MOEA/D knows neither whole numbers nor batches.
pagmo::algorithm create(const std::string& name, std::size_t variable_count, unsigned seed) {
  constexpr unsigned one_generation = 1;
  const pagmo::bfe batches{pagmo::member_bfe{}};
  if (name == "nsga2") {
    // One mutation per design on average, as in the paper. pagmo's rate of 0.01 suits long runs of
    // many variables; here it costs up to 80 % of the hypervolume.
    constexpr double crossover_probability = 0.95;
    constexpr double crossover_index = 10.0;
    constexpr double mutation_index = 20.0;
    pagmo::nsga2 algorithm(one_generation, crossover_probability, crossover_index,
                           1.0 / static_cast<double>(variable_count), mutation_index, seed);
    algorithm.set_bfe(batches);
    return pagmo::algorithm(algorithm);
  }
  // pagmo's defaults but for the niches: by crowding distance it reads beyond a front of one
  // design.
  constexpr double inertia = 0.6;
  constexpr double own_attraction = 2.0;
  constexpr double leader_attraction = 2.0;
  constexpr double velocity_scale = 1.0;
  constexpr double largest_velocity = 0.5;
  constexpr unsigned leaders_percent = 60;
  constexpr bool goes_on = true;
  pagmo::nspso algorithm(one_generation, inertia, own_attraction, leader_attraction, velocity_scale,
                         largest_velocity, leaders_percent, "niche count", goes_on, seed);
  algorithm.set_bfe(batches);
  return pagmo::algorithm(algorithm);
}

/// The designs of a front so far.
class Front {
 public:
  void add(const EvaluatedDesign& design) {
    const auto dominates = [](const EvaluatedDesign& a, const EvaluatedDesign& b) {
      return pagmo::pareto_dominance(a.objectives, b.objectives);
    };
    for (const EvaluatedDesign& other : designs_) {
      if (other.objectives == design.objectives || dominates(other, design)) return;
    }
    std::erase_if(designs_, [&](const EvaluatedDesign& other) { return dominates(design, other); });
    designs_.push_back(design);
  }

  std::vector<EvaluatedDesign> sorted() const {
    std::vector<EvaluatedDesign> designs = designs_;
    std::ranges::sort(designs, {}, &EvaluatedDesign::objectives);
    return designs;
  }

 private:
  std::vector<EvaluatedDesign> designs_;
};

/// One sub-space's search.
struct Island {
  pagmo::algorithm algorithm;
  pagmo::population population;
  int known_generations = 0;
};

/// One search under way.
class ParetoSearch {
 public:
  ParetoSearch(Evaluator& evaluator, const ParetoOptions& options)
      : evaluator_(evaluator), options_(options), generator_(options.seed) {}

  /// Returns where no population brings forth new designs. @throws SearchStopped at a limit
  void run() {
    const auto sub_space_count = static_cast<int>(evaluator_.sub_spaces().size());
    // All of them first: how many objectives there are is known once a design has any.
    std::vector<std::vector<SearchPoint>> first;
    for (int i = 0; i < sub_space_count; ++i) {
      first.push_back(first_population(i));
      evaluator_.evaluate(first.back());
    }
    for (int i = 0; !evaluator_.best() && i < known_generations_allowed; ++i) {
      evaluator_.evaluate(first_population(0));
    }
    if (!evaluator_.best()) return;
    std::vector<Island> islands;
    islands.reserve(first.size());
    for (int i = 0; i < sub_space_count; ++i) {
      islands.push_back(island(i, first[static_cast<std::size_t>(i)]));
    }
    while (!islands.empty()) {
      for (Island& island : islands) {
        const int before = evaluator_.evaluations();
        island.population = island.algorithm.evolve(island.population);
        island.known_generations =
            evaluator_.evaluations() == before ? island.known_generations + 1 : 0;
      }
      std::erase_if(islands, [](const Island& island) {
        return island.known_generations >= known_generations_allowed;
      });
    }
  }

 private:
  std::vector<SearchPoint> first_population(int sub_space) {
    std::vector<SearchPoint> points =
        latin_hypercube(evaluator_.sub_spaces()[static_cast<std::size_t>(sub_space)], sub_space,
                        options_.population, generator_);
    auto place = points.begin();
    for (const SearchPoint& start : options_.starts) {
      if (start.sub_space == sub_space && place != points.end()) *place++ = start;
    }
    return points;
  }

  Island island(int sub_space, const std::vector<SearchPoint>& points) {
    const auto seed = static_cast<unsigned>(generator_());
    const PagmoProblem problem{&evaluator_, sub_space, evaluator_.best()->objectives.size(),
                               options_.algorithm == "nsga2"};
    assert(problem.objective_count >= 2);
    pagmo::population population(pagmo::problem(problem), 0u, seed);
    for (const SearchPoint& point : points) {
      population.push_back(problem.from_point(point),
                           objectives_for_pagmo(evaluator_.known(point), problem.objective_count));
    }
    return {create(options_.algorithm, problem.variables().size(), seed), std::move(population), 0};
  }

  Evaluator& evaluator_;
  const ParetoOptions& options_;
  boost::random::mt19937_64 generator_;
};

}  // namespace

std::vector<std::string_view> pareto_algorithms() { return {"nsga2", "nspso"}; }

ParetoResult pareto_search(Problem& problem, const ParetoOptions& options) {
  const std::vector<std::string_view> names = pareto_algorithms();
  if (std::ranges::find(names, options.algorithm) == names.end()) {
    throw std::invalid_argument(
        fmt::format("{} is no optimizer for several objectives: there are {}", options.algorithm,
                    fmt::join(names, ", ")));
  }
  if (options.population < 8 || options.population % 4 != 0) {
    throw std::invalid_argument(
        fmt::format("a population of {} does not suit {}: take a multiple of 4, at least 8",
                    options.population, options.algorithm));
  }
  Front front;
  EvaluatorOptions evaluation = options.evaluation;
  evaluation.target.reset();
  evaluation.stagnation = 0;
  evaluation.race_significance = 0.0;
  evaluation.observer = [&](const EvaluationRecord& record) {
    if (record.failure.empty() && record.violation == 0.0) {
      front.add({record.point, record.key, record.cost, record.violation, record.objectives});
    }
    if (options.evaluation.observer) options.evaluation.observer(record);
  };
  Evaluator evaluator(problem, std::move(evaluation));

  ParetoResult result;
  try {
    ParetoSearch(evaluator, options).run();
    result.termination = Termination::converged;
  } catch (const SearchStopped& stopped) {
    result.termination = stopped.termination;
  }
  if (!evaluator.best() && evaluator.failures() > 0) {
    throw SearchFailed(fmt::format("the search failed: all {} evaluations failed, the last with {}",
                                   evaluator.evaluations(), evaluator.last_failure()));
  }
  result.front = front.sorted();
  result.evaluations = evaluator.evaluations();
  result.failures = evaluator.failures();
  result.cache_hits = evaluator.cache_hits();
  return result;
}

std::vector<bool> dominated(const std::vector<std::vector<double>>& objectives) {
  std::vector<bool> is_dominated(objectives.size(), false);
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    for (std::size_t j = 0; j < objectives.size() && !is_dominated[i]; ++j) {
      is_dominated[i] = pagmo::pareto_dominance(objectives[j], objectives[i]) ||
                        (j < i && objectives[j] == objectives[i]);
    }
  }
  return is_dominated;
}

std::vector<std::size_t> evenly_chosen(const std::vector<std::string>& groups, std::size_t most) {
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
  std::map<std::string, std::size_t> shares;
  for (std::size_t left = std::min(most, groups.size()); left > 0;) {
    for (const auto& [group, of_group] : members) {
      if (left == 0 || shares[group] == of_group.size()) continue;
      ++shares[group];
      --left;
    }
  }
  std::vector<std::size_t> chosen;
  for (const auto& [group, of_group] : members) {
    const std::size_t share = shares[group];
    for (std::size_t i = 0; i < share; ++i) {
      chosen.push_back(of_group[share == 1 ? 0 : i * (of_group.size() - 1) / (share - 1)]);
    }
  }
  std::ranges::sort(chosen);
  return chosen;
}

double hypervolume(const std::vector<EvaluatedDesign>& front,
                   const std::vector<double>& reference) {
  std::vector<std::vector<double>> points;
  for (const EvaluatedDesign& design : front) {
    assert(design.objectives.size() == reference.size());
    bool dominates = true;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      dominates = dominates && design.objectives[i] < reference[i];
    }
    if (dominates) points.push_back(design.objectives);
  }
  return points.empty() ? 0.0 : pagmo::hypervolume(points).compute(reference);
}

std::size_t knee(const std::vector<EvaluatedDesign>& front) {
  assert(!front.empty());
  std::vector<double> sums(front.size(), 0.0);
  for (std::size_t i = 0; i < front.front().objectives.size(); ++i) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const EvaluatedDesign& design : front) {
      lowest = std::min(lowest, design.objectives[i]);
      highest = std::max(highest, design.objectives[i]);
    }
    if (highest == lowest) continue;
    for (std::size_t j = 0; j < front.size(); ++j) {
      sums[j] += (front[j].objectives[i] - lowest) / (highest - lowest);
    }
  }
  return static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin());
}

}  // namespace nlcwfs
