#include "model/line_kernels.hpp"

// One build serves every x86-64 processor and still uses the wide registers of the newer ones.
// Sanitizers run before the loader has resolved such functions, so they do without.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NLCWFS_MULTIVERSION __attribute__((target_clones("arch=haswell", "default")))
#else
#define NLCWFS_MULTIVERSION
#endif

namespace nlcwfs {
namespace {

/// Written in real arithmetic: std::complex's product also handles infinities, which keeps
/// compilers from vectorizing it.
template <class Real>
inline __attribute__((always_inline)) void multiply(std::complex<Real>* line,
                                                    const std::complex<Real>* factors,
                                                    std::complex<Real> factor, int length) {
  auto* values = reinterpret_cast<Real*>(line);
  const auto* multipliers = reinterpret_cast<const Real*>(factors);
  const Real factor_re = factor.real();
  const Real factor_im = factor.imag();
  for (int i = 0; i < 2 * length; i += 2) {
    const Real re = multipliers[i] * factor_re - multipliers[i + 1] * factor_im;
    const Real im = multipliers[i] * factor_im + multipliers[i + 1] * factor_re;
    const Real value_re = values[i];
    const Real value_im = values[i + 1];
    values[i] = value_re * re - value_im * im;
    values[i + 1] = value_re * im + value_im * re;
  }
}

}  // namespace

NLCWFS_MULTIVERSION void multiply_line(std::complex<double>* line,
                                       const std::complex<double>* factors,
                                       std::complex<double> factor, int length) {
  multiply(line, factors, factor, length);
}

NLCWFS_MULTIVERSION void multiply_line(std::complex<float>* line,
                                       const std::complex<float>* factors,
                                       std::complex<float> factor, int length) {
  multiply(line, factors, factor, length);
}

}  // namespace nlcwfs
