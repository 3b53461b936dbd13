// A field is propagated on the reconstruction's periodic grid.
#pragma once

#include "model/array.hpp"
#include "model/fourier_transform.hpp"

namespace nlcwfs {

/// The Fresnel transfer function along one axis, exp(-i pi lambda z f^2), at the frequencies of a
/// discrete Fourier transform (f = 0, 1, ... , -1 in units of 1 / (samples * pitch)). In two
/// dimensions it is the product of both axes'; the factor exp(ikz) is left out.
/// Source: Goodman, Introduction to Fourier Optics, eq. 4-21.
/// @param samples     grid samples along the axis
/// @param pitch       sample spacing, m
/// @param wavelength  lambda, m
/// @param distance    z, m; negative goes backwards
Eigen::ArrayXcd fresnel_transfer_function(int samples, double pitch, double wavelength,
                                          double distance);

/// Fresnel propagation on a periodic grid: what leaves on one side comes back on the other. This is
/// the reconstructor's propagation; see WrapFreePropagator for the light itself.
///
/// Separable: the rows are transformed, then each column is transformed, filtered and transformed
/// back while it is in cache, then the rows are transformed back.
template <class Real>
class FresnelPropagator {
 public:
  /// @param samples     samples along each side of the square grid
  /// @param pitch       sample spacing, m
  /// @param wavelength  m
  FresnelPropagator(int samples, double pitch, double wavelength);

  /// How many samples the grid has along a side.
  int samples() const { return transform_.length(); }

  /// The transform of the grid's rows.
  const LineTransform<Real>& row_transform() const { return transform_; }

  /// The grid's middle rows, where a square of that many samples a side stands.
  RowRange middle_rows(Eigen::Index samples) const;

  /// Writes the transforms of the middle rows of a field that is dark but for `square`, in its
  /// middle; leaves the other rows as they are.
  /// @param square  at most samples() a side, and of the same parity
  void transform_middle_rows(const Field<double>& square, Field<Real>& field) const;

  /// Propagates `field` (samples x samples, or padded_lines) by `distance` (m, signed) in place.
  /// A distance of 0 is exactly the identity.
  void propagate(Field<Real>& field, double distance) const;

  /// What propagate_transformed_rows needs of a distance (m, signed) along an axis where the field
  /// is also moved by `shift` (m) towards larger coordinates, as by the shift theorem: exact on the
  /// periodic grid, for fractions of a sample too.
  LineFactors<Real> transfer(double distance, double shift = 0.0) const;

  /// The same as propagate on a field whose rows are Fourier transforms, before and after
  /// (row_transform().forward): for callers that have work to do on the rows while they are in
  /// cache.
  /// @param transfer_x, transfer_y  along rows and along columns; the same without a shift
  /// @param lit     the rows that hold light; the others count as dark, whatever they hold
  /// @param wanted  the rows to make; the others keep what they hold
  void propagate_transformed_rows(Field<Real>& field, const LineFactors<Real>& transfer_x,
                                  const LineFactors<Real>& transfer_y, RowRange lit,
                                  RowRange wanted) const;

 private:
  LineTransform<Real> transform_;
  double pitch_;
  double wavelength_;
};

}  // namespace nlcwfs
