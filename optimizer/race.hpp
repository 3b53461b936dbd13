// Designs that are clearly worse are given up after their first samples.
#pragma once

#include <span>
#include <vector>

namespace nlcwfs {

/// Tells early that a design is worse than the best one so far, from its costs on the first
/// samples.
///
/// After 4, 8, 16, ... samples the differences to the rival's costs on the same samples are held
/// against zero by Student's t test, one-sided. A test that is repeated errs more often than once:
/// each look has an equal part of the error allowed (Bonferroni 1936).
class Race {
 public:
  /// @param rival_costs   of all samples; looks at other numbers of them than 4, 8, ... are not
  /// allowed for
  /// @param significance  the chance to give up a design that is as good as the rival, at most
  Race(std::vector<double> rival_costs, double significance);

  /// Whether it is still open that the design is as good as the rival.
  /// @param costs  of the first samples
  bool goes_on(std::span<const double> costs) const;

  /// The cost of a design from its costs on the first samples: the rival's on all samples and the
  /// mean difference on these, of which the screens' common part has dropped out.
  double estimated_cost(std::span<const double> costs) const;

 private:
  double significance_per_look() const;

  std::vector<double> rival_costs_;
  double significance_;
};

}  // namespace nlcwfs
