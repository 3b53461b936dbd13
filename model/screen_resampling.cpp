// A phase is brought to another number of samples.
#include "model/screen_resampling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nlcwfs {
namespace {

/// The weights of `size` samples in each of `samples` new ones along one axis.
Eigen::MatrixXd resampling_weights(int samples, int size) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(samples, size);
  const double step = double(size) / samples;
  for (int sample = 0; sample < samples; ++sample) {
    if (step >= 1.0) {
      const double begin = sample * step;
      const double end = begin + step;
      const int last = std::min(size, static_cast<int>(std::ceil(end)));
      for (int i = static_cast<int>(begin); i < last; ++i) {
        weights(sample, i) =
            std::max(0.0, std::min(end, i + 1.0) - std::max(begin, double(i))) / step;
      }
    } else {
      const double position = (sample + 0.5) * step - 0.5;
      const int left = std::clamp(static_cast<int>(std::floor(position)), 0, size - 2);
      weights(sample, left) = left + 1 - position;
      weights(sample, left + 1) = position - left;
    }
  }
  return weights;
}

}  // namespace

PhaseScreen resampled_screen(const PhaseScreen& screen, int samples) {
  assert(screen.rows() == screen.cols() && screen.rows() >= 2 && samples >= 1);
  const Eigen::MatrixXd weights = resampling_weights(samples, static_cast<int>(screen.rows()));
  return (weights * screen.matrix() * weights.transpose()).array();
}

}  // namespace nlcwfs
