// The arithmetic of the loop on lines of samples, written to be vectorized.
#pragma once

#include <complex>
#include <cstddef>

#include <Eigen/Core>

namespace nlcwfs {

// The arithmetic of the innermost loops, between the Fourier transforms.

/// Complex factors of the values of a line, laid out for multiply_line.
template <class Real>
class LineFactors {
 public:
  LineFactors() = default;  ///< none
  /// One factor for each value of a line.
  explicit LineFactors(const Eigen::ArrayXcd& factors);

  /// How many values a line has.
  int length() const { return static_cast<int>(real_.size()) / 2; }
  /// The factor of sample i.
  std::complex<Real> operator[](Eigen::Index i) const {
    return {real_[2 * i], imaginary_[2 * i + 1]};
  }

  /// Each factor's real part twice: re re ...
  const Real* real() const { return real_.data(); }
  /// Each factor's imaginary part twice, once negated: -im im ...
  const Real* imaginary() const { return imaginary_.data(); }

 private:
  Eigen::ArrayX<Real> real_;
  Eigen::ArrayX<Real> imaginary_;
};

/// out[i] = in[i] * factors[i] * factor for i < factors.length(); out may be in.
template <class Real>
void multiply_line(const std::complex<Real>* in, const LineFactors<Real>& factors,
                   std::complex<Real> factor, std::complex<Real>* out);

/// out[column * out_stride + row] = in[row * in_stride + column]; strides in values. `in` and `out`
/// do not overlap and are aligned to the size of a value.
template <class Real>
void transpose(const std::complex<Real>* in, std::ptrdiff_t in_stride, std::complex<Real>* out,
               std::ptrdiff_t out_stride, std::ptrdiff_t rows, std::ptrdiff_t columns);

/// The amplitude step for one row of detector pixels, each of samples x samples field samples.
/// With A the root of a pixel's measured intensity and a the field's amplitude there (the root of
/// its mean intensity), the field is scaled by (A + relaxation (A - a)) / a. A dark pixel has no
/// phase to keep and becomes 0: one where a is below 64 rounding errors of a field of order 1, such
/// as transforms leave in the dark surround of the pupil.
/// @param field     the first of `samples` rows of pixels * samples values
/// @param stride    values from one row to the next
/// @param gain      factor to apply to the field first, such as a transform's norm
/// @param measured  each pixel's intensity; below 0 counts as 0
/// @param scratch   room for `pixels` values
template <class Real>
void replace_amplitudes(std::complex<Real>* field, std::ptrdiff_t stride, int samples, Real gain,
                        const Real* measured, Real relaxation, Real* scratch, int pixels);

}  // namespace nlcwfs
