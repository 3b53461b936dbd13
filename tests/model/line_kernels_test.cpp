// Tests: The arithmetic of the loop on lines of samples, written to be vectorized.
#include "model/line_kernels.hpp"

#include "model/array.hpp"
#include "model/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

template <class Real>
class LineKernels : public testing::Test {
 protected:
  using Line = Eigen::ArrayX<std::complex<Real>>;

  Line random_line(Eigen::Index length) {
    return Line::NullaryExpr(length, [&] { return std::complex<Real>(random(), random()); });
  }
  Real random() {
    return boost::random::uniform_real_distribution<Real>(Real(-1), Real(1))(stream_);
  }

  RandomStream stream_ = random_stream({3});
  const Real tolerance_ = 8 * std::numeric_limits<Real>::epsilon();
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(LineKernels, Precisions);

/// Lengths around the widths of vector registers.
const std::vector<int> lengths{0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 100, 101};

TYPED_TEST(LineKernels, MultiplyIsComplexArithmetic) {
  using Sample = std::complex<TypeParam>;
  for (const int length : lengths) {
    const auto in = this->random_line(length);
    const auto factors = this->random_line(length);
    const Sample factor(this->random(), this->random());
    const Eigen::ArrayX<Sample> expected = in * factors * factor;
    const LineFactors<TypeParam> laid_out(factors.template cast<std::complex<double>>());
    ASSERT_EQ(laid_out.length(), length);
    // One value more, which must stay.
    Eigen::ArrayX<Sample> out(length + 1);
    out[length] = TypeParam(9);
    multiply_line(in.data(), laid_out, factor, out.data());
    EXPECT_EQ(out[length], TypeParam(9));
    auto in_place = in;
    multiply_line(in_place.data(), laid_out, factor, in_place.data());
    for (int i = 0; i < length; ++i) {
      EXPECT_EQ(laid_out[i], factors[i]);
      EXPECT_LT(std::abs(out[i] - expected[i]), this->tolerance_) << i << " of " << length;
      EXPECT_EQ(in_place[i], out[i]);
    }
  }
}

TYPED_TEST(LineKernels, TransposeMovesEveryValueOfAnyShapeAndNoOther) {
  using Sample = std::complex<TypeParam>;
  for (const int rows : lengths) {
    for (const int columns : {0, 1, 3, 4, 5, 8, 16}) {
      const int in_stride = columns + 2;
      const int out_stride = rows + 3;
      const auto in = this->random_line(Eigen::Index(rows) * in_stride);
      Eigen::ArrayX<Sample> out(Eigen::Index(columns) * out_stride);
      out.setConstant(TypeParam(9));
      transpose(in.data(), in_stride, out.data(), out_stride, rows, columns);
      for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < out_stride; ++row) {
          EXPECT_EQ(out[column * out_stride + row],
                    row < rows ? in[row * in_stride + column] : Sample(TypeParam(9)));
        }
      }
    }
  }
}

/// The relaxed projection of a pixel's field, as its definition says.
template <class Real>
Field<Real> projected(const Field<Real>& field, Real measured, Real relaxation) {
  const Real estimated = std::sqrt(field.abs2().mean());
  const Real amplitude = std::sqrt(std::max(measured, Real(0)));
  const Real wanted = amplitude + relaxation * (amplitude - estimated);
  return estimated > Real(0) ? Field<Real>(field * (wanted / estimated)) : field;
}

TYPED_TEST(LineKernels, ReplaceAmplitudesIsTheRelaxedProjectionOfEachPixel) {
  using Real = TypeParam;
  for (const int samples : {1, 2, 3, 4}) {
    for (const int pixels : lengths) {
      for (const Real relaxation : {Real(0), Real(0.6), Real(-0.8)}) {
        const int width = pixels * samples;
        const int stride = width + 3;
        const Real gain = Real(0.25);
        Field<Real> field =
            this->random_line(samples * stride).reshaped(stride, samples).transpose();
        Eigen::ArrayX<Real> measured(pixels);
        for (Real& value : measured) value = this->random() + Real(1);
        // A dark pixel, and one that is measured as dark.
        if (pixels > 2) field.middleCols(samples, samples).setZero();
        if (pixels > 2) measured[2] = Real(-0.1);  // noise may

        const Field<Real> before = field;
        Eigen::ArrayX<Real> scratch(pixels);
        replace_amplitudes(field.data(), stride, samples, gain, measured.data(), relaxation,
                           scratch.data(), pixels);
        for (int pixel = 0; pixel < pixels; ++pixel) {
          const Field<Real> old = gain * before.middleCols(pixel * samples, samples);
          const Field<Real> expected = projected<Real>(old, measured[pixel], relaxation);
          const Field<Real> replaced = field.middleCols(pixel * samples, samples);
          EXPECT_LT((replaced - expected).abs().maxCoeff(), Real(4) * this->tolerance_);
        }
        EXPECT_TRUE((field.rightCols(3) == before.rightCols(3)).all());
      }
    }
  }
}

TYPED_TEST(LineKernels, RoundingErrorsAreDark) {
  using Real = TypeParam;
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  std::vector<std::complex<Real>> field{{20 * epsilon, -20 * epsilon}, {1000 * epsilon, 0}, {0, 0}};
  const std::vector<Real> measured{1, 1, 1};
  std::vector<Real> scratch(3);
  replace_amplitudes(field.data(), 3, 1, Real(1), measured.data(), Real(0), scratch.data(), 3);
  EXPECT_EQ(field[0], std::complex<Real>(0));
  EXPECT_NEAR(field[1].real(), 1.0, double(this->tolerance_));
  EXPECT_EQ(field[2], std::complex<Real>(0));
}

}  // namespace
}  // namespace nlcwfs
