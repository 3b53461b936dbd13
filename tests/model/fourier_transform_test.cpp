// Tests: Fourier transforms of lines and squares, through FFTW.
#include "model/fourier_transform.hpp"

#include "model/random_stream.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/random/normal_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

template <class Real>
using Line = Eigen::ArrayX<std::complex<Real>>;

template <class Real>
Line<Real> random_line(int length) {
  RandomStream stream = random_stream({std::uint64_t(length)});
  boost::random::normal_distribution<Real> normal;
  return Line<Real>::NullaryExpr(
      length, [&] { return std::complex<Real>(normal(stream), normal(stream)); });
}

template <class Real>
class LineTransformPrecision : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(LineTransformPrecision, Precisions);

const std::vector<int> lengths{1, 2, 3, 4, 6, 10, 14, 17, 30, 64, 97, 96, 126, 200};

TYPED_TEST(LineTransformPrecision, IsTheDirectSum) {
  for (const int length : lengths) {
    const Line<TypeParam> in = random_line<TypeParam>(length);
    const LineTransform<TypeParam> transform(length);
    EXPECT_EQ(transform.length(), length);
    Line<TypeParam> forward(length);
    Line<TypeParam> backward(length);
    transform.forward(in.data(), forward.data());
    transform.backward(in.data(), backward.data());
    for (int f = 0; f < length; ++f) {
      std::complex<double> forward_sum = 0.0;
      std::complex<double> backward_sum = 0.0;
      for (int x = 0; x < length; ++x) {
        const double angle = 2.0 * std::numbers::pi * ((f * x) % length) / length;
        forward_sum += std::complex<double>(in[x]) * std::polar(1.0, -angle);
        backward_sum += std::complex<double>(in[x]) * std::polar(1.0, angle);
      }
      const double tolerance =
          4.0 * double(std::numeric_limits<TypeParam>::epsilon()) * double(length);
      EXPECT_LT(std::abs(std::complex<double>(forward[f]) - forward_sum), tolerance) << length;
      EXPECT_LT(std::abs(std::complex<double>(backward[f]) - backward_sum), tolerance) << length;
    }
  }
}

TYPED_TEST(LineTransformPrecision, ConservesEnergyAndInverts) {
  for (const int length : lengths) {
    const Line<TypeParam> in = random_line<TypeParam>(length);
    const Line<TypeParam> unchanged = in;
    const LineTransform<TypeParam> transform(length);
    Line<TypeParam> spectrum(length);
    Line<TypeParam> back(length);
    transform.forward(in.data(), spectrum.data());
    transform.backward(spectrum.data(), back.data());
    const TypeParam tolerance = 20 * std::numeric_limits<TypeParam>::epsilon();
    EXPECT_NEAR(spectrum.abs2().sum() / (TypeParam(length) * in.abs2().sum()), 1.0, tolerance);
    EXPECT_LT((back / TypeParam(length) - in).abs().maxCoeff(), tolerance);
    EXPECT_TRUE((in == unchanged).all());
  }
}

TYPED_TEST(LineTransformPrecision, CopiesShareThePlan) {
  const Line<TypeParam> in = random_line<TypeParam>(12);
  Line<TypeParam> first(12);
  Line<TypeParam> second(12);
  LineTransform<TypeParam> copy(1);
  {
    const LineTransform<TypeParam> transform(12);
    transform.forward(in.data(), first.data());
    copy = transform;
  }
  copy.forward(in.data(), second.data());
  EXPECT_TRUE((first == second).all());
}

TEST(FourierTransform, RowsAreReplacedWithinTheirRange) {
  Field<double> field = padded_lines<double>(6, 6);
  field.leftCols(6).setConstant(2.0);
  for_each_row(field, 6, 2, 5, [](const auto* in, auto* out) {
    for (int x = 0; x < 6; ++x) out[x] = in[5 - x] + double(x);
  });
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      EXPECT_EQ(field(row, column), row >= 2 && row < 5 ? 2.0 + column : 2.0);
    }
  }
  EXPECT_TRUE((field.rightCols(field.cols() - 6) == 0.0).all());
}

TEST(FourierTransform, EveryColumnIsReplacedOnceAlsoBeyondABlock) {
  for (const int columns : {1, 15, 16, 17, 40}) {
    Field<double> field(3, 41);
    for (int column = 0; column < 41; ++column) {
      for (int row = 0; row < 3; ++row) field(row, column) = {double(row), double(column)};
    }
    for_each_column(field, columns, [](const auto* in, auto* out, Eigen::Index column) {
      EXPECT_EQ(in[1], std::complex<double>(1.0, double(column)));
      for (int row = 0; row < 3; ++row) out[row] = in[2 - row] * 2.0;
    });
    for (int column = 0; column < 41; ++column) {
      for (int row = 0; row < 3; ++row) {
        EXPECT_EQ(field(row, column), column < columns
                                          ? std::complex<double>(4.0 - 2.0 * row, 2.0 * column)
                                          : std::complex<double>(row, column));
      }
    }
  }
}

TEST(FourierTransform, ColumnsReadDarkRowsAsZeroAndWriteTheWantedRowsOnly) {
  const Field<double> in = Field<double>::Constant(6, 19, 2.0);
  Field<double> out = Field<double>::Constant(6, 19, 7.0);
  for_each_column(in, {1, 3}, out, {2, 6}, 18, [](const auto* from, auto* to, Eigen::Index) {
    for (int row = 0; row < 6; ++row) to[row] = from[row] + double(row);
  });
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 19; ++column) {
      const double made = row + (row == 1 || row == 2 ? 2.0 : 0.0);
      EXPECT_EQ(out(row, column), row >= 2 && column < 18 ? made : 7.0) << row << ", " << column;
    }
  }
  EXPECT_TRUE((in == 2.0).all());
}

TEST(FourierTransform, FastLengthsAreTheNextEvenNumberWithSmallPrimeFactors) {
  const auto is_fast = [](int length) {
    if (length % 2 != 0) return false;
    for (const int prime : {2, 3, 5, 7}) {
      while (length % prime == 0) length /= prime;
    }
    return length == 1;
  };
  int fast = 2;
  for (int minimum = 1; minimum <= 3000; ++minimum) {
    while (fast < minimum || !is_fast(fast)) ++fast;
    ASSERT_EQ(fast_transform_length(minimum), fast) << minimum;
  }
}

}  // namespace
}  // namespace nlcwfs
