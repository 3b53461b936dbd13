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

/// A wavefront's phase in rad, n x n samples across the pupil diameter.
using PhaseScreen = Image<double>;

}  // namespace nlcwfs
