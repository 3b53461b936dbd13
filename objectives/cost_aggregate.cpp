// Costs under several conditions become one.
#include "objectives/cost_aggregate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <boost/math/distributions/normal.hpp>

namespace nlcwfs {
namespace {

using Costs = std::vector<std::vector<double>>;

/// Of each screen, the mean over the conditions of `value(cost)`.
template <class Value>
std::vector<double> mean_over_conditions(const Costs& costs, const Value& value) {
  std::vector<double> means(costs.front().size(), 0.0);
  for (const std::vector<double>& of_condition : costs) {
    for (std::size_t i = 0; i < means.size(); ++i) means[i] += value(of_condition[i]);
  }
  for (double& mean : means) mean /= double(costs.size());
  return means;
}

/// The costs of all screens and conditions in order, and the quantile among them.
struct PooledQuantile {
  PooledQuantile(const Costs& costs, double level) : level_(level) {
    for (const std::vector<double>& of_condition : costs) {
      sorted_.insert(sorted_.end(), of_condition.begin(), of_condition.end());
    }
    std::ranges::sort(sorted_);
    // As many costs as the level says are at most the quantile; products such as 0.07 x 100 may be
    // a rounding error above the whole number that they are.
    const double rank = std::ceil(level * double(sorted_.size()) * (1.0 - 1e-12));
    index_ = static_cast<std::size_t>(rank) - 1;
  }

  double value() const { return sorted_[index_]; }

  /// 1 / density at the quantile.
  double sparsity() const {
    const auto count = double(sorted_.size());
    if (sorted_.size() == 1) return 0.0;
    const boost::math::normal normal;
    const double z = boost::math::quantile(normal, level_);
    const double density = boost::math::pdf(normal, z);
    constexpr double z_of_interval = 1.96;  // intervals of 95 %
    const double bandwidth = std::pow(count, -1.0 / 3.0) * std::pow(z_of_interval, 2.0 / 3.0) *
                             std::cbrt(1.5 * density * density / (2.0 * z * z + 1.0));
    const auto steps = static_cast<std::size_t>(std::ceil(bandwidth * count));
    const std::size_t low = index_ - std::min(steps, index_);
    const std::size_t high = std::min(index_ + steps, sorted_.size() - 1);
    return (sorted_[high] - sorted_[low]) * count / double(high - low);
  }

 private:
  double level_;
  std::vector<double> sorted_;
  std::size_t index_ = 0;
};

std::vector<double> worst(const Costs& costs) {
  const auto sum = [](const std::vector<double>& of_condition) {
    return std::accumulate(of_condition.begin(), of_condition.end(), 0.0);
  };
  return *std::ranges::max_element(costs, {}, sum);
}

std::vector<double> quantile(const Costs& costs, double level) {
  const PooledQuantile pooled(costs, level);
  const double value = pooled.value();
  const double sparsity = pooled.sparsity();
  std::vector<double> values =
      mean_over_conditions(costs, [&](double cost) { return cost > value ? 1.0 : 0.0; });
  const double share = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  for (double& above : values) above = value + (above - share) * sparsity;
  return values;
}

std::vector<double> cvar(const Costs& costs, double level) {
  const double value = PooledQuantile(costs, level).value();
  return mean_over_conditions(
      costs, [&](double cost) { return value + std::max(0.0, cost - value) / (1.0 - level); });
}

}  // namespace

std::vector<double> CostAggregate::per_screen(const Costs& costs) const {
  assert(!costs.empty() && !costs.front().empty());
  assert(std::ranges::all_of(costs,
                             [&](const auto& row) { return row.size() == costs.front().size(); }));
  switch (kind) {
    case AggregateKind::mean:
      break;
    case AggregateKind::worst:
      return worst(costs);
    case AggregateKind::quantile:
      return quantile(costs, level);
    case AggregateKind::cvar:
      return cvar(costs, level);
  }
  return mean_over_conditions(costs, [](double cost) { return cost; });
}

}  // namespace nlcwfs
