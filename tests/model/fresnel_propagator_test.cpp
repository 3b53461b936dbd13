// Tests: A field is propagated on the reconstruction's periodic grid.
#include "model/fresnel_propagator.hpp"

#include "coma_reference.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

constexpr double wavelength = 532e-9;
constexpr double pitch = 0.5 / coma_pupil_samples;

TEST(FresnelPropagator, MatchesTheIndependentValuesOfAComaticBeam) {
  const FresnelPropagator<double> propagator(coma_grid, pitch, wavelength);
  const nlohmann::json reference = coma_reference();
  for (const auto& beam : reference["cases"]) {
    for (const auto& plane : beam["planes"]) {
      Field<double> field = coma_field(beam["coefficient"]);
      propagator.propagate(field, plane["z"]);
      const Image<double> intensity = field.abs2();
      EXPECT_NEAR(intensity.sum(), plane["total"], 1e-10 * plane["total"].get<double>());
      EXPECT_NEAR(intensity.maxCoeff(), plane["max"], 1e-10);
      EXPECT_NEAR(intensity.square().sum(), plane["sum_I2"], 1e-10 * plane["sum_I2"].get<double>());
      for (const auto& pixel : plane["pixels"]) {
        const int row = pixel["row"];
        const int column = pixel["col"];
        EXPECT_NEAR(intensity(row, column), pixel["I"], 1e-10) << "z " << plane["z"];
        EXPECT_NEAR(field(row, column).real(), pixel["re"], 1e-10);
        EXPECT_NEAR(field(row, column).imag(), pixel["im"], 1e-10);
      }
    }
  }
}

TEST(FresnelPropagator, ZeroDistanceIsExactlyTheIdentity) {
  const Field<double> before = coma_field(2.0);
  Field<double> field = before;
  FresnelPropagator<double>(coma_grid, pitch, wavelength).propagate(field, 0.0);
  EXPECT_TRUE((field == before).all());
}

template <class Real>
class FresnelPropagatorPrecision : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(FresnelPropagatorPrecision, Precisions);

TYPED_TEST(FresnelPropagatorPrecision, GoingForthAndBackIsTheIdentityAndEnergyIsConserved) {
  using Complex = std::complex<TypeParam>;
  const Field<TypeParam> before = coma_field(2.0).template cast<Complex>();
  const FresnelPropagator<TypeParam> propagator(coma_grid, pitch, wavelength);
  const double tolerance = 50.0 * double(std::numeric_limits<TypeParam>::epsilon());
  for (const double distance : {5e3, -47e3, 180e3, 1e6}) {
    Field<TypeParam> field = before;
    propagator.propagate(field, distance);
    const double energy = field.template cast<std::complex<double>>().abs2().sum();
    EXPECT_NEAR(energy / 3228.0, 1.0, tolerance) << distance;
    propagator.propagate(field, -distance);
    EXPECT_LT(double((field - before).abs().maxCoeff()), tolerance) << distance;
  }
}

TEST(FresnelPropagator, TwoHopsAreOneHopOfTheirSum) {
  const FresnelPropagator<double> propagator(coma_grid, pitch, wavelength);
  Field<double> in_two = coma_field(2.0);
  propagator.propagate(in_two, 30e3);
  propagator.propagate(in_two, -77e3);
  Field<double> in_one = coma_field(2.0);
  propagator.propagate(in_one, -47e3);
  EXPECT_LT((in_two - in_one).abs().maxCoeff(), 1e-12);
}

/// exp(i phi sin(2 pi x / period)) on a periodic grid that holds whole periods.
Field<double> sinusoidal_phase(double amplitude, int samples, int periods) {
  Field<double> field(samples, samples);
  for (int column = 0; column < samples; ++column) {
    field.col(column).setConstant(
        std::polar(1.0, amplitude * std::sin(2.0 * std::numbers::pi * periods * column / samples)));
  }
  return field;
}

TEST(FresnelPropagator, APeriodicPhaseImagesItselfAtTheTalbotDistance) {
  const int samples = 240;
  const int periods = 6;
  const Field<double> before = sinusoidal_phase(1.3, samples, periods);
  Field<double> field = before;
  FresnelPropagator<double>(samples, pitch, wavelength)
      .propagate(field, talbot_distance(samples * pitch / periods, wavelength));
  EXPECT_LT((field - before).abs().maxCoeff(), 1e-10);
}

TEST(FresnelPropagator, AWeakSinusoidalPhaseShowsTheAnalyticContrast) {
  // The intensity is 1 + 2 phi sin(pi lambda z / a^2) sin(2 pi x / a) to first order in phi.
  const int samples = 240;
  const int periods = 6;
  const double period = samples * pitch / periods;
  const double amplitude = 1e-4;
  const FresnelPropagator<double> propagator(samples, pitch, wavelength);
  for (const double share_of_talbot_distance : {0.05, 0.25, 0.4, 0.6, 1.3}) {
    const double distance = share_of_talbot_distance * talbot_distance(period, wavelength);
    Field<double> field = sinusoidal_phase(amplitude, samples, periods);
    propagator.propagate(field, distance);
    const Image<double> intensity = field.abs2();
    const double contrast = 0.5 * (intensity.maxCoeff() - intensity.minCoeff());
    const double expected =
        2.0 * amplitude *
        std::abs(std::sin(std::numbers::pi * wavelength * distance / (period * period)));
    EXPECT_NEAR(contrast, expected, 2.0 * amplitude * amplitude) << share_of_talbot_distance;
  }
}

/// A Gaussian beam whose samples hold all of its spectrum, about (x, y) in samples from the middle.
Field<double> gaussian(int samples, double x, double y) {
  const Eigen::ArrayXd position = Eigen::ArrayXd::LinSpaced(samples, 0, samples - 1) - samples / 2;
  const Eigen::ArrayXd column = (-(position - y).square() / 50.0).exp();
  const Eigen::ArrayXd row = (-(position - x).square() / 50.0).exp();
  return (column.matrix() * row.matrix().transpose()).array().cast<std::complex<double>>();
}

TEST(FresnelPropagator, MovesAFieldByFractionsOfASample) {
  const int samples = 128;
  const FresnelPropagator<double> propagator(samples, pitch, wavelength);
  const auto moved = [&](double distance, double x, double y) {
    Field<double> field = gaussian(samples, 0.0, 0.0);
    const auto& transform = propagator.row_transform();
    using Sample = std::complex<double>;
    const auto rows = [&](const auto& operation) {
      for_each_row(field, samples, 0, samples, operation);
    };
    rows([&](const Sample* in, Sample* out) { transform.forward(in, out); });
    const RowRange all{0, samples};
    propagator.propagate_transformed_rows(field, propagator.transfer(distance, x * pitch),
                                          propagator.transfer(distance, y * pitch), all, all);
    rows([&](const Sample* in, Sample* out) { transform.backward(in, out); });
    return Field<double>(field / double(samples));
  };
  for (const double distance : {0.0, 20e3}) {
    Field<double> expected = gaussian(samples, 3.25, -7.6);
    propagator.propagate(expected, distance);
    EXPECT_LT((moved(distance, 3.25, -7.6) - expected).abs().maxCoeff(), 1e-9) << distance;
  }
}

}  // namespace
}  // namespace nlcwfs
