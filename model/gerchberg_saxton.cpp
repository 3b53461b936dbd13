// The loop: a wavefront is reconstructed from the images of several planes.
#include "model/gerchberg_saxton.hpp"

#include "model/detector.hpp"
#include "model/line_kernels.hpp"
#include "model/loop_change.hpp"
#include "model/sample_positions.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace nlcwfs {
namespace {

/// The wavefront slope (x, y; radians of angle) whose shift of the light's centroid, z times the
/// slope, fits the images best in the least-squares sense. Pixels that were not measured count as
/// their neighbours do.
/// @param axes  where the centroids of a flat wavefront are, pixels
Eigen::Array2d centroid_slope(std::span<const Image<double>> images,
                              const std::vector<double>& planes,
                              const std::vector<Eigen::Array2d>& axes, double pixel_pitch) {
  Eigen::Array2d shift_moment = Eigen::Array2d::Zero();
  double distance_moment = 0.0;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const Image<double> image = with_gaps_filled(images[plane]);
    const double light = image.sum();
    if (!(light > 0.0)) continue;
    const auto width = image.rows();
    const Eigen::ArrayXd position = sample_positions(width) * pixel_pitch;
    const double x = (image.colwise().sum().transpose() * position).sum() / light;
    const double y = (image.rowwise().sum() * position).sum() / light;
    shift_moment += planes[plane] * (Eigen::Array2d(x, y) - axes[plane] * pixel_pitch);
    distance_moment += planes[plane] * planes[plane];
  }
  return distance_moment > 0.0 ? Eigen::Array2d(shift_moment / distance_moment)
                               : Eigen::Array2d(Eigen::Array2d::Zero());
}

}  // namespace

template <class Real>
GerchbergSaxton<Real>::GerchbergSaxton(const Telescope& telescope, const SensorDesign& design,
                                       std::vector<Eigen::Array2d> axes)
    : design_(design),
      axes_(std::move(axes)),
      wavelength_(telescope.wavelength),
      pitch_(telescope.diameter / design.pupil_samples()),
      mask_(pupil_mask(design.pupil_samples(), telescope.central_obscuration)),
      propagator_(design.grid_width(), pitch_, telescope.wavelength),
      unwrapper_(mask_, design.reconstruction.unwrapping),
      workspaces_([samples = propagator_.samples(), planes = design.planes.size()] {
        return Workspace{padded_lines<Real>(samples, samples), std::vector<Image<Real>>(planes)};
      }) {
  const Eigen::Array2d middle = Eigen::Array2d::Zero();
  if (axes_.empty()) axes_.assign(design.planes.size(), middle);
  assert(axes_.size() == design.planes.size());
  const double pixel_pitch = pitch_ * design.reconstruction.oversampling;
  double position = 0.0;
  Eigen::Array2d axis = middle;
  const auto hop_to = [&](double next, const Eigen::Array2d& next_axis) {
    hops_.emplace_back();
    if (next != position || (next_axis != axis).any()) {
      const Eigen::Array2d shift = (next_axis - axis) * pixel_pitch;
      hops_.back() = Hop{.along_x = propagator_.transfer(next - position, shift.x()),
                         .along_y = propagator_.transfer(next - position, shift.y())};
    }
    position = next;
    axis = next_axis;
  };
  for (std::size_t plane = 0; plane < axes_.size(); ++plane) {
    hop_to(design.planes[plane], axes_[plane]);
  }
  hop_to(0.0, middle);
}

template <class Real>
Reconstruction GerchbergSaxton<Real>::reconstruct(
    std::span<const Image<double>> images,
    const std::function<void(const Field<double>& pupil)>& observer) const {
  assert(images.size() == design_.planes.size());
  const ReconstructionOptions& options = design_.reconstruction;
  Workspace& workspace = workspaces_.local();
  Field<Real>& field = workspace.field;
  std::vector<const Image<Real>*> measured(images.size());
  std::vector<std::vector<Gap>> gaps(images.size());
  for (std::size_t plane = 0; plane < images.size(); ++plane) {
    assert(images[plane].rows() == design_.detector.width());
    assert(images[plane].cols() == design_.detector.width());
    gaps[plane] = gaps_of(images[plane]);
    if constexpr (std::is_same_v<Real, double>) {
      measured[plane] = &images[plane];
    } else {
      workspace.converted[plane] = images[plane].template cast<Real>();
      measured[plane] = &workspace.converted[plane];
    }
  }

  const RowRange all_rows{0, propagator_.samples()};
  const RowRange pupil_rows = propagator_.middle_rows(mask_.rows());
  const RowRange plane_rows =
      options.outside == OutsideDetector::zero
          ? propagator_.middle_rows(Eigen::Index(design_.detector.width()) * options.oversampling)
          : all_rows;
  const double length_per_radian = wavelength_ / (2.0 * std::numbers::pi);

  Reconstruction result;
  result.pupil_field = first_estimate(images);
  LoopChange loop_change(options.stopping, mask_, unwrapper_, result.pupil_field);
  // Between the planes the field's rows are Fourier transforms: each plane transforms a row back,
  // replaces its amplitudes and transforms it again while it is in cache.
  while (!result.converged && result.loops < options.max_loops) {
    ++result.loops;
    RowRange lit = pupil_rows;
    // No hop overwrites what the loop before left; rows that are dark in the pupil stay dark.
    if (!hops_.front()) field.setZero();
    propagator_.transform_middle_rows(result.pupil_field, field);
    const auto hop = [&](std::size_t index, RowRange wanted) {
      if (!hops_[index]) return;
      propagator_.propagate_transformed_rows(field, hops_[index]->along_x, hops_[index]->along_y,
                                             lit, wanted);
      lit = wanted;
      result.fft_count += 2;
    };
    for (std::size_t plane = 0; plane < measured.size(); ++plane) {
      hop(plane, plane_rows);
      measure(field, *measured[plane], gaps[plane],
              static_cast<Real>(options.relaxation(result.loops)));
    }
    hop(measured.size(), pupil_rows);
    result.pupil_field = get_pupil(field);
    if (observer) observer(result.pupil_field);

    result.changes.push_back(loop_change.update(result.pupil_field) * length_per_radian);
    result.converged = result.changes.back() < options.tolerance;
  }
  result.fractional_loops = result.converged
                                ? fractional_loop_count(result.changes, options.tolerance)
                                : double(options.max_loops);
  return result;
}

template <class Real>
std::vector<Image<double>> GerchbergSaxton<Real>::predict(const Field<double>& pupil) const {
  const int oversampling = design_.reconstruction.oversampling;
  const RowRange all_rows{0, propagator_.samples()};
  const RowRange seen =
      propagator_.middle_rows(Eigen::Index(design_.detector.width()) * oversampling);
  Field<Real>& field = workspaces_.local().field;
  field.setZero();
  propagator_.transform_middle_rows(pupil, field);
  Eigen::ArrayX<std::complex<Real>> line(propagator_.samples());
  Field<double> window(seen.size(), seen.size());
  std::vector<Image<double>> images;
  for (std::size_t plane = 0; plane < design_.planes.size(); ++plane) {
    if (hops_[plane]) {
      propagator_.propagate_transformed_rows(field, hops_[plane]->along_x, hops_[plane]->along_y,
                                             all_rows, all_rows);
    }
    for (Eigen::Index row = 0; row < seen.size(); ++row) {
      propagator_.row_transform().backward(field.row(seen.first + row).data(), line.data());
      window.row(row) = line.segment(seen.first, seen.size()).template cast<std::complex<double>>();
    }
    window /= double(propagator_.samples());
    images.push_back(integrate_pixels(window, oversampling));
  }
  return images;
}

template <class Real>
double GerchbergSaxton<Real>::pupil_energy() const {
  const int oversampling = design_.reconstruction.oversampling;
  return double(mask_.count()) / (oversampling * oversampling);
}

template <class Real>
Field<double> GerchbergSaxton<Real>::first_estimate(std::span<const Image<double>> images) const {
  PhaseScreen phase = PhaseScreen::Zero(mask_.rows(), mask_.cols());
  if (design_.reconstruction.initial_guess == InitialGuess::centroid) {
    const Eigen::Array2d slope =
        centroid_slope(images, design_.planes, axes_, pitch_ * design_.reconstruction.oversampling);
    const auto samples = mask_.rows();
    const Eigen::ArrayXd position =
        sample_positions(samples) * (2.0 * std::numbers::pi / wavelength_ * pitch_);
    phase.rowwise() += slope.x() * position.transpose();
    phase.colwise() += slope.y() * position;
  }
  return nlcwfs::pupil_field(phase, mask_);
}

template <class Real>
Field<double> GerchbergSaxton<Real>::get_pupil(const Field<Real>& field) const {
  const RowRange rows = propagator_.middle_rows(mask_.rows());
  Field<double> pupil(rows.size(), rows.size());
  Eigen::ArrayX<std::complex<Real>> line(propagator_.samples());
  for (Eigen::Index row = 0; row < rows.size(); ++row) {
    propagator_.row_transform().backward(field.row(rows.first + row).data(), line.data());
    pupil.row(row) = line.segment(rows.first, rows.size()).template cast<std::complex<double>>();
  }
  return mask_.select(pupil / double(propagator_.samples()), std::complex<double>(0.0));
}

template <class Real>
void GerchbergSaxton<Real>::measure(Field<Real>& field, const Image<Real>& image,
                                    std::span<const Gap> gaps, Real relaxation) const {
  const int width = propagator_.samples();
  const int oversampling = design_.reconstruction.oversampling;
  const auto pixels = static_cast<int>(image.rows());
  const Eigen::Index border = propagator_.middle_rows(Eigen::Index(pixels) * oversampling).first;
  const LineTransform<Real>& transform = propagator_.row_transform();

  const Real row_norm = Real(1) / static_cast<Real>(width);
  const Real outside_gain =
      design_.reconstruction.outside == OutsideDetector::zero ? Real(0) : row_norm;
  Field<Real> rows = padded_lines<Real>(oversampling, width);
  Eigen::ArrayX<Real> scratch(pixels);
  std::vector<Field<Real>> kept;  // what is not measured in a row of pixels
  auto gap = gaps.begin();
  for (int pixel_row = 0; pixel_row < pixels; ++pixel_row) {
    const Eigen::Index first = border + Eigen::Index(pixel_row) * oversampling;
    for (int row = 0; row < oversampling; ++row) {
      transform.backward(field.row(first + row).data(), rows.row(row).data());
    }
    rows.leftCols(border) *= outside_gain;
    rows.middleCols(width - border, border) *= outside_gain;
    const auto first_gap = gap;
    const auto field_at = [&](const Gap& pixel) {
      return rows.block(0, border + pixel.column * oversampling, oversampling, oversampling);
    };
    kept.clear();
    for (; gap != gaps.end() && gap->row == pixel_row; ++gap) {
      kept.emplace_back(field_at(*gap) * row_norm);
    }
    replace_amplitudes(rows.data() + border, rows.cols(), oversampling, row_norm,
                       image.row(pixel_row).data(), relaxation, scratch.data(), pixels);
    for (std::size_t i = 0; i < kept.size(); ++i) field_at(first_gap[i]) = kept[i];
    for (int row = 0; row < oversampling; ++row) {
      transform.forward(rows.row(row).data(), field.row(first + row).data());
    }
  }
}

template class GerchbergSaxton<float>;
template class GerchbergSaxton<double>;

}  // namespace nlcwfs
