#include "model/line_kernels.hpp"

#include <cmath>
#include <limits>

// One build serves every x86-64 processor and still uses the wide registers of the newer ones.
// Sanitizers run before the loader has resolved such functions, so they do without.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NLCWFS_MULTIVERSION __attribute__((target_clones("arch=haswell", "default")))
#else
#define NLCWFS_MULTIVERSION
#endif
// Into each version of its caller, so that it is compiled for that version's instructions.
#define NLCWFS_INLINE inline __attribute__((always_inline))

namespace nlcwfs {
namespace {

// Complex numbers as pairs of reals: std::complex's product also handles infinities, which keeps
// compilers from vectorizing it.

template <class Real>
NLCWFS_INLINE void multiply(const std::complex<Real>* in, const std::complex<Real>* factors,
                            std::complex<Real> factor, std::complex<Real>* out, int length) {
  const auto* values = reinterpret_cast<const Real*>(in);
  const auto* multipliers = reinterpret_cast<const Real*>(factors);
  auto* products = reinterpret_cast<Real*>(out);
  const Real factor_re = factor.real();
  const Real factor_im = factor.imag();
  for (int i = 0; i < 2 * length; i += 2) {
    const Real re = multipliers[i] * factor_re - multipliers[i + 1] * factor_im;
    const Real im = multipliers[i] * factor_im + multipliers[i + 1] * factor_re;
    const Real value_re = values[i];
    const Real value_im = values[i + 1];
    products[i] = value_re * re - value_im * im;
    products[i + 1] = value_re * im + value_im * re;
  }
}

/// Inlined with a constant `samples`, its inner loops vanish.
template <class Real>
NLCWFS_INLINE void replace(std::complex<Real>* field, std::ptrdiff_t stride, int samples, Real gain,
                           const Real* amplitude, Real relaxation, Real* scale, int pixels) {
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
  // Else rounding errors would choose the phase of all the light that is measured there.
  const Real dark = Real(64) * std::numeric_limits<Real>::epsilon();
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const Real estimated = gain * std::sqrt(scale[pixel] * per_sample);
    const Real wanted = amplitude[pixel] + relaxation * (amplitude[pixel] - estimated);
    scale[pixel] = estimated > dark ? gain * wanted / estimated : Real(0);
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

template <class Real>
NLCWFS_INLINE void replace_in_pixels(std::complex<Real>* field, std::ptrdiff_t stride, int samples,
                                     Real gain, const Real* amplitude, Real relaxation,
                                     Real* scratch, int pixels) {
  if (samples == 1) {
    replace(field, stride, 1, gain, amplitude, relaxation, scratch, pixels);
  } else {
    replace(field, stride, samples, gain, amplitude, relaxation, scratch, pixels);
  }
}

}  // namespace

NLCWFS_MULTIVERSION void multiply_line(const std::complex<double>* in,
                                       const std::complex<double>* factors,
                                       std::complex<double> factor, std::complex<double>* out,
                                       int length) {
  multiply(in, factors, factor, out, length);
}

NLCWFS_MULTIVERSION void multiply_line(const std::complex<float>* in,
                                       const std::complex<float>* factors,
                                       std::complex<float> factor, std::complex<float>* out,
                                       int length) {
  multiply(in, factors, factor, out, length);
}

NLCWFS_MULTIVERSION void replace_amplitudes(std::complex<double>* field, std::ptrdiff_t stride,
                                            int samples, double gain, const double* amplitude,
                                            double relaxation, double* scratch, int pixels) {
  replace_in_pixels(field, stride, samples, gain, amplitude, relaxation, scratch, pixels);
}

NLCWFS_MULTIVERSION void replace_amplitudes(std::complex<float>* field, std::ptrdiff_t stride,
                                            int samples, float gain, const float* amplitude,
                                            float relaxation, float* scratch, int pixels) {
  replace_in_pixels(field, stride, samples, gain, amplitude, relaxation, scratch, pixels);
}

}  // namespace nlcwfs
