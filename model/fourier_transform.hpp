#pragma once

#include "model/array.hpp"

#include <algorithm>
#include <complex>
#include <memory>

namespace nlcwfs {

/// Complex Fourier transform of one contiguous line, unnormalised, through FFTW.
///
/// Planned with FFTW_ESTIMATE, whose choice depends on the length alone: two processes, ranks or
/// resumed runs compute the same bits. Two-dimensional transforms are made of lines (see
/// for_each_row and for_each_column); out of place and with columns gathered in cache-sized blocks
/// they are as fast as FFTW's own 2-D plans that were chosen by measuring.
///
/// Planning takes a lock; the transforms are const and may run from many threads. Lines must not
/// overlap and must be aligned to 16 bytes, as rows and columns of an even number of samples are.
template <class Real>
class LineTransform {
 public:
  /// @param length  samples per line, at least 1
  explicit LineTransform(int length);

  int length() const { return length_; }

  /// out[f] = sum_x in[x] exp(-2 pi i f x / length)
  void forward(const std::complex<Real>* in, std::complex<Real>* out) const;
  /// out[x] = sum_f in[f] exp(+2 pi i f x / length), not divided by the length
  void backward(const std::complex<Real>* in, std::complex<Real>* out) const;

 private:
  struct Plans;
  int length_;
  std::shared_ptr<const Plans> plans_;
};

/// A samples x samples field of zeros in the left columns of rows that are one cache line longer:
/// without it, rows of a power of two map columns onto few cache sets, and the column transforms
/// take twice as long.
template <class Real>
Field<Real> padded_field(Eigen::Index samples) {
  constexpr Eigen::Index cache_line = 64 / sizeof(std::complex<Real>);
  return Field<Real>::Zero(samples, samples + cache_line);
}

/// Replaces the first `samples` samples of the rows first <= row < last: `operation(in, out)` makes
/// the new row from the old one.
template <class Real, class Operation>
void for_each_row(Field<Real>& field, Eigen::Index samples, Eigen::Index first, Eigen::Index last,
                  const Operation& operation) {
  Eigen::ArrayX<std::complex<Real>> result(samples);
  for (Eigen::Index row = first; row < last; ++row) {
    operation(field.row(row).data(), result.data());
    field.row(row).head(samples) = result.transpose();
  }
}

/// Replaces the first `columns` columns: `operation(in, out, column)` makes the new column from the
/// old one, both gathered in contiguous buffers. Columns go in blocks so that each cache line of
/// the field is read and written once.
template <class Real, class Operation>
void for_each_column(Field<Real>& field, Eigen::Index columns, const Operation& operation) {
  constexpr Eigen::Index block = 16;
  using Lines = Eigen::Array<std::complex<Real>, Eigen::Dynamic, block>;
  Lines lines(field.rows(), block);
  Lines results(field.rows(), block);
  for (Eigen::Index first = 0; first < columns; first += block) {
    const Eigen::Index width = std::min(block, columns - first);
    lines.leftCols(width) = field.middleCols(first, width);
    for (Eigen::Index column = 0; column < width; ++column) {
      operation(lines.col(column).data(), results.col(column).data(), first + column);
    }
    field.middleCols(first, width) = results.leftCols(width);
  }
}

/// The smallest even number of samples >= `minimum` with no prime factor above 7, where FFTW is
/// fast.
int fast_transform_length(int minimum);

}  // namespace nlcwfs
