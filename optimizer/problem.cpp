// The problem that optimizers see: sub-spaces, variables and a cost.
#include "optimizer/problem.hpp"

#include <algorithm>
#include <numeric>

namespace nlcwfs {

std::vector<double> Variable::outstanding_values() const {
  if (is_continuous()) return {lower, upper};
  std::vector<double> values(static_cast<std::size_t>(upper - lower) + 1);
  std::iota(values.begin(), values.end(), lower);
  return values;
}

int SubSpace::continuous_count() const {
  return static_cast<int>(std::ranges::count_if(variables, &Variable::is_continuous));
}

SearchPoint lowest_point(const SubSpace& sub_space, int index) {
  SearchPoint point{index, Eigen::VectorXd(sub_space.variables.size())};
  std::ranges::transform(sub_space.variables, point.x.begin(), &Variable::lower);
  return point;
}

bool is_better(const EvaluatedDesign& a, const EvaluatedDesign& b) {
  if (a.violation != b.violation) return a.violation < b.violation;
  return a.cost < b.cost;
}

}  // namespace nlcwfs
