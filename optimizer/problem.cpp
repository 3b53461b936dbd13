#include "optimizer/problem.hpp"

#include <algorithm>

namespace nlcwfs {

int SubSpace::continuous_count() const {
  return static_cast<int>(std::ranges::count_if(variables, &Variable::is_continuous));
}

bool is_better(const EvaluatedDesign& a, const EvaluatedDesign& b) {
  if (a.violation != b.violation) return a.violation < b.violation;
  return a.cost < b.cost;
}

}  // namespace nlcwfs
