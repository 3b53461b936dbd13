// Single spatial frequencies are put before a sensor, beside what theory lets expect.
#pragma once

#include "model/array.hpp"
#include "model/light_source.hpp"
#include "model/telescope.hpp"

#include <cstdint>
#include <vector>

namespace nlcwfs {

/// A single spatial frequency in the pupil: the phase
/// A sin(2 pi f (x cos t + y sin t) / D + theta), with x and y from the pupil's centre.
struct PhaseSinusoid {
  double frequency;    ///< f, cycles per pupil diameter
  double amplitude;    ///< A, peak, rad
  double orientation;  ///< t, rad
  double phase;        ///< theta, rad
};

/// The phase at the centres of samples x samples across the diameter.
PhaseScreen sinusoid_screen(const PhaseSinusoid& sinusoid, int samples);

/// Sinusoids of one frequency (cycles per pupil diameter) and amplitude (peak, rad), of uniformly
/// drawn orientations and phases. Those of screen i depend on `seed` and i alone, so that screens
/// of several frequencies have them in common.
std::vector<PhaseScreen> sinusoid_screens(double frequency, double amplitude, int samples,
                                          int count, std::uint64_t seed);

/// How strongly the image in a plane at distance z shows a weak sinusoid of the pupil's phase: the
/// amplitude of the intensity's modulation over its mean, per radian of the phase's amplitude.
struct SinusoidContrast {
  /// Of an endless pupil, signed: 2 sin(pi lambda z f^2 / D^2) = 2 sin(2 pi z / Z_T(D / f)). Blind
  /// at every half of the period's Talbot distance Z_T.
  /// Source: Guyon 2010, PASP 122, 49; the Talbot distance is Letchev et al. 2022, eq. 1.
  double talbot;
  /// Of a clear round pupil: the contrast of an endless one that tells as much of the amplitude,
  /// sqrt(2 - 2 o cos(2 pi lambda z f^2 / D^2)).
  ///
  /// The sinusoid's light is in two beams, which arrive shifted by +-lambda z f / D. Where both
  /// meet, they interfere with the pupil's light as in an endless one. Where one is alone, its
  /// contrast is 1 at any distance: no distance blinds it. o is the share of a beam on which it
  /// meets the other, that of two discs 2 lambda z f / D apart; from f = D^2 / (2 lambda z), half
  /// of the Fresnel number, they have parted, and the plane sees all frequencies equally well. A
  /// beam that has left the pupil's light too interferes with what that diffracts, which tells as
  /// much: in photon noise a weak light is as good as a strong one. A detector's window that misses
  /// it is not considered, nor are pixels.
  double effective;
};

/// The contrasts in each plane, per radian at the telescope's wavelength. In light of several
/// wavelengths the modulations of all add up.
/// @param planes     signed distances, m
/// @param frequency  cycles per pupil diameter
std::vector<SinusoidContrast> sinusoid_contrasts(const Telescope& telescope,
                                                 const std::vector<double>& planes,
                                                 double frequency, const LightSource& source = {});

/// The root of the mean square over planes.
double rms_contrast(const std::vector<SinusoidContrast>& contrasts,
                    double SinusoidContrast::*contrast);

/// The least standard deviation that photon noise allows an unbiased estimate of a weak sinusoid's
/// amplitude (peak, rad), if its frequency, orientation and phase are known:
/// sqrt(2 / N) / c; infinite where c = 0.
///
/// From the Fisher information of Poisson images: each photon of an intensity 1 + c_i A sin tells
/// c_i^2 / 2 of A, so that N_i photons in plane i leave the variance 1 / (sum of N_i c_i^2 / 2);
/// with c_i = 2 s_i that is 1 / (2 sum of N_i s_i^2).
/// @param photons       N, in all planes together, of which each has the same share
/// @param rms_contrast  c, per rad
double photon_limited_amplitude_error(double photons, double rms_contrast);

}  // namespace nlcwfs
