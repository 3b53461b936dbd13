#include "model/wrap_free_propagator.hpp"

#include "model/fresnel_propagator.hpp"
#include "model/line_kernels.hpp"

#include <bit>
#include <cassert>
#include <cmath>

namespace nlcwfs {

WrapFreePropagator::WrapFreePropagator(int pupil_samples, int window_samples, double pitch,
                                       double wavelength, double period_margin)
    : pupil_samples_(pupil_samples),
      window_samples_(window_samples),
      pitch_(pitch),
      wavelength_(wavelength),
      period_margin_(period_margin),
      transform_(fast_transform_length(pupil_samples + window_samples - 1)) {
  assert((window_samples - pupil_samples) % 2 == 0);
}

Eigen::ArrayXcd WrapFreePropagator::transfer_function(double distance) const {
  const int length = transform_.length();
  // The kernel's tails beyond the reach of the band limit alternate in sign and fall with the
  // square of the distance, so that a period of many reaches leaves nothing of them.
  const double reach = wavelength_ * std::abs(distance) / (2.0 * pitch_ * pitch_) + length;
  const auto period =
      static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(period_margin_ * reach))));
  Eigen::ArrayXcd kernel =
      fresnel_transfer_function(period, pitch_, wavelength_, distance) / double(period);
  LineTransform<double>(period).backward(kernel.data());

  // Window sample j stands (j - k - shift) pitches from pupil sample k.
  const int shift = (window_samples_ - pupil_samples_) / 2;
  Eigen::ArrayXcd transfer = Eigen::ArrayXcd::Zero(length);
  for (int offset = 1 - pupil_samples_; offset < window_samples_; ++offset) {
    transfer[(offset + length) % length] = kernel[(offset - shift + period) % period];
  }
  transform_.forward(transfer.data());
  return transfer / double(length);
}

Field<double> WrapFreePropagator::spectrum(const Field<double>& pupil) const {
  assert(pupil.rows() == pupil_samples_ && pupil.cols() == pupil_samples_);
  Field<double> spectrum = padded_field<double>(transform_.length());
  spectrum.topLeftCorner(pupil_samples_, pupil_samples_) = pupil;
  for_each_row(spectrum, 0, pupil_samples_,
               [&](std::complex<double>* row) { transform_.forward(row); });
  for_each_column(spectrum, transform_.length(),
                  [&](std::complex<double>* column, Eigen::Index) { transform_.forward(column); });
  return spectrum;
}

Field<double> WrapFreePropagator::field(const Field<double>& spectrum,
                                        const Eigen::ArrayXcd& transfer) const {
  assert(spectrum.rows() == transform_.length() && transfer.size() == transform_.length());
  Field<double> field = spectrum;
  for_each_column(field, transform_.length(),
                  [&](std::complex<double>* column, Eigen::Index index) {
                    multiply_line(column, transfer.data(), transfer[index], transform_.length());
                    transform_.backward(column);
                  });
  for_each_row(field, 0, window_samples_,
               [&](std::complex<double>* row) { transform_.backward(row); });
  return field.topLeftCorner(window_samples_, window_samples_);
}

}  // namespace nlcwfs
