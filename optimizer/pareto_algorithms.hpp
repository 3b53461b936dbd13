// Generations of designs for several objectives: a genetic algorithm and a particle swarm.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

/// How far apart the neighbours of each design of a front are, summed over the objectives, each as
/// a fraction of its range over the front; infinite at the ends of each objective (crowding
/// distance; Deb, Pratap, Agarwal & Meyarivan 2002, section III B). An objective that is equal
/// throughout the front has no ends and adds nothing.
/// @param front  objectives of designs of which none dominates another
std::vector<double> crowding_distances(const std::vector<std::vector<double>>& front);

/// Designs with their objectives, all to be minimised.
struct Generation {
  std::vector<std::vector<double>> x;           ///< of each design, its variables
  std::vector<std::vector<double>> objectives;  ///< of each design
};

/// Where the designs of a generation may be.
struct GenerationSpace {
  std::pair<std::vector<double>, std::vector<double>> bounds;  ///< lower and upper ones
  std::size_t whole_numbers = 0;  ///< how many variables, the last ones, are such
};

/// An algorithm that brings forth one generation after the other.
class ParetoAlgorithm {
 public:
  virtual ~ParetoAlgorithm() = default;
  /// The designs of the next generation, as many as the first one has.
  virtual std::vector<std::vector<double>> propose() = 0;
  /// Takes the last proposed ones with their objectives in.
  virtual void accept(Generation proposed) = 0;
};

/// The names of the algorithms for several objectives:
/// `nsga2` (non-dominated sorting genetic algorithm, Deb et al. 2002) and
/// `nspso` (non-dominated sorting particle swarm, Li 2003; knows no whole numbers).
std::vector<std::string_view> pareto_algorithms();

/// @param name   one of pareto_algorithms()
/// @param first  its number of designs is a multiple of 4, at least 8
std::unique_ptr<ParetoAlgorithm> pareto_algorithm(const std::string& name,
                                                  const GenerationSpace& space, Generation first,
                                                  unsigned seed);

}  // namespace nlcwfs
