// Wavefronts are reconstructed from measured frames, and held against them.
#include "model/frame_reconstruction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>

namespace nlcwfs {
namespace {

constexpr int most_passes = 10;
constexpr double settled_change = 1e-3;  // of a plane's light

/// `image` without the pixels that were not measured.
Image<double> where_measured(const Image<double>& measured, const Image<double>& image) {
  return measured.isNaN().select(std::numeric_limits<double>::quiet_NaN(), image);
}

double sum_of_values(const Image<double>& image) { return image.isNaN().select(0.0, image).sum(); }

Eigen::Array2d displacement_of(const Image<double>& measured, const Image<double>& predicted) {
  // A small shift s turns p into p - s . grad p; the factor of p takes up an error of the scale.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Eigen::Index row = 1; row + 1 < measured.rows(); ++row) {
    for (Eigen::Index column = 1; column + 1 < measured.cols(); ++column) {
      if (std::isnan(measured(row, column))) continue;
      const Eigen::Vector3d model(0.5 * (predicted(row, column - 1) - predicted(row, column + 1)),
                                  0.5 * (predicted(row - 1, column) - predicted(row + 1, column)),
                                  predicted(row, column));
      normal += model * model.transpose();
      right += model * (measured(row, column) - predicted(row, column));
    }
  }
  return normal.ldlt().solve(right).head<2>().array();
}

PlaneConsistency consistency_of(const Image<double>& measured, const Image<double>& predicted) {
  PlaneConsistency result;
  double m = 0.0;
  double p = 0.0;
  double mm = 0.0;
  double pp = 0.0;
  double mp = 0.0;
  for (Eigen::Index i = 0; i < measured.size(); ++i) {
    const double x = measured.data()[i];
    const double y = predicted.data()[i];
    if (std::isnan(x)) continue;
    ++result.measured_pixels;
    m += x;
    p += y;
    mm += x * x;
    pp += y * y;
    mp += x * y;
  }
  const double count = result.measured_pixels;
  result.relative_rms = std::sqrt(std::max(mm - 2.0 * mp + pp, 0.0) / pp);
  const double spreads = (mm - m * m / count) * (pp - p * p / count);
  // What is left of equal values is rounding.
  if (spreads > 1e-24 * mm * pp) result.correlation = (mp - m * p / count) / std::sqrt(spreads);
  result.measured_share = p / predicted.sum();
  result.displacement = displacement_of(measured, predicted);
  return result;
}

}  // namespace

FrameReconstruction reconstruct_frames(const GerchbergSaxton<double>& reconstructor,
                                       std::span<const Image<double>> frames,
                                       std::span<const double> throughputs) {
  const std::size_t planes = frames.size();
  assert(throughputs.empty() || throughputs.size() == planes);
  const double energy = reconstructor.pupil_energy();
  std::vector<double> sums;
  for (const Image<double>& frame : frames) sums.push_back(sum_of_values(frame));
  /// The light of the planes from the shares of it that are expected on their measured pixels.
  const auto light_of = [&](const std::vector<double>& shares) {
    std::vector<double> light(planes);
    if (throughputs.empty()) {
      for (std::size_t i = 0; i < planes; ++i) light[i] = sums[i] / shares[i];
    } else {
      const double common =
          std::accumulate(sums.begin(), sums.end(), 0.0) /
          std::inner_product(shares.begin(), shares.end(), throughputs.begin(), 0.0);
      for (std::size_t i = 0; i < planes; ++i) light[i] = common * throughputs[i];
    }
    return light;
  };

  FrameReconstruction result;
  std::vector<double> light = light_of(std::vector<double>(planes, 1.0));
  double reconstructed = 0.0;
  double change = 0.0;
  do {
    ++result.passes;
    result.measured.clear();
    for (std::size_t i = 0; i < planes; ++i) {
      result.measured.emplace_back(frames[i] * (energy / light[i]));
    }
    result.reconstruction = reconstructor.reconstruct(result.measured);
    // The light of a pupil of unit amplitude, however much the reconstructed one has.
    const Field<double>& pupil = result.reconstruction.pupil_field;
    const double oversampling_squared = double(reconstructor.mask().count()) / energy;
    reconstructed = pupil.abs2().sum() / oversampling_squared;
    result.predicted = reconstructor.predict(pupil);
    std::vector<double> shares;
    for (std::size_t i = 0; i < planes; ++i) {
      shares.push_back(sum_of_values(where_measured(result.measured[i], result.predicted[i])) /
                       reconstructed);
    }
    const std::vector<double> before = std::exchange(light, light_of(shares));
    change = 0.0;
    for (std::size_t i = 0; i < planes; ++i) {
      change = std::max(change, std::abs(light[i] / before[i] - 1.0));
    }
  } while (change > settled_change && result.passes < most_passes);

  for (std::size_t i = 0; i < planes; ++i) {
    PlaneConsistency plane = consistency_of(result.measured[i], result.predicted[i]);
    plane.light = light[i];
    plane.captured_energy = result.predicted[i].sum() / reconstructed;
    result.planes.push_back(plane);
  }
  return result;
}

double relative_noise(const Image<double>& predicted, double photons_per_unit, double read_noise) {
  const double variance_floor = std::pow(read_noise / photons_per_unit, 2);
  double variance = 0.0;
  double power = 0.0;
  for (const double intensity : predicted.reshaped()) {
    if (std::isnan(intensity)) continue;
    variance += intensity / photons_per_unit + variance_floor;
    power += intensity * intensity;
  }
  return std::sqrt(variance / power);
}

}  // namespace nlcwfs
