#pragma once

#include "model/array.hpp"

#include <algorithm>
#include <complex>
#include <memory>

namespace nlcwfs {

/// In-place complex Fourier transform of one contiguous line, unnormalised, through FFTW.
///
/// Planned with FFTW_ESTIMATE, whose choice depends on the length alone: two processes, ranks or
/// resumed runs compute the same bits. Two-dimensional transforms are made of lines (see
/// for_each_row and for_each_column), which costs little over FFTW's measured 2-D plans because
/// columns are gathered in cache-sized blocks.
///
/// Planning takes a lock; the transforms are const and may run from many threads. Lines must be
/// aligned to 16 bytes, which rows and columns of an even number of samples are.
template <class Real>
class LineTransform {
 public:
  /// @param length  samples per line, at least 1
  explicit LineTransform(int length);

  int length() const { return length_; }

  /// sum_x line[x] exp(-2 pi i f x / length)
  void forward(std::complex<Real>* line) const;
  /// sum_f line[f] exp(+2 pi i f x / length), not divided by the length
  void backward(std::complex<Real>* line) const;

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

/// Applies `operation(line)` to the contiguous rows first <= row < last.
template <class Real, class Operation>
void for_each_row(Field<Real>& field, Eigen::Index first, Eigen::Index last,
                  const Operation& operation) {
  for (Eigen::Index row = first; row < last; ++row) operation(field.row(row).data());
}

/// Applies `operation(line, column)` to the first `columns` columns, each gathered into a
/// contiguous buffer; they go in blocks so that each cache line of the field is read and written
/// once.
template <class Real, class Operation>
void for_each_column(Field<Real>& field, Eigen::Index columns, const Operation& operation) {
  constexpr Eigen::Index block = 16;
  Eigen::Array<std::complex<Real>, Eigen::Dynamic, block> lines(field.rows(), block);
  for (Eigen::Index first = 0; first < columns; first += block) {
    const Eigen::Index width = std::min(block, columns - first);
    lines.leftCols(width) = field.middleCols(first, width);
    for (Eigen::Index column = 0; column < width; ++column) {
      operation(lines.col(column).data(), first + column);
    }
    field.middleCols(first, width) = lines.leftCols(width);
  }
}

/// The smallest even number of samples >= `minimum` with no prime factor above 7, where FFTW is
/// fast.
int fast_transform_length(int minimum);

}  // namespace nlcwfs
