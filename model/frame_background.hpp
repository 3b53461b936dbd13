// What is left of the background in a calibrated frame.
#pragma once

#include "model/array.hpp"

#include <cmath>
#include <optional>

namespace nlcwfs {

/// A background that a frame still has, the same in every pixel.
struct FrameBackground {
  double level = 0.0;  ///< in the frame's unit
  double error = 0.0;  ///< its standard error: of noise and of the structure in the light

  /// Whether it is there, above or, where too much was subtracted, below 0. In simulated frames
  /// with the right background 0 to 3 of 100 sets of four planes have one of this size
  /// (D/r0 = 2 to 20, 1e4 to 1e6 photons, read noise of 0 to 3 electrons, windows of 1.5 to 4
  /// diameters).
  bool is_significant() const { return std::abs(level) > 4.0 * error; }
};

/// Finds it in the unlit border, by what falls off with the distance from the optical axis and what
/// does not: I(r) = level + c r^(-11/3), by weighted least squares over the pixels whose distance
/// is at least 0.9 of half the frame's width. The exponent is that of light scattered by Kolmogorov
/// turbulence far from the pupil's image, as the power of its phase at the spatial frequency
/// r / (lambda z) (Noll 1976); what the pupil's edge diffracts falls off nearly as fast, r^-3. No
/// reconstruction comes in, which could explain a background by light of its own making. The error
/// is the jackknife's over sectors around the axis.
///
/// @param frame         NaN = not measured
/// @param pupil_pixels  pixels across the pupil's geometric image, which is as large in every plane
/// @param axis          where the optical axis meets the frame: x, y from its middle, pixels
/// @return nothing where less than 64 pixels are that far out and farther than 1.5 radii of the
///         pupil, or too few sectors have any
std::optional<FrameBackground> frame_background(const Image<double>& frame, double pupil_pixels,
                                                const Eigen::Array2d& axis);

}  // namespace nlcwfs
