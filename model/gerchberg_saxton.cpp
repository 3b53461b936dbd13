#include "model/gerchberg_saxton.hpp"

#include "model/loop_change.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace nlcwfs {
namespace {

/// The wavefront slope (x, y; radians of angle) whose shift of the light's centroid, z times the
/// slope, fits the images best in the least-squares sense.
Eigen::Array2d centroid_slope(std::span<const Image<double>> images,
                              const std::vector<double>& planes, double pixel_pitch) {
  Eigen::Array2d shift_moment = Eigen::Array2d::Zero();
  double distance_moment = 0.0;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const Image<double>& image = images[plane];
    const double light = image.sum();
    if (!(light > 0.0)) continue;
    const auto width = image.rows();
    const Eigen::ArrayXd position =
        Eigen::ArrayXd::LinSpaced(width, -0.5 * double(width - 1), 0.5 * double(width - 1)) *
        pixel_pitch;
    const double x = (image.colwise().sum().transpose() * position).sum() / light;
    const double y = (image.rowwise().sum() * position).sum() / light;
    shift_moment += planes[plane] * Eigen::Array2d(x, y);
    distance_moment += planes[plane] * planes[plane];
  }
  return distance_moment > 0.0 ? Eigen::Array2d(shift_moment / distance_moment)
                               : Eigen::Array2d(Eigen::Array2d::Zero());
}

}  // namespace

template <class Real>
GerchbergSaxton<Real>::GerchbergSaxton(const Telescope& telescope, const SensorDesign& design)
    : design_(design),
      wavelength_(telescope.wavelength),
      pitch_(telescope.diameter / design.pupil_samples()),
      mask_(pupil_mask(design.pupil_samples(), telescope.central_obscuration)),
      propagator_(design.grid_width(), pitch_, telescope.wavelength),
      unwrapper_(mask_, design.reconstruction.unwrapping) {}

template <class Real>
Reconstruction GerchbergSaxton<Real>::reconstruct(std::span<const Image<double>> images) const {
  assert(images.size() == design_.planes.size());
  const ReconstructionOptions& options = design_.reconstruction;
  std::vector<Image<Real>> amplitudes;
  for (const Image<double>& image : images) {
    assert(image.rows() == design_.detector.width() && image.cols() == image.rows());
    amplitudes.push_back(image.max(0.0).sqrt().template cast<Real>());
  }

  const int width = design_.grid_width();
  const auto samples = static_cast<Eigen::Index>(design_.pupil_samples());
  const Eigen::Index border = (width - samples) / 2;
  const RowRange all_rows{0, width};
  const RowRange pupil_rows{border, border + samples};
  const double length_per_radian = wavelength_ / (2.0 * std::numbers::pi);

  Reconstruction result;
  result.pupil_field = first_estimate(images);
  LoopChange loop_change(options.stopping, mask_, unwrapper_, result.pupil_field);
  Field<Real> field = padded_field<Real>(width);
  while (!result.converged && result.loops < options.max_loops) {
    ++result.loops;
    const auto relaxation = static_cast<Real>(options.relaxation(result.loops));
    field.setZero();
    field.block(border, border, samples, samples) =
        result.pupil_field.template cast<std::complex<Real>>();
    RowRange lit_rows = pupil_rows;
    double position = 0.0;
    const auto hop_to = [&](double next, RowRange wanted_rows) {
      if (next == position) return;
      propagator_.propagate(field, next - position, lit_rows, wanted_rows);
      result.fft_count += 2;
      position = next;
      lit_rows = all_rows;
    };
    for (std::size_t plane = 0; plane < amplitudes.size(); ++plane) {
      hop_to(design_.planes[plane], all_rows);
      replace_amplitude(field, amplitudes[plane], relaxation);
      lit_rows = all_rows;
    }
    hop_to(0.0, pupil_rows);
    result.pupil_field = mask_.select(
        field.block(border, border, samples, samples).template cast<std::complex<double>>(),
        std::complex<double>(0.0));

    result.changes.push_back(loop_change.update(result.pupil_field) * length_per_radian);
    result.converged = result.changes.back() < options.tolerance;
  }
  result.fractional_loops = result.converged
                                ? fractional_loop_count(result.changes, options.tolerance)
                                : double(options.max_loops);
  return result;
}

template <class Real>
Field<double> GerchbergSaxton<Real>::first_estimate(std::span<const Image<double>> images) const {
  PhaseScreen phase = PhaseScreen::Zero(mask_.rows(), mask_.cols());
  if (design_.reconstruction.initial_guess == InitialGuess::centroid) {
    const Eigen::Array2d slope =
        centroid_slope(images, design_.planes, pitch_ * design_.reconstruction.oversampling);
    const auto samples = mask_.rows();
    const Eigen::ArrayXd position =
        Eigen::ArrayXd::LinSpaced(samples, -0.5 * double(samples - 1), 0.5 * double(samples - 1)) *
        (2.0 * std::numbers::pi / wavelength_ * pitch_);
    phase.rowwise() += slope.x() * position.transpose();
    phase.colwise() += slope.y() * position;
  }
  return nlcwfs::pupil_field(phase, mask_);
}

template <class Real>
void GerchbergSaxton<Real>::replace_amplitude(Field<Real>& field, const Image<Real>& amplitude,
                                              Real relaxation) const {
  const Eigen::Index oversampling = design_.reconstruction.oversampling;
  const Eigen::Index pixels = amplitude.rows();
  const Eigen::Index border = (field.rows() - pixels * oversampling) / 2;
  const Real samples_per_pixel = static_cast<Real>(oversampling * oversampling);
  if (design_.reconstruction.outside == OutsideDetector::zero) {
    field.topRows(border).setZero();
    field.bottomRows(border).setZero();
    field.leftCols(border).setZero();
    field.middleCols(field.rows() - border, border).setZero();
  }
  Eigen::ArrayX<Real> scale(pixels);
  for (Eigen::Index row = 0; row < pixels; ++row) {
    auto samples =
        field.block(border + row * oversampling, border, oversampling, pixels * oversampling);
    scale.setZero();
    for (Eigen::Index i = 0; i < oversampling; ++i) {
      for (Eigen::Index j = 0; j < samples.cols(); ++j) {
        scale[j / oversampling] += std::norm(samples(i, j));
      }
    }
    for (Eigen::Index pixel = 0; pixel < pixels; ++pixel) {
      const Real estimated = std::sqrt(scale[pixel] / samples_per_pixel);
      const Real wanted = amplitude(row, pixel) + relaxation * (amplitude(row, pixel) - estimated);
      if (estimated > Real(0)) {
        scale[pixel] = wanted / estimated;
      } else {
        // A dark field has no phase to keep: 0 is as good as any.
        samples.middleCols(pixel * oversampling, oversampling).setConstant(wanted);
        scale[pixel] = Real(1);
      }
    }
    for (Eigen::Index i = 0; i < oversampling; ++i) {
      for (Eigen::Index j = 0; j < samples.cols(); ++j) samples(i, j) *= scale[j / oversampling];
    }
  }
}

template class GerchbergSaxton<float>;
template class GerchbergSaxton<double>;

}  // namespace nlcwfs
