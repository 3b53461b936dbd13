// A wrapped phase becomes a continuous one.
#pragma once

#include "model/array.hpp"
#include "model/pupil.hpp"

#include <vector>

namespace nlcwfs {

/// How a phase is unwrapped, see PhaseUnwrapper.
enum class UnwrappingMethod {
  quality_guided,  ///< joins the neighbours whose phase difference is the surest first
  least_squares    ///< weighted least squares over all neighbour differences, made congruent
};

/// Unwraps the phase of a complex field over a mask.
///
/// Both methods work on the edges between neighbours (left-right, up-down) that both lie in the
/// mask, and both trust an edge by its quality
///
///     q = (1 - |d|/pi) 12 / (10 + I_m/I_a + I_m/I_b),
///
/// d being the wrapped phase difference, I_a and I_b the two intensities and I_m the mask's mean.
/// If differences are normal with variance v, the log odds that the nearest multiple of 2 pi is the
/// right one are 2 pi (pi - |d|) / v (after Carballo & Fieguth 2000, IEEE TGRS 38, 2192); v is a
/// constant, the slopes of the wavefront, plus noise that goes with 1/I, so that edges near
/// intensity nulls, where branch points live, come last. The constant 10 (noise counts below about
/// a tenth of the mean intensity) did best over Kolmogorov phases with added white and correlated
/// noise; there q misplaced fewer samples than the second differences of Herraez et al. (2002), the
/// intensity, or their product.
///
/// - quality_guided: maximum spanning tree of q, grown by merging regions in the order of quality
///   (the non-continuous path of Herraez et al. 2002, Appl. Opt. 41, 7437). O(n^2 log n).
/// - least_squares: minimises sum over edges of w (psi_b - psi_a - d)^2 (Ghiglia & Romero 1994,
///   JOSA A 11, 107) with w = q^4 by a sparse factorisation, then takes the phase congruent with
///   the field nearest to psi + c, c being the amplitude-weighted phasor mean of phase - psi.
///
/// The answer is the same, up to rounding, for a field that is scaled, or flipped or transposed
/// with its mask, unless qualities tie or a difference is exactly pi.
class PhaseUnwrapper {
 public:
  /// @param mask  at least one sample; parts without a common edge are unwrapped each on its own
  PhaseUnwrapper(const PupilMask& mask, UnwrappingMethod method);

  /// The phase in rad, continuous over the mask where the field allows it, 0 outside. It is
  /// arg(field) plus multiples of 2 pi; a sample that is 0 counts as phase 0. The free multiple of
  /// 2 pi is chosen so that the mean over each connected part of the mask lies in (-pi, pi]. Const
  /// and without hidden state: may run from many threads.
  /// @param field  as large as the mask; only samples in the mask are read
  /// @pre those are finite, and their squares too
  Image<double> unwrap(const Field<double>& field) const;

 private:
  /// Two neighbours in the mask, as indices into samples_.
  struct Edge {
    int first;
    int second;
  };

  /// Numbers the samples in an order that keeps the normal matrix's factor sparse.
  void sort_samples_for_elimination();

  std::vector<int> quality_guided_cycles(const std::vector<int>& steps,
                                         const Eigen::ArrayXd& quality) const;
  std::vector<int> least_squares_cycles(const Eigen::ArrayXcd& field, const Eigen::ArrayXd& phase,
                                        const std::vector<int>& steps,
                                        const Eigen::ArrayXd& quality) const;

  Eigen::Index rows_;
  Eigen::Index columns_;
  UnwrappingMethod method_;
  std::vector<Eigen::Index> samples_;  ///< position in the grid, row by row
  std::vector<Edge> edges_;
  std::vector<int> parts_;  ///< for each sample, the number of its connected part
  int part_count_ = 0;
};

}  // namespace nlcwfs
