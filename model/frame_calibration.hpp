// Measured frames become images: background, bad pixels, saturation, brightness.
#pragma once

#include "model/array.hpp"

namespace nlcwfs {

/// Which pixels of a detector are bad.
using PixelMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Brings the frame of a detector to what the reconstruction reads: light alone, on a square of an
/// even number of pixels, with NaN in pixels that were not measured. These are the bad ones, those
/// whose value is not finite, those at or above the saturation, and those that a frame of another
/// shape lacks, which are added behind its last rows and columns. Nothing is interpolated.
/// @param frame       as read, in any unit
/// @param background  what is there without light, as large as the frame and in its unit
/// @param bad         as large as the frame
/// @param saturation  the value from which on a pixel says nothing, before the background is
///                    subtracted; may be infinite
Image<double> calibrated_frame(const Image<double>& frame, const Image<double>& background,
                               const PixelMask& bad, double saturation);

/// Pixels along each side of a calibrated frame: the longer side of the frame, made even.
Eigen::Index calibrated_width(Eigen::Index rows, Eigen::Index columns);

}  // namespace nlcwfs
