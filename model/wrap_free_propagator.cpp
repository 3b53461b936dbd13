// Light is propagated to a window on an infinite plane, where nothing wraps round.
#include "model/wrap_free_propagator.hpp"

#include "model/fresnel_propagator.hpp"
#include "model/line_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

namespace nlcwfs {
namespace {

constexpr unsigned longest_period = 1U << 24U;
constexpr double least_period_margin = 4.0;

}  // namespace

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

double WrapFreePropagator::farthest_distance() const {
  const double farthest_reach = longest_period / least_period_margin;
  return (farthest_reach - transform_.length()) * 2.0 * pitch_ * pitch_ / wavelength_;
}

LineFactors<double> WrapFreePropagator::transfer_function(double distance) const {
  const int length = transform_.length();
  assert(std::abs(distance) <= farthest_distance());
  const double chirp = wavelength_ * distance / (2.0 * pitch_ * pitch_);
  const double reach = std::abs(chirp) + length;
  const auto period = static_cast<int>(std::min(
      longest_period, std::bit_ceil(static_cast<unsigned>(std::ceil(period_margin_ * reach)))));
  const Eigen::ArrayXcd spectrum =
      fresnel_transfer_function(period, pitch_, wavelength_, distance) / double(period);
  Eigen::ArrayXcd kernel(period);
  LineTransform<double>(period).backward(spectrum.data(), kernel.data());

  // The transform is the trapezoidal rule for the integral over frequency. These are the first two
  // terms by which it differs (Euler-Maclaurin, DLMF 2.10.1): the odd derivatives of the integrand
  // exp(i (-pi lambda z f^2 + 2 pi f x)) at the ends of the band, in units of the frequency step.
  const double step = 2.0 * std::numbers::pi / period;
  const double slope = step * chirp;  // of the chirp's phase at the band's end
  const double curvature = -step * slope / std::numbers::pi;
  const std::complex<double> end = spectrum[period / 2];
  const auto integral = [&](int offset) {
    const double tilt = step * offset;
    const std::complex<double> first(0.0, slope / 6.0);
    const std::complex<double> third(curvature * slope / 120.0,
                                     slope * (3.0 * tilt * tilt + slope * slope) / 360.0);
    const double sign = offset % 2 == 0 ? 1.0 : -1.0;
    return kernel[(offset + period) % period] + sign * end * (first + third);
  };

  // Window sample j stands (j - k - shift) pitches from pupil sample k.
  const int shift = (window_samples_ - pupil_samples_) / 2;
  Eigen::ArrayXcd wanted = Eigen::ArrayXcd::Zero(length);
  for (int offset = 1 - pupil_samples_; offset < window_samples_; ++offset) {
    wanted[(offset + length) % length] = integral(offset - shift);
  }
  Eigen::ArrayXcd transfer(length);
  transform_.forward(wanted.data(), transfer.data());
  return LineFactors<double>(transfer / double(length));
}

Field<double> WrapFreePropagator::working_field() const {
  return padded_lines<double>(transform_.length(), transform_.length());
}

void WrapFreePropagator::transform(const Field<double>& pupil, Field<double>& spectrum) const {
  const int length = transform_.length();
  assert(pupil.rows() == pupil_samples_ && pupil.cols() == pupil_samples_);
  assert(spectrum.rows() == length && spectrum.cols() >= length);
  Eigen::ArrayXcd line = Eigen::ArrayXcd::Zero(length);
  for (int row = 0; row < pupil_samples_; ++row) {
    line.head(pupil_samples_) = pupil.row(row);
    transform_.forward(line.data(), spectrum.row(row).data());
  }
  using Sample = std::complex<double>;
  for_each_column(
      spectrum, {0, pupil_samples_}, spectrum, {0, length}, length,
      [&](const Sample* in, Sample* out, Eigen::Index) { transform_.forward(in, out); });
}

void WrapFreePropagator::propagate(const Field<double>& spectrum,
                                   const LineFactors<double>& transfer,
                                   Field<double>& field) const {
  const int length = transform_.length();
  assert(spectrum.rows() == length && field.rows() == length && field.cols() >= length);
  assert(transfer.length() == length);
  using Sample = std::complex<double>;
  Eigen::ArrayXcd filtered(length);
  for_each_column(spectrum, {0, length}, field, {0, window_samples_}, length,
                  [&](const Sample* in, Sample* out, Eigen::Index column) {
                    multiply_line(in, transfer, transfer[column], filtered.data());
                    transform_.backward(filtered.data(), out);
                  });
  for_each_row(field, length, 0, window_samples_,
               [&](const Sample* in, Sample* out) { transform_.backward(in, out); });
}

}  // namespace nlcwfs
