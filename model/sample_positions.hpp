// Where the samples of a grid stand.
#pragma once

#include <Eigen/Core>

namespace nlcwfs {

/// The centres of samples along one axis of a grid about the optical axis, (i - (samples - 1) / 2),
/// in units of the pitch.
inline Eigen::ArrayXd sample_positions(Eigen::Index samples) {
  const double half = 0.5 * static_cast<double>(samples - 1);
  return Eigen::ArrayXd::LinSpaced(samples, -half, half);
}

}  // namespace nlcwfs
