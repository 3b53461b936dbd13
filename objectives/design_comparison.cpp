// Two designs are told apart, screen by screen.
#include "objectives/design_comparison.hpp"

#include <cassert>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace nlcwfs {
namespace {

/// How many standard errors a mean difference of so many screens must be from 0 for chance to be as
/// good only in one case of 20: Student's t, two-sided; 2.0 for 60 screens.
double distinguishable(std::size_t screens) {
  return boost::math::quantile(boost::math::students_t(double(screens - 1)), 0.975);
}

}  // namespace

Improvement improvement(const MeanAndError& cost, std::size_t screens) {
  if (screens < 2 || std::abs(cost.mean) <= distinguishable(screens) * cost.standard_error) {
    return {cost, Verdict::indistinguishable};
  }
  return {cost, cost.mean > 0.0 ? Verdict::better : Verdict::worse};
}

Improvement improvement(std::span<const double> candidate, std::span<const double> reference) {
  assert(candidate.size() == reference.size());
  std::vector<double> differences;
  for (std::size_t screen = 0; screen < candidate.size(); ++screen) {
    differences.push_back(reference[screen] - candidate[screen]);
  }
  return improvement(mean_and_standard_error(differences), differences.size());
}

Improvement improvement(const TriedDesign& candidate, const TriedDesign& reference) {
  return improvement(candidate.costs, reference.costs);
}

}  // namespace nlcwfs
