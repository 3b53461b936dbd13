// Variances and structure functions of phase screens.
#include "model/screen_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include <Eigen/QR>
#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

template <class Statistic>
MeanAndError over_screens(std::span<const PhaseScreen> screens, const Statistic& statistic) {
  std::vector<double> values(screens.size());
  tbb::parallel_for(std::size_t{0}, screens.size(),
                    [&](std::size_t i) { values[i] = statistic(screens[i]); });
  return mean_and_standard_error(values);
}

/// Variance over the pupil after a least-squares fit of the columns of `modes`, one row per pupil
/// sample in the order of the mask.
MeanAndError variance_without(const Eigen::MatrixXd& modes, std::span<const PhaseScreen> screens,
                              const PupilMask& pupil) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(modes);
  const Eigen::MatrixXd basis =
      decomposition.householderQ() * Eigen::MatrixXd::Identity(modes.rows(), modes.cols());
  return over_screens(screens, [&](const PhaseScreen& screen) {
    assert(screen.rows() == pupil.rows() && screen.cols() == pupil.cols());
    Eigen::VectorXd phase(modes.rows());
    for (Eigen::Index i = 0, sample = 0; i < pupil.size(); ++i) {
      if (pupil.data()[i]) phase[sample++] = screen.data()[i];
    }
    const Eigen::VectorXd fit = basis * (basis.transpose() * phase);
    return (phase - fit).squaredNorm() / static_cast<double>(phase.size());
  });
}

}  // namespace

MeanAndError piston_removed_variance(std::span<const PhaseScreen> screens, const PupilMask& pupil) {
  return variance_without(Eigen::MatrixXd::Ones(pupil.count(), 1), screens, pupil);
}

MeanAndError tilt_removed_variance(std::span<const PhaseScreen> screens, const PupilMask& pupil) {
  Eigen::MatrixXd modes(pupil.count(), 3);
  Eigen::Index sample = 0;
  for (Eigen::Index row = 0; row < pupil.rows(); ++row) {
    for (Eigen::Index column = 0; column < pupil.cols(); ++column) {
      if (pupil(row, column)) modes.row(sample++) << 1.0, double(row), double(column);
    }
  }
  return variance_without(modes, screens, pupil);
}

MeanAndError structure_function(std::span<const PhaseScreen> screens, SampleOffset offset) {
  return over_screens(screens, [&](const PhaseScreen& screen) {
    const Eigen::Index rows = screen.rows() - offset.rows;
    const Eigen::Index columns = screen.cols() - std::abs(offset.columns);
    assert(offset.rows >= 0 && rows > 0 && columns > 0);
    const Eigen::Index from = std::max(0, -offset.columns);
    const Eigen::Index to = std::max(0, offset.columns);
    return (screen.block(offset.rows, to, rows, columns) - screen.block(0, from, rows, columns))
        .square()
        .mean();
  });
}

}  // namespace nlcwfs
