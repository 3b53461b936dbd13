// Points that fill a space.
#include "optimizer/latin_hypercube.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <boost/random/uniform_int_distribution.hpp>

namespace nlcwfs {

std::vector<SearchPoint> latin_hypercube(const SubSpace& space, int sub_space, int count,
                                         boost::random::mt19937_64& generator) {
  assert(count >= 1);
  std::vector<std::size_t> part(static_cast<std::size_t>(count));
  std::vector<SearchPoint> points(part.size(),
                                  {sub_space, Eigen::VectorXd(space.variables.size())});
  Eigen::Index i = 0;
  for (const auto& [name, lower, upper, kind] : space.variables) {
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t j = part.size() - 1; j > 0; --j) {
      const boost::random::uniform_int_distribution<std::size_t> up_to_j(0, j);
      std::swap(part[j], part[up_to_j(generator)]);
    }
    for (std::size_t j = 0; j < part.size(); ++j) {
      const double middle = (static_cast<double>(part[j]) + 0.5) / count;
      points[j].x[i] = kind == VariableKind::continuous
                           ? lower + middle * (upper - lower)
                           : std::floor(lower + middle * (upper - lower + 1.0));
    }
    ++i;
  }
  return points;
}

}  // namespace nlcwfs
