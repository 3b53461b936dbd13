// Several objectives are minimised at once.
#include "optimizer/pareto_search.hpp"

#include "optimizer/latin_hypercube.hpp"
#include "optimizer/pareto_algorithms.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

std::vector<double> compared_objectives(const std::optional<EvaluatedDesign>& design,
                                        std::size_t count) {
  if (!design) return std::vector<double>(count, penalty_of_failure);
  if (design->violation > 0.0) {
    return std::vector<double>(count, penalty_of_violation(design->violation));
  }
  assert(design->objectives.size() == count);
  return design->objectives;
}

/// A sub-space as the algorithms see it: the continuous variables come first, and those that an
/// algorithm knows as whole numbers after them.
class SubSpaceCoding {
 public:
  /// @param rounds  whether the algorithm itself knows whole numbers
  SubSpaceCoding(const SubSpace& space, int sub_space, bool rounds) : sub_space_(sub_space) {
    const std::vector<Variable>& variables = space.variables;
    order_.resize(variables.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_partition(order_,
                                  [&](std::size_t i) { return variables[i].is_continuous(); });
    for (const std::size_t i : order_) {
      const bool is_whole = !variables[i].is_continuous();
      // Rounded, the values at the ends then have as wide a range as the others.
      const double margin = is_whole && !rounds ? 0.499 : 0.0;
      space_.bounds.first.push_back(variables[i].lower - margin);
      space_.bounds.second.push_back(variables[i].upper + margin);
      if (is_whole && rounds) ++space_.whole_numbers;
    }
  }

  const GenerationSpace& space() const { return space_; }

  SearchPoint to_point(const std::vector<double>& x) const {
    SearchPoint point{sub_space_, Eigen::VectorXd(x.size())};
    for (std::size_t i = 0; i < x.size(); ++i) point.x[Eigen::Index(order_[i])] = x[i];
    return point;
  }

  std::vector<double> from_point(const SearchPoint& point) const {
    std::vector<double> x;
    for (const std::size_t i : order_) x.push_back(point.x[Eigen::Index(i)]);
    return x;
  }

 private:
  int sub_space_;
  std::vector<std::size_t> order_;
  GenerationSpace space_;
};

/// @param front  the designs so far that no other dominates
void add_to_front(std::vector<EvaluatedDesign>& front, const EvaluatedDesign& design) {
  const auto dominates = [](const EvaluatedDesign& a, const EvaluatedDesign& b) {
    return pagmo::pareto_dominance(a.objectives, b.objectives);
  };
  for (const EvaluatedDesign& other : front) {
    if (other.objectives == design.objectives || dominates(other, design)) return;
  }
  std::erase_if(front, [&](const EvaluatedDesign& other) { return dominates(design, other); });
  front.push_back(design);
}

/// One sub-space's search.
struct Island {
  SubSpaceCoding coding;
  std::unique_ptr<ParetoAlgorithm> algorithm;
  int known_generations = 0;
};

/// One search under way.
struct ParetoSearch {
  Evaluator& evaluator;
  const ParetoOptions& options;
  boost::random::mt19937_64 generator{options.seed};

  /// Returns where no population brings forth new designs. @throws SearchStopped at a limit
  void run() {
    const auto sub_space_count = static_cast<int>(evaluator.sub_spaces().size());
    // All of them first: how many objectives there are is known once a design has any.
    std::vector<std::vector<SearchPoint>> first;
    for (int i = 0; i < sub_space_count; ++i) {
      first.push_back(first_population(i));
      evaluator.evaluate(first.back());
    }
    for (int i = 0; !evaluator.best() && i < known_generations_allowed; ++i) {
      evaluator.evaluate(first_population(0));
    }
    if (!evaluator.best()) return;
    std::vector<Island> islands;
    for (int i = 0; i < sub_space_count; ++i) {
      islands.push_back(island(i, first[static_cast<std::size_t>(i)]));
    }
    while (!islands.empty()) {
      for (Island& island : islands) {
        const int before = evaluator.evaluations();
        std::vector<SearchPoint> points;
        for (const auto& x : island.algorithm->propose()) {
          points.push_back(island.coding.to_point(x));
        }
        evaluator.evaluate(points);
        island.algorithm->accept(generation(island.coding, points));
        island.known_generations =
            evaluator.evaluations() == before ? island.known_generations + 1 : 0;
      }
      std::erase_if(islands, [](const Island& island) {
        return island.known_generations >= known_generations_allowed;
      });
    }
  }

  std::vector<SearchPoint> first_population(int sub_space) {
    std::vector<SearchPoint> points =
        latin_hypercube(evaluator.sub_spaces()[static_cast<std::size_t>(sub_space)], sub_space,
                        options.population, generator);
    auto place = points.begin();
    for (const SearchPoint& start : options.starts) {
      if (start.sub_space == sub_space && place != points.end()) *place++ = start;
    }
    return points;
  }

  /// Evaluated designs as the algorithms see them.
  Generation generation(const SubSpaceCoding& coding, const std::vector<SearchPoint>& points) {
    const std::size_t objectives = evaluator.best()->objectives.size();
    assert(objectives >= 2);
    Generation generation;
    for (const SearchPoint& point : points) {
      generation.x.push_back(coding.from_point(point));
      generation.objectives.push_back(compared_objectives(evaluator.known(point), objectives));
    }
    return generation;
  }

  Island island(int sub_space, const std::vector<SearchPoint>& points) {
    SubSpaceCoding coding(evaluator.sub_spaces()[static_cast<std::size_t>(sub_space)], sub_space,
                          options.algorithm == "nsga2");
    auto algorithm = pareto_algorithm(options.algorithm, coding.space(), generation(coding, points),
                                      static_cast<unsigned>(generator()));
    return {std::move(coding), std::move(algorithm), 0};
  }
};

}  // namespace

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
  std::vector<EvaluatedDesign> front;
  EvaluatorOptions evaluation = options.evaluation;
  evaluation.target.reset();
  evaluation.stagnation = 0;
  evaluation.race_significance = 0.0;
  evaluation.observer = [&](const EvaluationRecord& record) {
    if (record.failure.empty() && record.violation == 0.0) {
      add_to_front(front,
                   {record.point, record.key, record.cost, record.violation, record.objectives});
    }
    if (options.evaluation.observer) options.evaluation.observer(record);
  };
  Evaluator evaluator(problem, std::move(evaluation));

  const SearchOutcome outcome = evaluator.outcome_of([&] {
    ParetoSearch{evaluator, options}.run();
  });
  std::ranges::sort(front, {}, &EvaluatedDesign::objectives);
  return {outcome, std::move(front)};
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
    if (std::ranges::equal(design.objectives, reference, std::less())) {
      points.push_back(design.objectives);
    }
  }
  return points.empty() ? 0.0 : pagmo::hypervolume(points).compute(reference);
}

std::size_t knee(const std::vector<EvaluatedDesign>& front) {
  assert(!front.empty());
  std::vector<double> sums(front.size(), 0.0);
  for (std::size_t i = 0; i < front.front().objectives.size(); ++i) {
    const auto objective = [i](const EvaluatedDesign& design) { return design.objectives[i]; };
    const double lowest = objective(*std::ranges::min_element(front, {}, objective));
    const double range = objective(*std::ranges::max_element(front, {}, objective)) - lowest;
    if (range == 0.0) continue;
    for (std::size_t j = 0; j < front.size(); ++j)
      sums[j] += (objective(front[j]) - lowest) / range;
  }
  return static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin());
}

}  // namespace nlcwfs
