// Means, standard errors and quantiles of samples.
#include "model/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace nlcwfs {

MeanAndError mean_and_standard_error(std::span<const double> values) {
  assert(!values.empty());
  const auto count = static_cast<Eigen::Index>(values.size());
  const Eigen::Map<const Eigen::ArrayXd> sample(values.data(), count);
  const double mean = sample.mean();
  if (count == 1) return {mean, 0.0};
  const double squares = (sample - mean).square().sum();
  return {mean, std::sqrt(squares / (static_cast<double>(count) * static_cast<double>(count - 1)))};
}

MeanAndError standard_deviation_and_error(std::span<const double> values) {
  assert(values.size() >= 2);
  const auto count = static_cast<double>(values.size());
  const double deviation = mean_and_standard_error(values).standard_error * std::sqrt(count);
  return {deviation, deviation / std::sqrt(2.0 * (count - 1.0))};
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const double place = share * double(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - double(below));
}

}  // namespace nlcwfs
