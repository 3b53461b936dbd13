// A phase is brought to another number of samples.
#pragma once

#include "model/array.hpp"

namespace nlcwfs {

/// A square phase brought to another number of samples across the same diameter: averaged over the
/// area of each new sample where that is coarser, interpolated linearly (the outermost half sample
/// extrapolated) where it is finer.
PhaseScreen resampled_screen(const PhaseScreen& screen, int samples);

}  // namespace nlcwfs
