// Generations of designs for several objectives: a genetic algorithm and a particle swarm.
#include "optimizer/pareto_algorithms.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <pagmo/rng.hpp>
#include <pagmo/utils/genetic_operators.hpp>
#include <pagmo/utils/multi_objective.hpp>

namespace nlcwfs {
namespace {

using Engine = pagmo::detail::random_engine_type;

/// A design's place among others.
struct Standing {
  std::size_t front = 0;  ///< how many fronts stand before its own
  double crowding = 0.0;  ///< see crowding_distances

  bool operator<(const Standing& other) const {
    return front != other.front ? front < other.front : crowding > other.crowding;
  }
};

std::vector<Standing> standings(const std::vector<std::vector<double>>& objectives) {
  std::vector<Standing> all(objectives.size());
  const auto fronts = std::get<0>(pagmo::fast_non_dominated_sorting(objectives));
  for (std::size_t front = 0; front < fronts.size(); ++front) {
    std::vector<std::vector<double>> of_front;
    for (const std::size_t i : fronts[front]) of_front.push_back(objectives[i]);
    const std::vector<double> crowding = crowding_distances(of_front);
    for (std::size_t i = 0; i < of_front.size(); ++i) all[fronts[front][i]] = {front, crowding[i]};
  }
  return all;
}

/// The best ones of a generation, in order.
Generation best_of(const Generation& all, std::size_t count) {
  const std::vector<Standing> standing = standings(all.objectives);
  std::vector<std::size_t> order(standing.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::less{}, [&](std::size_t i) { return standing[i]; });
  Generation best;
  for (std::size_t i = 0; i < count; ++i) {
    best.x.push_back(all.x[order[i]]);
    best.objectives.push_back(all.objectives[order[i]]);
  }
  return best;
}

void append(Generation& generation, Generation others) {
  std::ranges::move(others.x, std::back_inserter(generation.x));
  std::ranges::move(others.objectives, std::back_inserter(generation.objectives));
}

/// Its operators are pagmo's. Its own crowding distance divides by an objective's range, so that
/// one which is equal throughout a front takes the front's ends away.
class GeneticAlgorithm : public ParetoAlgorithm {
 public:
  GeneticAlgorithm(GenerationSpace space, Generation first, unsigned seed)
      : space_(std::move(space)), designs_(std::move(first)), engine_(seed) {}

  std::vector<std::vector<double>> propose() override {
    const std::vector<Standing> standing = standings(designs_.objectives);
    const auto winner = [&](std::size_t a, std::size_t b) {
      return standing[b] < standing[a] ? b : a;
    };
    std::vector<std::vector<double>> children;
    for (int half = 0; half < 2; ++half) {
      const std::vector<std::size_t> order = shuffled(standing.size());
      for (std::size_t i = 0; i < order.size(); i += 4) {
        const std::size_t mother = winner(order[i], order[i + 1]);
        const std::size_t father = winner(order[i + 2], order[i + 3]);
        auto [one, other] =
            pagmo::sbx_crossover(designs_.x[mother], designs_.x[father], space_.bounds,
                                 space_.whole_numbers, 0.95, 10.0, engine_);
        for (std::vector<double>* child : {&one, &other}) {
          // One mutation per design on average, as in the paper. pagmo's rate of 0.01 suits long
          // runs of many variables; here it costs up to 80 % of the hypervolume.
          pagmo::polynomial_mutation(*child, space_.bounds, space_.whole_numbers,
                                     1.0 / double(child->size()), 20.0, engine_);
          children.push_back(std::move(*child));
        }
      }
    }
    return children;
  }

  void accept(Generation proposed) override {
    const std::size_t count = designs_.x.size();
    append(designs_, std::move(proposed));
    designs_ = best_of(designs_, count);
  }

 private:
  std::vector<std::size_t> shuffled(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count - 1; i > 0; --i) {
      const boost::random::uniform_int_distribution<std::size_t> up_to_i(0, i);
      std::swap(order[i], order[up_to_i(engine_)]);
    }
    return order;
  }

  GenerationSpace space_;
  Generation designs_;
  Engine engine_;
};

/// Particles that are drawn to the best designs so far and to leaders among them. The constants are
/// those of the paper's experiments, the largest velocity half of each range.
class ParticleSwarm : public ParetoAlgorithm {
 public:
  ParticleSwarm(GenerationSpace space, Generation first, unsigned seed)
      : space_(std::move(space)), places_(first.x), best_(std::move(first)), engine_(seed) {
    best_ = best_of(best_, places_.size());
    for (const std::vector<double>& place : places_) {
      velocities_.emplace_back();
      for (std::size_t i = 0; i < place.size(); ++i) {
        velocities_.back().push_back(uniform(-fastest(i), fastest(i)));
      }
    }
  }

  std::vector<std::vector<double>> propose() override {
    constexpr double inertia = 0.6;
    constexpr double attraction = 2.0;
    const std::size_t leaders = leader_count();
    const boost::random::uniform_int_distribution<std::size_t> any_leader(0, leaders - 1);
    for (std::size_t particle = 0; particle < places_.size(); ++particle) {
      const std::vector<double>& own = best_.x[particle];
      const std::vector<double>& leader = best_.x[any_leader(engine_)];
      const double to_own = attraction * uniform(0.0, 1.0);
      const double to_leader = attraction * uniform(0.0, 1.0);
      for (std::size_t i = 0; i < own.size(); ++i) {
        double& x = places_[particle][i];
        double& velocity = velocities_[particle][i];
        velocity =
            std::clamp(inertia * velocity + to_own * (own[i] - x) + to_leader * (leader[i] - x),
                       -fastest(i), fastest(i));
        const double inside =
            std::clamp(x + velocity, space_.bounds.first[i], space_.bounds.second[i]);
        if (inside != x + velocity) velocity = 0.0;
        x = inside;
      }
    }
    return places_;
  }

  void accept(Generation proposed) override {
    append(best_, std::move(proposed));
    best_ = best_of(best_, places_.size());
  }

 private:
  double fastest(std::size_t variable) const {
    return 0.5 * (space_.bounds.second[variable] - space_.bounds.first[variable]);
  }

  double uniform(double lower, double upper) {
    return boost::random::uniform_real_distribution<double>(lower, upper)(engine_);
  }

  /// The less crowded ones of the first front, which stand first.
  std::size_t leader_count() const {
    const std::vector<Standing> standing = standings(best_.objectives);
    const auto in_front = std::ranges::count(standing, std::size_t{0}, &Standing::front);
    return static_cast<std::size_t>(std::max(2.0, std::ceil(0.6 * double(in_front))));
  }

  GenerationSpace space_;
  std::vector<std::vector<double>> places_;
  std::vector<std::vector<double>> velocities_;
  Generation best_;  ///< the best designs so far, in order
  Engine engine_;
};

}  // namespace

std::vector<double> crowding_distances(const std::vector<std::vector<double>>& front) {
  std::vector<std::vector<double>> varying(front.size());
  for (std::size_t objective = 0; objective < front.front().size(); ++objective) {
    const auto value = [&](const std::vector<double>& design) { return design[objective]; };
    const auto [lowest, highest] = std::ranges::minmax(front, {}, value);
    if (value(lowest) == value(highest)) continue;
    for (std::size_t i = 0; i < front.size(); ++i) varying[i].push_back(value(front[i]));
  }
  // Where none dominates another, one objective does not vary alone.
  if (varying.front().size() < 2) return std::vector<double>(front.size(), 0.0);
  return pagmo::crowding_distance(varying);
}

// Measured by the hypervolume with 200 and 600 evaluations on ZDT1 and ZDT2 (Zitzler, Deb & Thiele
// 2000) and on mixed problems of two and three objectives: nsga2 is ahead on mixed ones with 600,
// nspso on continuous ones and with 200. pagmo's MACO is behind on both, and refuses fronts of
// equal penalties; its MOEA/D knows neither whole numbers nor batches.
std::vector<std::string_view> pareto_algorithms() { return {"nsga2", "nspso"}; }

std::unique_ptr<ParetoAlgorithm> pareto_algorithm(const std::string& name,
                                                  const GenerationSpace& space, Generation first,
                                                  unsigned seed) {
  assert(first.x.size() >= 8 && first.x.size() % 4 == 0);
  if (name == "nsga2") return std::make_unique<GeneticAlgorithm>(space, std::move(first), seed);
  return std::make_unique<ParticleSwarm>(space, std::move(first), seed);
}

}  // namespace nlcwfs
