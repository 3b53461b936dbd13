#include "model/fresnel_propagator.hpp"

#include "model/line_kernels.hpp"

#include <cassert>
#include <numbers>

namespace nlcwfs {

Eigen::ArrayXcd fresnel_transfer_function(int samples, double pitch, double wavelength,
                                          double distance) {
  Eigen::ArrayXcd transfer(samples);
  const double frequency_step = 1.0 / (samples * pitch);
  for (int index = 0; index < samples; ++index) {
    const double frequency = frequency_step * (index < (samples + 1) / 2 ? index : index - samples);
    transfer[index] =
        std::polar(1.0, -std::numbers::pi * wavelength * distance * frequency * frequency);
  }
  return transfer;
}

template <class Real>
FresnelPropagator<Real>::FresnelPropagator(int samples, double pitch, double wavelength)
    : transform_(samples), pitch_(pitch), wavelength_(wavelength) {}

template <class Real>
void FresnelPropagator<Real>::propagate(Field<Real>& field, double distance) const {
  const RowRange all{0, samples()};
  propagate(field, distance, all, all);
}

template <class Real>
void FresnelPropagator<Real>::propagate(Field<Real>& field, double distance, RowRange lit,
                                        RowRange wanted) const {
  assert(field.rows() == samples() && field.cols() >= samples());
  if (distance == 0.0) return;

  // The transforms are not normalised; each axis' function makes up for its own length.
  const Eigen::ArrayX<std::complex<Real>> transfer =
      (fresnel_transfer_function(samples(), pitch_, wavelength_, distance) / double(samples()))
          .template cast<std::complex<Real>>();

  for_each_row(field, lit.first, lit.last,
               [&](std::complex<Real>* row) { transform_.forward(row); });
  for_each_column(field, samples(), [&](std::complex<Real>* column, Eigen::Index index) {
    transform_.forward(column);
    multiply_line(column, transfer.data(), transfer[index], samples());
    transform_.backward(column);
  });
  for_each_row(field, wanted.first, wanted.last,
               [&](std::complex<Real>* row) { transform_.backward(row); });
}

template class FresnelPropagator<float>;
template class FresnelPropagator<double>;

}  // namespace nlcwfs
