#pragma once

#include <complex>

namespace nlcwfs {

/// line[i] *= factors[i] * factor for i < length. Compiled for several instruction sets, of which
/// the running processor's best is chosen when the program is loaded.
void multiply_line(std::complex<double>* line, const std::complex<double>* factors,
                   std::complex<double> factor, int length);
void multiply_line(std::complex<float>* line, const std::complex<float>* factors,
                   std::complex<float> factor, int length);

}  // namespace nlcwfs
