// Phase screens are drawn whose structure function is exact.
#pragma once

#include "model/array.hpp"
#include "model/fourier_transform.hpp"
#include "model/seeing.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace nlcwfs {

/// Draws turbulence phase screens whose structure function is exact at every separation within the
/// square, its diagonal included, for Kolmogorov and for every outer scale.
///
/// Stein's intrinsic embedding (2002, J. Comput. Graph. Stat. 11, 587), written for any isotropic
/// semivariogram gamma(r) = D(r) / 2 with lengths in units of the largest separation: the
/// covariance
///   K(r) = c0 - gamma(r) + c2 r^2   for r <= 1,
///          beta (R - r)^3 / r       for 1 <= r <= R,
///          0                        beyond,
/// with beta and c2 such that K has two continuous derivatives at 1 and c0 such that K itself is
/// continuous, is laid on a periodic grid of period >= 2 R. A Gaussian field Z of that covariance,
/// drawn in the Fourier domain, plus the random tilt sqrt(2 c2) x.W, W ~ N(0, I), has the structure
/// function 2 gamma(r) for r <= 1.
/// R = 2 as Stein has it for exponent 5/3; where a short outer scale would make c2 negative, R
/// shrinks until c2 = 0 (a stationary field without a tilt). The spectrum of K is then positive
/// from outer scales below a pixel to infinite ones; the constructor checks it.
///
/// A screen's piston carries no meaning. The methods are const and may run from many threads.
class TurbulenceScreenGenerator {
 public:
  /// @param seeing    its Fried parameter at the wavelength that the screens' radians belong to
  /// @param samples   n >= 2 samples across the diameter
  /// @param diameter  width of the square in m; the pitch is diameter / n
  /// @param seed      another seed draws an independent set of screens
  /// @throws InputError where the seeing is not physical
  TurbulenceScreenGenerator(const Seeing& seeing, int samples, double diameter, std::uint64_t seed);

  /// Screen `index` >= 0 of the set, n x n, rad; the same whichever others are drawn.
  PhaseScreen screen(int index) const;

  /// The screens 2 pair and 2 pair + 1, which share a transform: drawing both costs as much as one.
  std::array<PhaseScreen, 2> screen_pair(int pair) const;

 private:
  int samples_;
  std::uint64_t seed_;
  double tilt_per_sample_ = 0.0;  // RMS along each axis, rad
  LineTransform<double> transform_;
  // Square root of the torus covariance's spectrum over the period, frequencies 0 ... period / 2.
  Image<double> amplitude_;
};

/// The first `count` screens, drawn in parallel; the same for any number of threads.
/// @param watch  told how many more are drawn, by several threads at once, and asked whether others
///               may follow; if not, there are fewer screens, two at least where `count` is
std::vector<PhaseScreen> generate_screens(const TurbulenceScreenGenerator& generator, int count,
                                          const std::function<bool(int)>& watch = {});

}  // namespace nlcwfs
