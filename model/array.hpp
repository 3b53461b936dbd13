// Images and complex fields on square grids.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace nlcwfs {

/// A real image on a square grid; row = y, column = x, rows contiguous in memory.
template <class Real>
using Image = Eigen::Array<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A complex optical field on the same grid as an Image.
template <class Real>
using Field = Image<std::complex<Real>>;

/// The most memory that a set of images may take, bytes (16 GiB): bounds what input can ask for.
inline constexpr double max_image_memory = 16.0 * 1024.0 * 1024.0 * 1024.0;

/// A wavefront's phase in rad, n x n samples across the pupil diameter.
using PhaseScreen = Image<double>;

}  // namespace nlcwfs
