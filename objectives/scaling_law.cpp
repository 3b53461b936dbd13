// A law is fitted to the best designs at several seeings.
#include "objectives/scaling_law.hpp"

#include "model/input_error.hpp"
#include "model/sensor_design.hpp"

#include <algorithm>
#include <ceres/ceres.h>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr double cauchy_constant = 2.385;
constexpr double least_relative_error = 1e-6;
constexpr std::size_t least_data = 4;
constexpr std::size_t least_conditions = 3;

/// A datum of one line.
struct Point {
  double x;      ///< ln(D/r0)
  double y;      ///< ln(value)
  double sigma;  ///< of y
};

using Parameters = std::array<double, 2>;  // intercept, slope

/// How far a point lies off the line, in units of `scale` of its standard errors.
struct LineResidual {
  Point point;
  double scale;

  template <class T>
  bool operator()(const T* line, T* residual) const {
    *residual = (point.y - line[0] - line[1] * point.x) / (scale * point.sigma);
    return true;
  }
};

/// The residuals of a line under a robust loss, as one Ceres problem.
class LineProblem {
 public:
  /// @param line  where the fit starts and what it changes
  /// @param loss  must outlive the problem
  LineProblem(std::span<const Point> points, double scale, Parameters& line,
              ceres::LossFunction& loss)
      : line_(line), problem_(options()) {
    for (const Point& point : points) {
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<LineResidual, 1, 2>(new LineResidual{point, scale}),
          &loss, line.data());
    }
  }

  void solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.max_num_iterations = 500;
    options.function_tolerance = 1e-15;
    options.parameter_tolerance = 1e-12;
    options.gradient_tolerance = 1e-14;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) {
      throw std::runtime_error("the scaling law cannot be fitted: " + summary.message);
    }
  }

  /// Of the parameters, for residuals of unit variance; what the loss discounts counts for less.
  Eigen::Matrix2d covariance() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    ceres::Covariance estimate(options);
    Eigen::Matrix<double, 2, 2, Eigen::RowMajor> covariance;
    if (!estimate.Compute(std::vector<const double*>{line_.data()}, &problem_) ||
        !estimate.GetCovarianceBlock(line_.data(), line_.data(), covariance.data())) {
      throw std::runtime_error("the scaling law cannot be fitted: its covariance is singular");
    }
    // Symmetric but for rounding.
    return 0.5 * (covariance + covariance.transpose());
  }

 private:
  static ceres::Problem::Options options() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  Parameters& line_;
  ceres::Problem problem_;
};

double median(std::span<const double> sorted) {
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

/// Standard deviation of a line's residuals in units of their standard errors, at least 1. A least
/// absolute fit goes through two points, whose residuals say nothing.
double residual_scale(std::span<const Point> points, const Parameters& line) {
  std::vector<double> sizes;
  for (const Point& point : points) {
    double residual = 0.0;
    LineResidual{point, 1.0}(line.data(), &residual);
    sizes.push_back(std::abs(residual));
  }
  std::ranges::sort(sizes);
  constexpr double median_of_normal = 0.6745;
  return std::max(1.0, median(std::span(sizes).subspan(2)) / median_of_normal);
}

LawLine fit_line(std::span<const Point> points) {
  Parameters line{};
  // Where the errors are understated this is all but a least absolute fit, which needs no scale.
  ceres::SoftLOneLoss absolute(1.0);
  LineProblem(points, 1.0, line, absolute).solve();
  const double scale = residual_scale(points, line);
  ceres::CauchyLoss cauchy(cauchy_constant);
  LineProblem problem(points, scale, line, cauchy);
  problem.solve();

  std::vector<double> sigmas;
  for (const Point& point : points) sigmas.push_back(point.sigma);
  std::ranges::sort(sigmas);
  return {.intercept = line[0],
          .slope = line[1],
          .covariance = problem.covariance(),
          .scatter = std::sqrt(scale * scale - 1.0) * median(sigmas)};
}

void require_positive(const std::string& key, double value) {
  require(value > 0.0 && std::isfinite(value), key, value, "a number above 0");
}

void validate(std::span<const ScalingDatum> data) {
  require(data.size() >= least_data, "data", fmt::format("{} designs", data.size()),
          fmt::format("at least {}, or the law's error is unknown", least_data));
  std::set<double> conditions;
  for (std::size_t i = 0; i < data.size(); ++i) {
    require_positive(fmt::format("data[{}].d_over_r0", i), data[i].d_over_r0);
    conditions.insert(data[i].d_over_r0);
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      const MeanAndError& value = data[i].*quantity.datum;
      const std::string key = fmt::format("data[{}].{}", i, quantity.name);
      require_positive(key + ".mean", value.mean);
      const double relative = value.standard_error / value.mean;
      require(relative >= least_relative_error && relative < 1.0, key + ".standard_error",
              value.standard_error,
              fmt::format("at least {} of the mean, which is {}, and below it",
                          least_relative_error, value.mean));
    }
  }
  if (conditions.size() < least_conditions ||
      *conditions.rbegin() < ScalingLaw::least_reach * *conditions.begin()) {
    throw InputError("data.d_over_r0", fmt::format("{}", fmt::join(conditions, ",")),
                     fmt::format("at least {} different values that reach over a factor of {} or "
                                 "more",
                                 least_conditions, ScalingLaw::least_reach));
  }
}

}  // namespace

MeanAndError LawLine::predict(double d_over_r0) const {
  const Eigen::Vector2d row(1.0, std::log(d_over_r0));
  const double value = std::exp(intercept + slope * row[1]);
  return {value, value * std::sqrt(row.dot(covariance * row) + scatter * scatter)};
}

bool ScalingLaw::extrapolates(double d_over_r0) const {
  // The D/r0 of a telescope is a quotient: its last digits differ from what was written.
  constexpr double rounding = 1e-9;
  return d_over_r0 < least_d_over_r0 * (1.0 - rounding) ||
         d_over_r0 > greatest_d_over_r0 * (1.0 + rounding);
}

std::vector<double> ScalingLaw::planes(const Telescope& telescope, double fried_parameter) const {
  const double d_over_r0 = telescope.diameter / fried_parameter;
  const double near = z_near_talbot.predict(d_over_r0).mean *
                      talbot_distance(fried_parameter, telescope.wavelength);
  const double far =
      distance_at_fresnel_number(telescope, far_fresnel_number.predict(d_over_r0).mean);
  if (!(near > 0.0 && near < far && far <= farthest_distance(telescope))) {
    throw InputError(
        "seeing.d_over_r0", fmt::format("{:g}", d_over_r0),
        fmt::format(
            "too far from the law's designs, D/r0 = {:g} to {:g}: there its near pair "
            "would be at {:.3g} km, its far pair at {:.3g} km; search the planes with optimize",
            least_d_over_r0, greatest_d_over_r0, near / 1e3, far / 1e3));
  }
  const std::array<double, 4> numbered{-near, near, -far, far};
  std::vector<double> planes;
  for (const int plane : order) planes.push_back(numbered.at(static_cast<std::size_t>(plane - 1)));
  return planes;
}

std::span<const ScalingQuantity> scaling_quantities() {
  static constexpr std::array<ScalingQuantity, 4> quantities{
      {{"z_near_talbot", &ScalingDatum::z_near_talbot, &ScalingLaw::z_near_talbot},
       {"far_fresnel_number", &ScalingDatum::far_fresnel_number, &ScalingLaw::far_fresnel_number},
       {"residual_wfe_wavelengths", &ScalingDatum::residual_wfe, &ScalingLaw::residual_wfe},
       {"fractional_loops", &ScalingDatum::fractional_loops, &ScalingLaw::fractional_loops}}};
  return quantities;
}

void validate_order(std::span<const int> order) {
  constexpr std::array<int, 4> each{1, 2, 3, 4};
  if (!std::ranges::is_permutation(order, each)) {
    throw InputError("order", fmt::format("{}", fmt::join(order, ",")),
                     "each of 1 (-near), 2 (+near), 3 (-far) and 4 (+far) once, such as 3,4,1,2");
  }
}

ScalingLaw fit_scaling_law(std::span<const ScalingDatum> data, const std::array<int, 4>& order) {
  validate_order(order);
  validate(data);
  const auto [least, greatest] = std::ranges::minmax(data, {}, &ScalingDatum::d_over_r0);
  ScalingLaw law;
  law.least_d_over_r0 = least.d_over_r0;
  law.greatest_d_over_r0 = greatest.d_over_r0;
  law.order = order;
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    std::vector<Point> points;
    for (const ScalingDatum& datum : data) {
      const auto [mean, standard_error] = datum.*quantity.datum;
      points.push_back({std::log(datum.d_over_r0), std::log(mean), standard_error / mean});
    }
    law.*quantity.line = fit_line(points);
  }
  return law;
}

}  // namespace nlcwfs
