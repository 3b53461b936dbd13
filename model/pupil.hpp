#pragma once

#include "model/array.hpp"

namespace nlcwfs {

/// Which samples of a square grid across the pupil diameter lie in the pupil.
using PupilMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace nlcwfs
