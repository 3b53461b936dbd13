#include "objectives/verified_design.hpp"

#include <cassert>
#include <cmath>

namespace nlcwfs {
namespace {

/// Differences of fewer standard errors are chance in one case of 20.
constexpr double distinguishable = 2.0;

}  // namespace

VerifiedDesign verify(const SensorDesign& design, const Simulation& verification,
                      const DesignCost& cost) {
  VerifiedDesign verified{design, verification.evaluate(design), {}};
  verified.costs = cost.per_screen(verified.performance, design);
  return verified;
}

Improvement improvement(const VerifiedDesign& candidate, const VerifiedDesign& reference) {
  assert(candidate.costs.size() == reference.costs.size());
  std::vector<double> differences;
  for (std::size_t screen = 0; screen < candidate.costs.size(); ++screen) {
    differences.push_back(reference.costs[screen] - candidate.costs[screen]);
  }
  const MeanAndError cost = mean_and_standard_error(differences);
  if (std::abs(cost.mean) <= distinguishable * cost.standard_error) {
    return {cost, Verdict::indistinguishable};
  }
  return {cost, cost.mean > 0.0 ? Verdict::better : Verdict::worse};
}

}  // namespace nlcwfs
