// Means, standard errors and quantiles of samples.
#pragma once

#include <span>
#include <vector>

namespace nlcwfs {

/// A sample's mean with its standard error, both in the unit of the sample.
struct MeanAndError {
  double mean;            ///< of the sample
  double standard_error;  ///< of the mean, in its unit
};

/// Mean and standard error of the mean of independent values: sqrt(s^2 / n), with the sample
/// variance s^2 over n - 1. One value says nothing about its error: 0 is returned for it.
/// @pre values is not empty
MeanAndError mean_and_standard_error(std::span<const double> values);

/// The standard deviation s of independent values (over n - 1) in place of a mean, with its own
/// standard error s / sqrt(2 (n - 1)), which holds for normal ones.
/// @pre there are at least 2
MeanAndError standard_deviation_and_error(std::span<const double> values);

/// The value that a share of the others is below, interpolated linearly between the two nearest:
/// 0.5 is the median. NaN of no values.
double quantile(std::vector<double> values, double share);

}  // namespace nlcwfs
