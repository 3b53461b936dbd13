#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace nlcwfs {

/// A continuous variable of a search, in whatever unit and scale suits the problem (searches divide
/// its range evenly, so a distance is best given as its logarithm).
struct Variable {
  std::string name;
  double lower = 0.0;  ///< finite
  double upper = 1.0;  ///< finite, above `lower`
};

/// A point of the search space.
struct SearchPoint {
  int choice = 0;
  Eigen::VectorXd x;  ///< one value per variable
};

/// A point and what it costs.
struct EvaluatedDesign {
  SearchPoint point;
  std::string key;  ///< Problem::key of the point
  double cost = std::numeric_limits<double>::infinity();
};

/// A cost to minimise over a box of continuous variables in each of a list of discrete alternatives
/// ("choices": sub-spaces over the same variables, such as the order in which planes are visited).
class Problem {
 public:
  virtual ~Problem() = default;

  /// The continuous variables, at least one, the same for every choice and throughout a search.
  virtual std::vector<Variable> variables() const = 0;

  /// The number of discrete alternatives, at least 1: a choice is 0 <= choice < choice_count().
  virtual int choice_count() const { return 1; }

  /// What identifies the design at a point: equal keys mean equal designs, also where the points
  /// differ (planes exchanged, digits that do not matter). A design is evaluated once.
  virtual std::string key(const SearchPoint& point) const = 0;

  /// The cost of the design, to be minimised; negative costs are allowed. An exception, NaN or an
  /// infinity says that this design has no cost: the search goes on without it.
  virtual double cost(const SearchPoint& point) = 0;
};

}  // namespace nlcwfs
