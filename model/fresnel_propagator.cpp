// A field is propagated on the reconstruction's periodic grid.
#include "model/fresnel_propagator.hpp"

#include "model/line_kernels.hpp"

#include <cassert>
#include <numbers>

namespace nlcwfs {

Eigen::ArrayXcd fresnel_transfer_function(int samples, double pitch, double wavelength,
                                          double distance) {
  Eigen::ArrayXcd transfer(samples);
  const double frequency_step = 1.0 / (samples * pitch);
  for (int index = 0; index <= samples / 2; ++index) {
    const double frequency = frequency_step * index;
    transfer[index] =
        std::polar(1.0, -std::numbers::pi * wavelength * distance * frequency * frequency);
    if (index > 0) transfer[samples - index] = transfer[index];  // at -frequency
  }
  return transfer;
}

template <class Real>
FresnelPropagator<Real>::FresnelPropagator(int samples, double pitch, double wavelength)
    : transform_(samples), pitch_(pitch), wavelength_(wavelength) {}

template <class Real>
RowRange FresnelPropagator<Real>::middle_rows(Eigen::Index samples) const {
  const Eigen::Index border = (transform_.length() - samples) / 2;
  return {border, border + samples};
}

template <class Real>
void FresnelPropagator<Real>::transform_middle_rows(const Field<double>& square,
                                                    Field<Real>& field) const {
  const RowRange rows = middle_rows(square.rows());
  using Line = Eigen::ArrayX<std::complex<Real>>;
  Line line = Line::Zero(samples());
  for (Eigen::Index row = 0; row < rows.size(); ++row) {
    line.segment(rows.first, rows.size()) = square.row(row).template cast<std::complex<Real>>();
    transform_.forward(line.data(), field.row(rows.first + row).data());
  }
}

template <class Real>
void FresnelPropagator<Real>::propagate(Field<Real>& field, double distance) const {
  if (distance == 0.0) return;
  using Sample = std::complex<Real>;
  for_each_row(field, samples(), 0, samples(),
               [&](const Sample* in, Sample* out) { transform_.forward(in, out); });
  const RowRange all{0, samples()};
  const LineFactors<Real> factors = transfer(distance);
  propagate_transformed_rows(field, factors, factors, all, all);
  for_each_row(field, samples(), 0, samples(),
               [&](const Sample* in, Sample* out) { transform_.backward(in, out); });
  field *= Real(1) / static_cast<Real>(samples());
}

template <class Real>
LineFactors<Real> FresnelPropagator<Real>::transfer(double distance, double shift) const {
  Eigen::ArrayXcd factors = fresnel_transfer_function(samples(), pitch_, wavelength_, distance);
  if (shift != 0.0) {
    const double phase_step = -2.0 * std::numbers::pi * shift / (samples() * pitch_);
    for (int index = 0; index < samples(); ++index) {
      const int frequency = index < samples() / 2 ? index : index - samples();
      factors[index] *= std::polar(1.0, phase_step * frequency);
    }
  }
  return LineFactors<Real>(factors);
}

template <class Real>
void FresnelPropagator<Real>::propagate_transformed_rows(Field<Real>& field,
                                                         const LineFactors<Real>& transfer_x,
                                                         const LineFactors<Real>& transfer_y,
                                                         RowRange lit, RowRange wanted) const {
  assert(field.rows() == samples() && field.cols() >= samples());
  assert(transfer_x.length() == samples() && transfer_y.length() == samples());
  using Sample = std::complex<Real>;
  const Real column_norm = Real(1) / static_cast<Real>(samples());
  Eigen::ArrayX<Sample> spectrum(samples());
  for_each_column(field, lit, field, wanted, samples(),
                  [&](const Sample* in, Sample* out, Eigen::Index column) {
                    transform_.forward(in, spectrum.data());
                    multiply_line(spectrum.data(), transfer_y, column_norm * transfer_x[column],
                                  spectrum.data());
                    transform_.backward(spectrum.data(), out);
                  });
}

template class FresnelPropagator<float>;
template class FresnelPropagator<double>;

}  // namespace nlcwfs
