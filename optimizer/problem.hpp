// The problem that optimizers see: sub-spaces, variables and a cost.
#pragma once

#include <any>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace nlcwfs {

/// What values a variable takes.
enum class VariableKind {
  continuous,  ///< every number of its range
  integer,     ///< the whole numbers of its range, in an order that means something
  categorical  ///< the same, without such an order: names of things
};

/// A variable of a search, in whatever unit and scale suits the problem (searches divide its range
/// evenly, so a distance is best given as its logarithm).
struct Variable {
  std::string name;                              ///< for messages and tables
  double lower = 0.0;                            ///< finite
  double upper = 1.0;                            ///< finite, above `lower`
  VariableKind kind = VariableKind::continuous;  ///< which values it may have

  /// Whether it may have every value of its range.
  bool is_continuous() const { return kind == VariableKind::continuous; }

  /// All values of a discrete variable; of a continuous one both ends of its range.
  std::vector<double> outstanding_values() const;
};

/// The designs that one set of variables describes. What has other variables (a sensor of another
/// number of planes) is another sub-space.
struct SubSpace {
  std::string name;                 ///< for messages and tables
  std::vector<Variable> variables;  ///< at least one

  /// How many variables may have every value of their ranges.
  int continuous_count() const;
  /// Whether all of them may.
  bool is_continuous() const { return continuous_count() == static_cast<int>(variables.size()); }
};

/// A point of the search space.
struct SearchPoint {
  int sub_space = 0;  ///< index in the problem's
  Eigen::VectorXd x;  ///< one value per variable; of discrete ones a whole number
};

/// The point of a sub-space with all variables at the lower ends of their ranges.
/// @param index  of the sub-space
SearchPoint lowest_point(const SubSpace& sub_space, int index);

/// A point and what it costs.
struct EvaluatedDesign {
  SearchPoint point;  ///< that stands for the design
  std::string key;    ///< Problem::key of the point
  /// What a search minimises.
  double cost = std::numeric_limits<double>::infinity();
  double violation = 0.0;               ///< 0 = the design keeps all limits
  std::vector<double> objectives = {};  ///< Assessment::objectives
};

/// Whether `a` is to be preferred to `b`: a design that keeps the limits to one that does not, of
/// two that do not the one that is closer to them, else the cheaper one (Deb 2000).
bool is_better(const EvaluatedDesign& a, const EvaluatedDesign& b);

/// What a problem says of a design.
struct Assessment {
  /// The cost of each sample (such as a phase screen), in the same order for every design; the cost
  /// is their mean. Fewer than all where the assessment was ended early.
  std::vector<double> costs;
  double violation = 0.0;               ///< by how much limits are exceeded, in parts of them; >= 0
  std::vector<double> objectives = {};  ///< of problems that have several, all to be minimised
  std::any detail = {};                 ///< for the observer of the search
};

/// Asked with the costs of the first samples, and then of ever more: false ends the assessment.
using GoesOn = std::function<bool(std::span<const double> costs)>;

/// A cost to minimise over one or more sub-spaces.
class Problem {
 public:
  virtual ~Problem() = default;

  /// At least one, the same throughout a search.
  virtual std::vector<SubSpace> sub_spaces() const = 0;

  /// What identifies the design at a point: equal keys mean equal designs, also where the points
  /// differ (planes exchanged, digits that do not matter). A design is evaluated once.
  virtual std::string key(const SearchPoint& point) const = 0;

  /// The cost of the design, to be minimised; negative costs are allowed. An exception, NaN or an
  /// infinity says that this design has no cost: the search goes on without it. SearchStopped says
  /// that the search is to end, without this design.
  /// May be called from several threads at once.
  /// @param goes_on  may be empty; a problem need not ask
  virtual Assessment assess(const SearchPoint& point, const GoesOn& goes_on) = 0;
};

}  // namespace nlcwfs
