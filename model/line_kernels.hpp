#pragma once

#include <complex>

namespace nlcwfs {

// The arithmetic of the innermost loops, between the Fourier transforms. Compiled for several
// instruction sets, of which the running processor's best is chosen when the program is loaded.

/// out[i] = in[i] * factors[i] * factor for i < length; out may be in.
void multiply_line(const std::complex<double>* in, const std::complex<double>* factors,
                   std::complex<double> factor, std::complex<double>* out, int length);
void multiply_line(const std::complex<float>* in, const std::complex<float>* factors,
                   std::complex<float> factor, std::complex<float>* out, int length);

/// The amplitude step for one row of detector pixels, each of samples x samples field samples.
/// With A a pixel's measured amplitude and a the field's there (the root of its mean intensity),
/// the field is scaled by (A + relaxation (A - a)) / a. A dark pixel has no phase to keep and
/// becomes 0: one where a is below 64 rounding errors of a field of order 1, such as transforms
/// leave in the dark surround of the pupil.
/// @param field      the first of `samples` rows of pixels * samples values
/// @param stride     values from one row to the next
/// @param gain       factor to apply to the field first, such as a transform's norm
/// @param amplitude  A of each pixel
/// @param scratch    room for `pixels` values
void replace_amplitudes(std::complex<double>* field, std::ptrdiff_t stride, int samples,
                        double gain, const double* amplitude, double relaxation, double* scratch,
                        int pixels);
void replace_amplitudes(std::complex<float>* field, std::ptrdiff_t stride, int samples, float gain,
                        const float* amplitude, float relaxation, float* scratch, int pixels);

}  // namespace nlcwfs
