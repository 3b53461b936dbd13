// Designs that are clearly worse are given up after their first samples.
#include "optimizer/race.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <boost/math/distributions/students_t.hpp>

namespace nlcwfs {

Race::Race(std::vector<double> rival_costs, double significance)
    : rival_costs_(std::move(rival_costs)), significance_(significance) {
  assert(!rival_costs_.empty() && significance > 0.0 && significance < 0.5);
}

double Race::significance_per_look() const {
  // At 4, 8, 16, ... samples, as long as these are not all.
  const auto looks = static_cast<int>(std::bit_width(rival_costs_.size() - 1)) - 2;
  return significance_ / std::max(1, looks);
}

bool Race::goes_on(std::span<const double> costs) const {
  assert(costs.size() <= rival_costs_.size());
  if (costs.size() < 2) return true;
  const auto count = static_cast<double>(costs.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) sum += costs[i] - rival_costs_[i];
  const double mean = sum / count;
  if (!(mean > 0.0)) return true;
  double squares = 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double deviation = costs[i] - rival_costs_[i] - mean;
    squares += deviation * deviation;
  }
  const double standard_error = std::sqrt(squares / (count - 1.0) / count);
  const boost::math::students_t distribution(count - 1.0);
  return mean <=
         standard_error * boost::math::quantile(complement(distribution, significance_per_look()));
}

double Race::estimated_cost(std::span<const double> costs) const {
  assert(!costs.empty() && costs.size() <= rival_costs_.size());
  double difference = 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) difference += costs[i] - rival_costs_[i];
  return std::accumulate(rival_costs_.begin(), rival_costs_.end(), 0.0) /
             static_cast<double>(rival_costs_.size()) +
         difference / static_cast<double>(costs.size());
}

}  // namespace nlcwfs
