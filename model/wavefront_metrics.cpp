// A reconstruction is held against the truth: wavefront errors and Strehl ratio.
#include "model/wavefront_metrics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace nlcwfs {
namespace {

/// `image` repeated over square blocks of factor x factor samples.
Image<double> repeat(const Image<double>& image, Eigen::Index factor) {
  const Eigen::Index samples = image.rows() * factor;
  const Eigen::ArrayX<Eigen::Index> source =
      Eigen::ArrayX<Eigen::Index>::LinSpaced(samples, 0, samples - 1) / factor;
  return image(source, source);
}

/// The samples 0 <= index < size that lie within half_width of a position.
int first_within(double position, double half_width) {
  return std::max(0, static_cast<int>(std::ceil(position - half_width)));
}
int last_within(double position, double half_width, int size) {
  return std::min(size - 1, static_cast<int>(std::floor(position + half_width)));
}

}  // namespace

double piston(const Image<double>& phase, const PupilMask& mask) {
  return mask.select(phase, 0.0).sum() / double(mask.count());
}

double piston_free_rms(const Image<double>& phase, const PupilMask& mask) {
  const double mean = piston(phase, mask);
  return std::sqrt(mask.select((phase - mean).square(), 0.0).sum() / double(mask.count()));
}

double wrapped_phase_rms(const Field<double>& field, const Field<double>& reference,
                         const PupilMask& mask) {
  const std::complex<double> dark = 0.0;
  const Field<double> quotient = mask.select(field * reference.conjugate(), dark);
  const Image<double> phase = (quotient * std::conj(quotient.sum())).arg();
  return std::sqrt(mask.select(phase.square(), 0.0).sum() / double(mask.count()));
}

double field_estimated_strehl(const Field<double>& field, const Field<double>& truth,
                              const PupilMask& mask) {
  const std::complex<double> overlap =
      mask.select(field * truth.conjugate(), std::complex<double>(0.0)).sum();
  const double energies =
      mask.select(field.abs2(), 0.0).sum() * mask.select(truth.abs2(), 0.0).sum();
  return energies > 0.0 ? std::norm(overlap) / energies : 0.0;
}

double recovered_share(const Image<double>& phase, const Image<double>& truth,
                       const PupilMask& mask) {
  const Image<double> weight = mask.cast<double>();
  const Image<double> centred = weight * (truth - (weight * truth).sum() / weight.sum());
  const double power = centred.square().sum();
  return power > 0.0 ? (centred * mask.select(phase, 0.0)).sum() / power : 0.0;
}

Image<double> truth_on_samples(const PhaseScreen& truth, Eigen::Index samples) {
  return samples <= truth.rows() ? block_average(truth, truth.rows() / samples)
                                 : repeat(truth, samples / truth.rows());
}

Image<double> resample_over_mask(const Image<double>& phase, const PupilMask& mask, int samples) {
  const auto size = static_cast<int>(phase.rows());
  const Image<double> weight = mask.cast<double>();
  const Image<double> weighted = mask.select(phase, 0.0);
  if (samples <= size) {
    assert(size % samples == 0);
    const Image<double> total = block_average(weight, size / samples);
    return (total > 0.0).select(block_average(weighted, size / samples) / total, 0.0);
  }
  assert(samples % size == 0);
  Image<double> resampled = Image<double>::Zero(samples, samples);
  for (int row = 0; row < samples; ++row) {
    const double y = (row + 0.5) * size / samples - 0.5;
    for (int column = 0; column < samples; ++column) {
      const double x = (column + 0.5) * size / samples - 0.5;
      // A tent of half-width 1 is linear interpolation; at the pupil's ragged edge, where it holds
      // no sample of the mask, a wider one takes the nearest.
      for (double half_width : {1.0, 2.0, 3.0}) {
        double sum = 0.0;
        double weight_sum = 0.0;
        for (int i = first_within(y, half_width); i <= last_within(y, half_width, size); ++i) {
          for (int j = first_within(x, half_width); j <= last_within(x, half_width, size); ++j) {
            const double share = (half_width - std::abs(y - i)) * (half_width - std::abs(x - j));
            sum += share * weighted(i, j);
            weight_sum += share * weight(i, j);
          }
        }
        if (weight_sum > 0.0) {
          resampled(row, column) = sum / weight_sum;
          break;
        }
      }
    }
  }
  return resampled;
}

WavefrontMetrics measure_wavefront(const Field<double>& field, const Image<double>& unwrapped,
                                   const PupilMask& mask, const PhaseScreen& truth,
                                   const PupilMask& truth_mask, double wavelength) {
  const Image<double> sampled_truth = truth_on_samples(truth, mask.rows());
  const Field<double> true_field = pupil_field(sampled_truth, mask);
  const Image<double> representable =
      resample_over_mask(sampled_truth, mask, static_cast<int>(truth.rows()));
  const double length_per_radian = wavelength / (2.0 * std::numbers::pi);
  const double residual = length_per_radian * piston_free_rms(unwrapped - sampled_truth, mask);
  const double unresolved = length_per_radian * piston_free_rms(representable - truth, truth_mask);
  return {.residual_wfe = residual,
          .wrapped_wfe = length_per_radian * wrapped_phase_rms(field, true_field, mask),
          .total_wfe = std::hypot(residual, unresolved),
          .field_strehl = field_estimated_strehl(field, true_field, mask),
          .recovered_share = recovered_share(unwrapped, sampled_truth, mask)};
}

}  // namespace nlcwfs
