// The arithmetic of the loop on lines of samples, written to be vectorized.
#include "model/line_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlcwfs {
namespace {

/// A vector register that every processor has: two complex numbers in single precision, one in
/// double. Wider ones, which newer processors have, are no faster here.
template <class Real>
struct Register;
template <>
struct Register<float> {
  using Aligned [[gnu::vector_size(16), gnu::may_alias]] = float;
  using Anywhere [[gnu::vector_size(16), gnu::may_alias, gnu::aligned(sizeof(float))]] = float;
};
template <>
struct Register<double> {
  using Aligned [[gnu::vector_size(16), gnu::may_alias]] = double;
  using Anywhere [[gnu::vector_size(16), gnu::may_alias, gnu::aligned(sizeof(double))]] = double;
};
template <class Real>
using Lanes = typename Register<Real>::Aligned;

template <class Real>
Lanes<Real> load(const Real* values) {
  return *reinterpret_cast<const typename Register<Real>::Anywhere*>(values);
}
template <class Real>
void store(Lanes<Real> lanes, Real* values) {
  *reinterpret_cast<typename Register<Real>::Anywhere*>(values) = lanes;
}

Lanes<float> swap_parts(Lanes<float> z) { return Lanes<float>{z[1], z[0], z[3], z[2]}; }
Lanes<double> swap_parts(Lanes<double> z) { return Lanes<double>{z[1], z[0]}; }

/// The real and the imaginary parts of complex numbers a, b.
Lanes<float> real_parts(Lanes<float> a, Lanes<float> b) {
  return Lanes<float>{a[0], a[2], b[0], b[2]};
}
Lanes<double> real_parts(Lanes<double> a, Lanes<double> b) { return Lanes<double>{a[0], b[0]}; }
Lanes<float> imaginary_parts(Lanes<float> a, Lanes<float> b) {
  return Lanes<float>{a[1], a[3], b[1], b[3]};
}
Lanes<double> imaginary_parts(Lanes<double> a, Lanes<double> b) {
  return Lanes<double>{a[1], b[1]};
}
/// The factors of the complex numbers a and of the complex numbers b, each twice.
Lanes<float> twice_first(Lanes<float> x) { return Lanes<float>{x[0], x[0], x[1], x[1]}; }
Lanes<double> twice_first(Lanes<double> x) { return Lanes<double>{x[0], x[0]}; }
Lanes<float> twice_last(Lanes<float> x) { return Lanes<float>{x[2], x[2], x[3], x[3]}; }
Lanes<double> twice_last(Lanes<double> x) { return Lanes<double>{x[1], x[1]}; }

/// A product of complex numbers: std::complex's also handles infinities, which keeps compilers from
/// vectorizing it.
/// @param real       re re ... of the other factors
/// @param imaginary  -im im ... of the other factors
template <class Real>
Lanes<Real> product(Lanes<Real> z, Lanes<Real> real, Lanes<Real> imaginary) {
  return z * real + swap_parts(z) * imaginary;
}

/// A complex number that moves as a whole.
template <class Real>
struct Whole;
template <>
struct Whole<float> {
  using Value [[gnu::may_alias]] = double;
};
template <>
struct Whole<double> {
  using Value = Lanes<double>;
};

/// The amplitude step's factor for a field whose pixel has a given mean intensity.
template <class Real>
struct AmplitudeStep {
  AmplitudeStep(Real field_gain, Real relaxation)
      : wanted(Real(1) + relaxation), estimated(relaxation * field_gain) {
    const Real amplitude = Real(64) * std::numeric_limits<Real>::epsilon() / field_gain;
    dark = amplitude * amplitude;
  }

  Real operator()(Real intensity, Real measured) const {
    const Real lit = wanted * std::sqrt(std::max(measured, Real(0)) / intensity) - estimated;
    return intensity > dark ? lit : Real(0);
  }
  Lanes<Real> operator()(Lanes<Real> intensity, Lanes<Real> measured) const {
    const Lanes<Real> none{};
    Lanes<Real> ratio = (measured > none ? measured : none) / intensity;
    for (std::size_t i = 0; i < sizeof(ratio) / sizeof(Real); ++i) ratio[i] = std::sqrt(ratio[i]);
    const Lanes<Real> lit = wanted * ratio - estimated;
    return intensity > dark ? lit : none;
  }

  Real wanted;
  Real estimated;
  /// Of an intensity, before the gain. Else rounding errors would choose the phase of all the light
  /// that is measured there.
  Real dark;
};

/// Each sample is a pixel.
template <class Real>
void replace_samples(Real* values, const AmplitudeStep<Real>& step, const Real* measured,
                     int pixels) {
  using Vector = Lanes<Real>;
  constexpr std::ptrdiff_t count = sizeof(Vector) / sizeof(Real);
  std::ptrdiff_t pixel = 0;
  for (; pixel + count <= pixels; pixel += count) {
    const Vector a = load(values + 2 * pixel);
    const Vector b = load(values + 2 * pixel + count);
    const Vector re = real_parts(a, b);
    const Vector im = imaginary_parts(a, b);
    const Vector factor = step(re * re + im * im, load(measured + pixel));
    store<Real>(a * twice_first(factor), values + 2 * pixel);
    store<Real>(b * twice_last(factor), values + 2 * pixel + count);
  }
  for (; pixel < pixels; ++pixel) {
    Real& re = values[2 * pixel];
    Real& im = values[2 * pixel + 1];
    const Real factor = step(re * re + im * im, measured[pixel]);
    re *= factor;
    im *= factor;
  }
}

/// Each pixel is samples x samples samples.
template <class Real>
void replace_pixels(std::complex<Real>* field, std::ptrdiff_t stride, int samples,
                    const AmplitudeStep<Real>& step, const Real* measured, Real* scale,
                    int pixels) {
  for (int pixel = 0; pixel < pixels; ++pixel) scale[pixel] = Real(0);
  for (int row = 0; row < samples; ++row) {
    const auto* values = reinterpret_cast<const Real*>(field + row * stride);
    for (int pixel = 0; pixel < pixels; ++pixel) {
      Real intensity = 0;
      for (int i = 2 * samples * pixel; i < 2 * samples * (pixel + 1); ++i) {
        intensity += values[i] * values[i];
      }
      scale[pixel] += intensity;
    }
  }
  const Real per_sample = Real(1) / static_cast<Real>(samples * samples);
  for (int pixel = 0; pixel < pixels; ++pixel) {
    scale[pixel] = step(scale[pixel] * per_sample, measured[pixel]);
  }
  for (int row = 0; row < samples; ++row) {
    auto* values = reinterpret_cast<Real*>(field + row * stride);
    for (int pixel = 0; pixel < pixels; ++pixel) {
      for (int i = 2 * samples * pixel; i < 2 * samples * (pixel + 1); ++i) {
        values[i] *= scale[pixel];
      }
    }
  }
}

}  // namespace

template <class Real>
LineFactors<Real>::LineFactors(const Eigen::ArrayXcd& factors)
    : real_(2 * factors.size()), imaginary_(2 * factors.size()) {
  for (Eigen::Index i = 0; i < factors.size(); ++i) {
    real_[2 * i] = real_[2 * i + 1] = static_cast<Real>(factors[i].real());
    imaginary_[2 * i + 1] = static_cast<Real>(factors[i].imag());
    imaginary_[2 * i] = -imaginary_[2 * i + 1];
  }
}

template class LineFactors<float>;
template class LineFactors<double>;

template <class Real>
void multiply_line(const std::complex<Real>* in, const LineFactors<Real>& factors,
                   std::complex<Real> factor, std::complex<Real>* out) {
  using Vector = Lanes<Real>;
  constexpr int reals = sizeof(Vector) / sizeof(Real);
  Vector factor_real;
  Vector factor_imaginary;
  for (int i = 0; i < reals; ++i) {
    factor_real[i] = factor.real();
    factor_imaginary[i] = i % 2 == 0 ? -factor.imag() : factor.imag();
  }
  const auto* values = reinterpret_cast<const Real*>(in);
  auto* products = reinterpret_cast<Real*>(out);
  const int length = 2 * factors.length();
  int i = 0;
  for (; i + reals <= length; i += reals) {
    const Vector scaled = product<Real>(load(values + i), factor_real, factor_imaginary);
    store<Real>(product<Real>(scaled, load(factors.real() + i), load(factors.imaginary() + i)),
                products + i);
  }
  for (; i < length; i += 2) {  // the last of an odd number in single precision
    const Real re = values[i] * factor.real() - values[i + 1] * factor.imag();
    const Real im = values[i + 1] * factor.real() + values[i] * factor.imag();
    products[i] = re * factors.real()[i] + im * factors.imaginary()[i];
    products[i + 1] = im * factors.real()[i + 1] + re * factors.imaginary()[i + 1];
  }
}

// By square tiles: their rows and columns are short runs of neighbouring values, which move through
// vector registers.
template <class Real>
void transpose(const std::complex<Real>* in, std::ptrdiff_t in_stride, std::complex<Real>* out,
               std::ptrdiff_t out_stride, std::ptrdiff_t rows, std::ptrdiff_t columns) {
  constexpr std::ptrdiff_t side = 4;
  using Value = typename Whole<Real>::Value;
  const std::ptrdiff_t whole_rows = rows - rows % side;
  const std::ptrdiff_t whole_columns = columns - columns % side;
  for (std::ptrdiff_t row = 0; row < whole_rows; row += side) {
    for (std::ptrdiff_t column = 0; column < whole_columns; column += side) {
      const auto* from = reinterpret_cast<const Value*>(in + row * in_stride + column);
      auto* to = reinterpret_cast<Value*>(out + column * out_stride + row);
      // NOLINTNEXTLINE(modernize-avoid-c-arrays): std::array would lose the type's attributes
      Value tile[side][side];
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) tile[j][i] = from[i * in_stride + j];
      }
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) to[i * out_stride + j] = tile[i][j];
      }
    }
    for (std::ptrdiff_t column = whole_columns; column < columns; ++column) {
      for (int i = 0; i < side; ++i) {
        out[column * out_stride + row + i] = in[(row + i) * in_stride + column];
      }
    }
  }
  for (std::ptrdiff_t row = whole_rows; row < rows; ++row) {
    for (std::ptrdiff_t column = 0; column < columns; ++column) {
      out[column * out_stride + row] = in[row * in_stride + column];
    }
  }
}

template <class Real>
void replace_amplitudes(std::complex<Real>* field, std::ptrdiff_t stride, int samples, Real gain,
                        const Real* measured, Real relaxation, Real* scratch, int pixels) {
  const AmplitudeStep<Real> step(gain, relaxation);
  if (samples == 1) {
    replace_samples(reinterpret_cast<Real*>(field), step, measured, pixels);
  } else {
    replace_pixels(field, stride, samples, step, measured, scratch, pixels);
  }
}

template void multiply_line(const std::complex<float>*, const LineFactors<float>&,
                            std::complex<float>, std::complex<float>*);
template void multiply_line(const std::complex<double>*, const LineFactors<double>&,
                            std::complex<double>, std::complex<double>*);

template void transpose(const std::complex<float>*, std::ptrdiff_t, std::complex<float>*,
                        std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t);
template void transpose(const std::complex<double>*, std::ptrdiff_t, std::complex<double>*,
                        std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t);

template void replace_amplitudes(std::complex<float>*, std::ptrdiff_t, int, float, const float*,
                                 float, float*, int);
template void replace_amplitudes(std::complex<double>*, std::ptrdiff_t, int, double, const double*,
                                 double, double*, int);

}  // namespace nlcwfs
