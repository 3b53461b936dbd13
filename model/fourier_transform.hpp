// Fourier transforms of lines and squares, through FFTW.
#pragma once

#include "model/array.hpp"
#include "model/line_kernels.hpp"

#include <algorithm>
#include <cassert>
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

  /// How many samples a line has.
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

/// Zeros: `lines` rows of `length` samples and one unused cache line. Without it, rows of a power
/// of two samples map columns onto few cache sets, and what goes by columns takes twice as long.
template <class Real>
Field<Real> padded_lines(Eigen::Index lines, Eigen::Index length) {
  constexpr Eigen::Index cache_line = 64 / sizeof(std::complex<Real>);
  return Field<Real>::Zero(lines, length + cache_line);
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

/// Rows first <= row < last.
struct RowRange {
  Eigen::Index first;  ///< included
  Eigen::Index last;   ///< excluded

  /// How many rows.
  Eigen::Index size() const { return last - first; }
};

/// For each of the first `columns` columns, `operation(from, to, column)` makes the new column `to`
/// from the old one `from`, both contiguous lines of in.rows() values. Only the rows `read` of `in`
/// are read, the others count as zero; only the rows `written` of `out`, which may be `in`, are
/// written.
///
/// Columns go in blocks, so that each cache line of a field is read and written once.
template <class Real, class Operation>
void for_each_column(const Field<Real>& in, RowRange read, Field<Real>& out, RowRange written,
                     Eigen::Index columns, const Operation& operation) {
  constexpr Eigen::Index block = 8;
  assert(in.rows() == out.rows());
  Field<Real> from = padded_lines<Real>(block, in.rows());
  Field<Real> to = padded_lines<Real>(block, in.rows());
  for (Eigen::Index first = 0; first < columns; first += block) {
    const Eigen::Index width = std::min(block, columns - first);
    transpose(&in(read.first, first), in.cols(), &from(0, read.first), from.cols(), read.size(),
              width);
    for (Eigen::Index line = 0; line < width; ++line) {
      operation(&from(line, 0), &to(line, 0), first + line);
    }
    transpose(&to(0, written.first), to.cols(), &out(written.first, first), out.cols(), width,
              written.size());
  }
}

/// The same for all rows, in place.
template <class Real, class Operation>
void for_each_column(Field<Real>& field, Eigen::Index columns, const Operation& operation) {
  const RowRange all{0, field.rows()};
  for_each_column(field, all, field, all, columns, operation);
}

/// The smallest even number of samples >= `minimum` with no prime factor above 7, where FFTW is
/// fast.
int fast_transform_length(int minimum);

}  // namespace nlcwfs
