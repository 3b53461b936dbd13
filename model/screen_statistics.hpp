// Variances and structure functions of phase screens.
#pragma once

#include "model/array.hpp"
#include "model/pupil.hpp"
#include "model/statistics.hpp"

#include <span>

namespace nlcwfs {

/// The phase variance in rad^2 over the pupil about each screen's own mean: its mean and standard
/// error over independent screens. To compare with noll_piston_removed_variance.
/// @pre at least one screen, all of the mask's shape
MeanAndError piston_removed_variance(std::span<const PhaseScreen> screens, const PupilMask& pupil);

/// The same about each screen's least-squares plane. To compare with noll_tilt_removed_variance.
/// @pre at least one screen, all of the mask's shape; three pupil samples not in a line
MeanAndError tilt_removed_variance(std::span<const PhaseScreen> screens, const PupilMask& pupil);

/// From one sample to another; columns may be negative.
struct SampleOffset {
  int rows;     ///< from a sample to the other, along axis y
  int columns;  ///< along axis x
};

/// Structure function in rad^2: the squared phase difference of two samples `offset` apart,
/// averaged over all pairs in the square; its mean and standard error over independent screens.
/// @pre at least one screen, all of one shape; 0 <= rows < n, |columns| < n
MeanAndError structure_function(std::span<const PhaseScreen> screens, SampleOffset offset);

}  // namespace nlcwfs
