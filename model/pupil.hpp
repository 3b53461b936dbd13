// Which samples lie in the pupil, and the light that enters there.
#pragma once

#include "model/array.hpp"

namespace nlcwfs {

/// Which samples of a square grid across the pupil diameter lie in the pupil.
using PupilMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The pupil sampled at the sample centres (i - (n - 1)/2) D/n: true where
/// (eps D/2)^2 <= x^2 + y^2 <= (D/2)^2.
/// @param samples              n, across the diameter D
/// @param central_obscuration  eps, obscured diameter over D
PupilMask pupil_mask(int samples, double central_obscuration);

/// The field of a unit-amplitude beam with the given phase (rad) in the pupil, 0 outside.
Field<double> pupil_field(const PhaseScreen& phase, const PupilMask& mask);

/// `image` averaged over square blocks of factor x factor samples.
/// @pre both sides are multiples of factor
Image<double> block_average(const Image<double>& image, Eigen::Index factor);

}  // namespace nlcwfs
