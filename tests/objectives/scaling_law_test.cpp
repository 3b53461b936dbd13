// Tests: A law is fitted to the best designs at several seeings.
#include "objectives/scaling_law.hpp"

#include "model/random_stream.hpp"
#include "tests/message_of.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <boost/random/normal_distribution.hpp>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::array<int, 4> far_first{3, 4, 1, 2};

/// Intercept and slope of each line that the data below follow, in the order of the quantities.
constexpr std::array<std::array<double, 2>, 4> truth{
    {{-1.5, 0.6}, {0.4, 0.7}, {-8.0, 1.7}, {1.1, 0.45}}};

/// Data without noise.
std::vector<ScalingDatum> exact_data(const std::vector<double>& conditions, double relative_error) {
  std::vector<ScalingDatum> data;
  for (const double d_over_r0 : conditions) {
    data.emplace_back().d_over_r0 = d_over_r0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double value = std::exp(truth[i][0] + truth[i][1] * std::log(d_over_r0));
      data.back().*scaling_quantities()[i].datum = {value, relative_error * value};
    }
  }
  return data;
}

/// `count` D/r0 from 2 to 16, evenly in their logarithm.
std::vector<double> conditions(int count) {
  std::vector<double> values;
  values.reserve(count);
  for (int i = 0; i < count; ++i) values.push_back(2.0 * std::pow(8.0, i / (count - 1.0)));
  return values;
}

TEST(ScalingLaw, IsRecoveredFromDataThatFollowOne) {
  const ScalingLaw law = fit_scaling_law(exact_data({3, 4, 6, 8}, 0.05), far_first);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const LawLine& line = law.*scaling_quantities()[i].line;
    EXPECT_NEAR(line.intercept, truth[i][0], 1e-9);
    EXPECT_NEAR(line.slope, truth[i][1], 1e-9);
    EXPECT_EQ(line.scatter, 0.0);
    EXPECT_NEAR(line.predict(5.0).mean, std::exp(truth[i][0]) * std::pow(5.0, truth[i][1]), 1e-8);
  }
  EXPECT_EQ(law.least_d_over_r0, 3.0);
  EXPECT_EQ(law.greatest_d_over_r0, 8.0);
  EXPECT_EQ(law.order, far_first);
}

TEST(ScalingLaw, WithoutScatterTheCovarianceIsThatOfTheStatedErrors) {
  const std::vector<double> values{3, 4, 6, 8};
  // Of weighted least squares: (X^T W X)^-1.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const double d_over_r0 : values) {
    const Eigen::Vector2d row(1.0, std::log(d_over_r0));
    information += row * row.transpose() / (0.05 * 0.05);
  }
  const Eigen::Matrix2d expected = information.inverse();
  const LawLine line = fit_scaling_law(exact_data(values, 0.05), far_first).z_near_talbot;
  EXPECT_TRUE(line.covariance.isApprox(expected, 1e-6)) << line.covariance;

  const Eigen::Vector2d row(1.0, std::log(5.0));
  const MeanAndError prediction = line.predict(5.0);
  EXPECT_NEAR(prediction.standard_error, prediction.mean * std::sqrt(row.dot(expected * row)),
              1e-6 * prediction.mean);
}

TEST(ScalingLaw, IsHardlyMovedByOneWrongDatumWhereverItStands) {
  const std::vector<double> values = conditions(7);
  constexpr double error = 0.02;
  for (std::size_t wrong = 0; wrong < values.size(); ++wrong) {
    std::vector<ScalingDatum> data = exact_data(values, error);
    data[wrong].z_near_talbot.mean *= 3.0;
    data[wrong].z_near_talbot.standard_error *= 3.0;
    const LawLine line = fit_scaling_law(data, far_first).z_near_talbot;

    // Least squares: all weights are equal.
    Eigen::Matrix<double, Eigen::Dynamic, 2> rows(values.size(), 2);
    Eigen::VectorXd logarithms(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      rows.row(i) << 1.0, std::log(values[i]);
      logarithms[i] = std::log(data[i].z_near_talbot.mean);
    }
    const Eigen::Vector2d least_squares =
        (rows.transpose() * rows).inverse() * rows.transpose() * logarithms;

    double moved = 0.0;
    double moved_least_squares = 0.0;
    for (const double d_over_r0 : values) {
      const double x = std::log(d_over_r0);
      const double expected = truth[0][0] + truth[0][1] * x;
      moved = std::max(moved, std::abs(std::log(line.predict(d_over_r0).mean) - expected));
      moved_least_squares = std::max(moved_least_squares,
                                     std::abs(least_squares[0] + least_squares[1] * x - expected));
    }
    EXPECT_LT(moved, 0.5 * error) << wrong;
    EXPECT_GT(moved_least_squares, 5.0 * error) << wrong;
  }
}

/// Fits of noisy copies of exact data.
struct Refits {
  static constexpr int count = 1000;
  /// Of a variance that is estimated from so many refits, relative.
  static inline const double standard_error = std::sqrt(2.0 / count);

  /// @param noise   relative, of each value
  /// @param stated  what the data say of it
  Refits(const std::vector<double>& values, double noise, double stated) {
    for (int refit = 0; refit < count; ++refit) {
      RandomStream stream = random_stream({2022, static_cast<std::uint64_t>(refit)});
      boost::random::normal_distribution<double> normal(0.0, noise);
      std::vector<ScalingDatum> data = exact_data(values, stated);
      for (ScalingDatum& datum : data) {
        const double factor = std::exp(normal(stream));
        datum.z_near_talbot.mean *= factor;
        datum.z_near_talbot.standard_error *= factor;
      }
      const LawLine line = fit_scaling_law(data, far_first).z_near_talbot;
      const Eigen::Vector2d error(line.intercept - truth[0][0], line.slope - truth[0][1]);
      mean_error += error / count;
      squared_errors += error * error.transpose() / count;
      covariance += line.covariance / count;
      scatter += line.scatter / count;
    }
  }

  Eigen::Vector2d mean_error = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squared_errors = Eigen::Matrix2d::Zero();  ///< mean, about the truth
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();      ///< mean of the fits' own
  double scatter = 0.0;                                      ///< mean
};

TEST(ScalingLaw, TheCovarianceAgreesWithTheScatterOfRefits) {
  struct Case {
    int data;
    double stated;
    double most;  ///< expected of the covariance over the refits' scatter
  };
  // The data scatter by 0.05. Where that is stated, errors are only ever made larger, never
  // smaller; and with four data little is known of the scatter.
  for (const auto& [data, stated, most] : {Case{20, 0.01, 1.15}, {20, 0.05, 1.4}, {4, 0.01, 2.1}}) {
    const Refits refits(conditions(data), 0.05, stated);
    for (int i = 0; i < 2; ++i) {
      const double ratio = refits.covariance(i, i) / refits.squared_errors(i, i);
      EXPECT_GT(ratio, 1.0 - 3.0 * Refits::standard_error) << data << ' ' << stated;
      EXPECT_LT(ratio, most * (1.0 + 3.0 * Refits::standard_error)) << data << ' ' << stated;
      EXPECT_LT(std::abs(refits.mean_error[i]),
                3.0 * std::sqrt(refits.squared_errors(i, i) / Refits::count));
    }
    const auto correlation = [](const Eigen::Matrix2d& matrix) {
      return matrix(0, 1) / std::sqrt(matrix(0, 0) * matrix(1, 1));
    };
    EXPECT_NEAR(correlation(refits.covariance), correlation(refits.squared_errors), 0.03);
  }
}

TEST(ScalingLaw, PredictionsIncludeTheScatterOfSingleDesigns) {
  const Refits refits(conditions(20), 0.05, 0.01);
  EXPECT_NEAR(refits.scatter, std::sqrt(0.05 * 0.05 - 0.01 * 0.01), 0.003);

  LawLine line{.intercept = 0.5, .slope = 2.0, .covariance = Eigen::Matrix2d::Zero()};
  line.covariance.diagonal() << 0.01 * 0.01, 0.02 * 0.02;
  line.scatter = 0.03;
  const double x = std::log(4.0);
  const MeanAndError prediction = line.predict(4.0);
  EXPECT_NEAR(prediction.mean, std::exp(0.5) * 16.0, 1e-12);
  EXPECT_NEAR(prediction.standard_error / prediction.mean,
              std::sqrt(0.01 * 0.01 + 0.02 * 0.02 * x * x + 0.03 * 0.03), 1e-12);
}

TEST(ScalingLaw, ItsPlanesAreInVisitingOrder) {
  const Telescope telescope;
  const double near = std::exp(-1.5) * std::pow(4.0, 0.6) * talbot_distance(0.125, 532e-9);
  const double far = distance_at_fresnel_number(telescope, std::exp(0.4) * std::pow(4.0, 0.7));
  const auto planes_in = [&](const std::array<int, 4>& order) {
    return fit_scaling_law(exact_data({3, 4, 6, 8}, 0.05), order).planes(telescope, 0.125);
  };
  const auto are = [](const std::vector<double>& expected) {
    return testing::Pointwise(testing::DoubleNear(1e-3), expected);
  };
  EXPECT_THAT(planes_in({3, 4, 1, 2}), are({-far, far, -near, near}));
  EXPECT_THAT(planes_in({2, 3, 1, 4}), are({near, -far, -near, far}));
}

TEST(ScalingLaw, EqualDOverR0IsEqualFresnelNumbersAtEveryTelescope) {
  const ScalingLaw law = fit_scaling_law(exact_data({3, 4, 6, 8}, 0.05), far_first);
  const Telescope small;
  const Telescope large{.diameter = 8.2, .wavelength = 850e-9};
  const std::vector<double> here = law.planes(small, small.diameter / 5.0);
  const std::vector<double> there = law.planes(large, large.diameter / 5.0);
  for (std::size_t plane = 0; plane < here.size(); ++plane) {
    EXPECT_NEAR(fresnel_number(large, there[plane]) / fresnel_number(small, here[plane]), 1.0,
                1e-12);
  }
}

TEST(ScalingLaw, KnowsWhereItExtrapolates) {
  const ScalingLaw law = fit_scaling_law(exact_data({6, 3, 8, 4}, 0.05), far_first);
  for (const double inside : {3.0, 8.0, 5.0, 0.5 / (0.5 / 3.0), 0.7 / (0.7 / 8.0)}) {
    EXPECT_FALSE(law.extrapolates(inside)) << inside;
  }
  EXPECT_TRUE(law.extrapolates(2.99));
  EXPECT_TRUE(law.extrapolates(8.01));
}

TEST(ScalingLaw, RefusesToExtrapolateToWhatIsNoDesign) {
  const ScalingLaw law = fit_scaling_law(exact_data({3, 4, 6, 8}, 0.05), far_first);
  const auto message = [&](double d_over_r0) {
    return message_of([&] { law.planes(Telescope{}, 0.5 / d_over_r0); });
  };
  // Near over far: (2 e^-1.1 / d^2) d^1.3 = 1 at D/r0 = 0.56; far too far where N_F = 0.1: 0.021.
  EXPECT_EQ(message(0.6), "");
  EXPECT_THAT(message(0.5), StartsWith("seeing.d_over_r0 = 0.5: too far from the law's designs, "
                                       "D/r0 = 3 to 8: there its near pair would be at "));
  EXPECT_EQ(message(1e4), "");
  ScalingLaw steep = law;
  steep.far_fresnel_number.slope = -4.0;
  EXPECT_THAT(message_of([&] { steep.planes(Telescope{}, 0.5 / 8.0); }), HasSubstr("far pair at"));
}

TEST(ScalingLaw, RefusesTooFewData) {
  const auto message = [](const std::vector<double>& values) {
    return message_of([&] { fit_scaling_law(exact_data(values, 0.05), far_first); });
  };
  EXPECT_EQ(message({}), "data = 0 designs: at least 4, or the law's error is unknown");
  EXPECT_THAT(message({3, 4, 6}), StartsWith("data = 3 designs: at least 4"));
  EXPECT_THAT(message({3, 3, 6, 6}), StartsWith("data.d_over_r0 = 3,6: at least 3 different"));
  EXPECT_THAT(message({3, 3.1, 3.2, 3.25}), HasSubstr("reach over a factor of 1.1 or more"));
  EXPECT_EQ(message({3, 3, 4, 6}), "");
}

TEST(ScalingLaw, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const auto& spoil) {
    std::vector<ScalingDatum> data = exact_data({3, 4, 6, 8}, 0.05);
    spoil(data[2]);
    return message_of([&] { fit_scaling_law(data, far_first); });
  };
  for (const double wrong : {0.0, -3.0, nan, HUGE_VAL}) {
    EXPECT_THAT(message([&](ScalingDatum& datum) { datum.d_over_r0 = wrong; }),
                StartsWith(fmt::format("data[2].d_over_r0 = {}: a number above 0", wrong)));
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      const std::string key = fmt::format("data[2].{}", quantity.name);
      EXPECT_THAT(message([&](ScalingDatum& datum) { (datum.*quantity.datum).mean = wrong; }),
                  StartsWith(fmt::format("{}.mean = {}: a number above 0", key, wrong)));
      EXPECT_THAT(
          message([&](ScalingDatum& datum) { (datum.*quantity.datum).standard_error = wrong; }),
          StartsWith(
              fmt::format("{}.standard_error = {}: at least 1e-06 of the mean", key, wrong)));
    }
  }
  EXPECT_THAT(message([](ScalingDatum& datum) {
                datum.residual_wfe = {1.0, 1.0};
              }),
              HasSubstr("and below it"));
}

TEST(ScalingLaw, RefusesWhatIsNoVisitingOrder) {
  const std::string allowed =
      ": each of 1 (-near), 2 (+near), 3 (-far) and 4 (+far) once, such as 3,4,1,2";
  for (const std::vector<int>& wrong :
       std::vector<std::vector<int>>{{}, {1, 2, 3}, {1, 2, 3, 3}, {0, 1, 2, 3}, {1, 2, 3, 4, 5}}) {
    EXPECT_EQ(message_of([&] { validate_order(wrong); }),
              fmt::format("order = {}{}", fmt::join(wrong, ","), allowed));
  }
  EXPECT_NE(message_of([] { fit_scaling_law(exact_data({3, 4, 6, 8}, 0.05), {3, 3, 1, 2}); }), "");
}

TEST(ScalingLaw, PrintsNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  fit_scaling_law(exact_data(conditions(5), 0.05), far_first);
  std::vector<ScalingDatum> wild = exact_data(conditions(5), 1e-6);
  wild[1].residual_wfe = {1e300, 1e299};
  wild[3].residual_wfe = {1e-300, 1e-302};
  fit_scaling_law(wild, far_first);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace nlcwfs
