// Phase screens are drawn whose structure function is exact.
#include "model/turbulence_screen.hpp"

#include "model/input_error.hpp"
#include "model/random_stream.hpp"
#include "model/sample_positions.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/random/normal_distribution.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

using Complex = std::complex<double>;

/// D/r0 far beyond any telescope's, where phases still have digits to spare.
constexpr double strongest_turbulence = 1e4;

struct Derivatives {
  double first;
  double second;
};

/// Derivatives of the semivariogram in the separation as a fraction of `length`, at 1; rad^2.
Derivatives semivariogram_derivatives(double length, const Seeing& seeing) {
  const double kolmogorov = kolmogorov_structure_function(length, seeing.fried_parameter) / 2.0;
  if (!seeing.outer_scale) return {5.0 / 3.0 * kolmogorov, 10.0 / 9.0 * kolmogorov};
  // With d/dx x^nu K_nu(x) = -x^nu K_(nu-1)(x), nothing cancels for x << 1.
  const double x = 2.0 * std::numbers::pi * length / *seeing.outer_scale;
  const double scale = kolmogorov * std::pow(2.0, 11.0 / 6.0) * std::tgamma(11.0 / 6.0) /
                       (std::tgamma(1.0 / 6.0) * std::tgamma(5.0 / 6.0));
  const double first = scale * std::pow(x, 1.0 / 6.0) * boost::math::cyl_bessel_k(1.0 / 6.0, x);
  const double curvature = scale * std::pow(x, 7.0 / 6.0) * boost::math::cyl_bessel_k(5.0 / 6.0, x);
  return {first, 2.0 / 3.0 * first - curvature};
}

/// The covariance K of the class comment.
class EmbeddedCovariance {
 public:
  /// @param length  the largest separation, m
  EmbeddedCovariance(double length, const Seeing& seeing) : length_(length), seeing_(seeing) {
    const auto [first, second] = semivariogram_derivatives(length, seeing);
    // c2 = 0 has the solution R^2 + R = 2 / (1 - 3 s), s = gamma'(1) / (gamma'(1) - gamma''(1)); it
    // lies below 2 for s < 2/9. Below an outer scale of about length / 100 both derivatives
    // underflow.
    if (9.0 * first < 2.0 * (first - second)) {
      const double s = first / (first - second);
      support_ = (std::sqrt(1.0 + 8.0 / (1.0 - 3.0 * s)) - 1.0) / 2.0;
    }
    const double r = support_;
    const double tail_slope = (r - 1.0) * (r - 1.0) * (r + 2.0);
    tail_ = (first - second) / (2.0 * (r * r * r - 1.0) + tail_slope);
    quadratic_ = std::max(0.0, (first - tail_ * tail_slope) / 2.0);
    constant_ = semivariogram(1.0) - quadratic_ + tail_ * std::pow(r - 1.0, 3);
  }

  double support() const { return support_; }
  double quadratic() const { return quadratic_; }

  /// @param r  separation as a fraction of the largest
  double operator()(double r) const {
    if (r <= 1.0) return constant_ - semivariogram(r) + quadratic_ * r * r;
    return r < support_ ? tail_ * std::pow(support_ - r, 3) / r : 0.0;
  }

 private:
  double semivariogram(double r) const {
    return von_karman_structure_function(r * length_, seeing_) / 2.0;
  }

  double length_;
  Seeing seeing_;
  double support_ = 2.0;
  double tail_;
  double quadratic_;
  double constant_;
};

/// Replaces the even sequence given by its samples 0 ... period / 2 with its Fourier transform.
template <class Samples>
void transform_even(const LineTransform<double>& transform, Samples&& samples) {
  const int period = transform.length();
  Eigen::ArrayX<Complex> line(period);
  for (int x = 0; x < period; ++x) line[x] = samples[std::min(x, period - x)];
  Eigen::ArrayX<Complex> transformed(period);
  transform.forward(line.data(), transformed.data());
  samples = transformed.head(period / 2 + 1).real();
}

}  // namespace

TurbulenceScreenGenerator::TurbulenceScreenGenerator(const Seeing& seeing, int samples,
                                                     double diameter, std::uint64_t seed)
    : samples_(samples), seed_(seed), transform_(1) {
  assert(samples >= 2 && diameter > 0.0);
  seeing.validate();
  require(diameter / seeing.fried_parameter <= strongest_turbulence, "seeing.fried_parameter",
          seeing.fried_parameter,
          fmt::format("at least the diameter, {:g} m, over {:g}", diameter, strongest_turbulence));
  const double longest = std::numbers::sqrt2 * (samples - 1);  // in samples
  const EmbeddedCovariance covariance(longest * diameter / samples, seeing);
  tilt_per_sample_ = std::sqrt(2.0 * covariance.quadratic()) / longest;

  const int period =
      fast_transform_length(static_cast<int>(std::ceil(2.0 * covariance.support() * longest)));
  transform_ = LineTransform<double>(period);
  Image<double> spectrum(period / 2 + 1, period / 2 + 1);
  for (int y = 0; y <= period / 2; ++y) {
    for (int x = 0; x <= y; ++x) {
      spectrum(y, x) = spectrum(x, y) = covariance(std::hypot(x, y) / longest);
    }
  }
  for (int y = 0; y <= period / 2; ++y) transform_even(transform_, spectrum.row(y).transpose());
  for (int x = 0; x <= period / 2; ++x) transform_even(transform_, spectrum.col(x));

  constexpr double rounding = 1e-13;
  if (!(spectrum.minCoeff() >= -rounding * spectrum.maxCoeff())) {
    throw std::runtime_error(fmt::format(
        "no exact turbulence screens of {} samples over {} m: the embedding's spectrum is negative",
        samples, diameter));
  }
  amplitude_ = spectrum.max(0.0).sqrt() / period;
}

std::array<PhaseScreen, 2> TurbulenceScreenGenerator::screen_pair(int pair) const {
  assert(pair >= 0);
  RandomStream generator = random_stream({seed_, static_cast<std::uint64_t>(pair)});
  boost::random::normal_distribution<double> normal;

  // Only the first n samples of each axis are wanted, so the columns beyond n are never
  // transformed.
  const int period = transform_.length();
  Field<double> field(period, samples_);
  Eigen::ArrayX<Complex> line(period);
  Eigen::ArrayX<Complex> transformed(period);
  for (int y = 0; y < period; ++y) {
    const int row = std::min(y, period - y);
    for (int x = 0; x < period; ++x) {
      const double real = normal(generator);
      const double imaginary = normal(generator);
      line[x] = amplitude_(row, std::min(x, period - x)) * Complex(real, imaginary);
    }
    transform_.forward(line.data(), transformed.data());
    field.row(y) = transformed.head(samples_).transpose();
  }
  for_each_column(field, samples_, [this](const Complex* in, Complex* out, Eigen::Index) {
    transform_.forward(in, out);
  });

  const Eigen::ArrayXd position = sample_positions(samples_);
  const auto with_tilt = [&](PhaseScreen screen) {
    const double slope_x = tilt_per_sample_ * normal(generator);
    const double slope_y = tilt_per_sample_ * normal(generator);
    screen.rowwise() += slope_x * position.transpose();
    screen.colwise() += slope_y * position;
    return screen;
  };
  PhaseScreen first = with_tilt(field.topRows(samples_).real());
  PhaseScreen second = with_tilt(field.topRows(samples_).imag());
  return {std::move(first), std::move(second)};
}

PhaseScreen TurbulenceScreenGenerator::screen(int index) const {
  assert(index >= 0);
  return screen_pair(index / 2)[index % 2];
}

std::vector<PhaseScreen> generate_screens(const TurbulenceScreenGenerator& generator, int count,
                                          const std::function<bool(int)>& watch) {
  assert(count >= 0);
  std::vector<PhaseScreen> screens(count);
  std::atomic<int> next_pair = 0;
  std::atomic<bool> is_ended = false;
  // Whoever is free takes the next pair, so that those of an ended run are the first ones.
  tbb::parallel_for(0, (count + 1) / 2, [&](int) {
    if (is_ended) return;
    const int index = 2 * next_pair++;
    auto [first, second] = generator.screen_pair(index / 2);
    screens[index] = std::move(first);
    if (index + 1 < count) screens[index + 1] = std::move(second);
    if (watch && !watch(std::min(2, count - index))) is_ended = true;
  });
  screens.resize(std::min(count, 2 * next_pair));
  return screens;
}

}  // namespace nlcwfs
