// Tests: Designs and performances become JSON, and designs come back.
#include "results/tables/design_summary.hpp"

#include <cmath>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::IsSupersetOf;
using testing::UnorderedElementsAre;
using Json = nlohmann::ordered_json;

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

ScreenPerformance screen(double nanometres, bool converged) {
  return {.wavefront = {.residual_wfe = nanometres * 1e-9,
                        .wrapped_wfe = 2.0 * nanometres * 1e-9,
                        .total_wfe = 3.0 * nanometres * 1e-9,
                        .field_strehl = 0.5},
          .converged = converged,
          .loops = 6,
          .fractional_loops = 5.5,
          .fft_count = 60,
          .seconds = 0.25,
          .captured_energy = {0.01 * nanometres, 1.0}};
}

TEST(DesignSummary, HasThePerformancesOfTheContract) {
  const Json json = to_json(Performance{{screen(10.0, true), screen(20.0, false)}});
  EXPECT_THAT(keys_of(json), UnorderedElementsAre(
                                 "residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm",
                                 "field_strehl", "loops", "fractional_loops", "seconds",
                                 "fft_count", "captured_energy", "converged_fraction", "screens"));
  for (const PerformanceMetric& metric : performance_metrics()) {
    EXPECT_THAT(keys_of(json[std::string(metric.name)]),
                UnorderedElementsAre("mean", "standard_error"))
        << metric.name;
  }
}

TEST(DesignSummary, HasMeansAndStandardErrorsInNanometres) {
  const Json json = to_json(Performance{{screen(10.0, true), screen(20.0, false)}});
  // Two values at +- 5 of their mean: standard error 5.
  EXPECT_NEAR(json["residual_wfe_nm"]["mean"], 15.0, 1e-12);
  EXPECT_NEAR(json["residual_wfe_nm"]["standard_error"], 5.0, 1e-12);
  EXPECT_NEAR(json["wrapped_wfe_nm"]["mean"], 30.0, 1e-12);
  EXPECT_NEAR(json["total_wfe_nm"]["mean"], 45.0, 1e-12);
  EXPECT_EQ(json["field_strehl"]["mean"], 0.5);
  EXPECT_EQ(json["loops"]["mean"], 6.0);
  EXPECT_EQ(json["loops"]["standard_error"], 0.0);
  EXPECT_EQ(json["fractional_loops"]["mean"], 5.5);
  EXPECT_EQ(json["fft_count"]["mean"], 60.0);
  EXPECT_EQ(json["seconds"]["mean"], 0.25);
  EXPECT_NEAR(json["captured_energy"].at(0), 0.15, 1e-15);
  EXPECT_EQ(json["captured_energy"].at(1), 1.0);
  EXPECT_EQ(json["converged_fraction"], 0.5);
  EXPECT_EQ(json["screens"], 2);
}

TEST(DesignSummary, HasThePlanesInEveryUnit) {
  // D^2 / lambda = 500 km; the Talbot distance of r0 = 0.1 m is 40 km.
  const Telescope telescope{.diameter = 0.5, .wavelength = 500e-9};
  SensorDesign design;
  design.planes = {-100e3, 0.0, 50e3};
  design.detector.pupil_pixels = 32;
  const Json json = to_json(design, telescope, 0.1);
  EXPECT_THAT(keys_of(json), IsSupersetOf({"planes_m", "planes_talbot", "fresnel_numbers",
                                           "pupil_pixels", "detector_window"}));
  EXPECT_EQ(json["planes_m"], (Json{-100e3, 0.0, 50e3}));
  EXPECT_NEAR(json["planes_talbot"].at(0), -2.5, 1e-12);
  EXPECT_EQ(json["planes_talbot"].at(1), 0.0);
  EXPECT_NEAR(json["fresnel_numbers"].at(0), -5.0, 1e-12);
  EXPECT_TRUE(json["fresnel_numbers"].at(1).is_null()) << "infinite in the pupil itself";
  EXPECT_NEAR(json["fresnel_numbers"].at(2), 10.0, 1e-12);
  EXPECT_EQ(json["pupil_pixels"], 32);
  EXPECT_FALSE(json.contains("planes_bench_m"));
}

TEST(DesignSummary, HasThePhotonsOfAFrame) {
  SensorDesign design;
  design.detector.photon_rate = 2e8;
  design.detector.exposure = 0.5;
  const Json json = to_json(design, {}, 0.1);
  EXPECT_EQ(json["photons"], 1e8);
  EXPECT_EQ(json["photon_rate"], 2e8);
  EXPECT_EQ(json["exposure_s"], 0.5);
}

TEST(DesignSummary, HasBenchDistancesBehindARelay) {
  const Telescope telescope{.diameter = 0.5, .wavelength = 500e-9, .relay_beam_diameter = 0.005};
  SensorDesign design;
  design.planes = {-100e3, 50e3};
  const Json json = to_json(design, telescope, 0.1);
  ASSERT_EQ(json["planes_bench_m"].size(), 2u);
  EXPECT_NEAR(json["planes_bench_m"].at(0), -10.0, 1e-12);
  EXPECT_NEAR(json["planes_bench_m"].at(1), 5.0, 1e-12);
}

/// The default and designs that differ from it in one setting each.
std::vector<SensorDesign> different_designs() {
  std::vector<SensorDesign> designs(17);
  designs[1].detector.pupil_pixels = 32;
  designs[2].detector.window = 6.0;
  designs[3].detector.photons = 1e4;
  designs[4].detector.read_noise = 3.0;
  designs[5].reconstruction.max_loops = 7;
  designs[6].reconstruction.tolerance = 2e-9;
  designs[7].reconstruction.stopping = StoppingRule::rms_change;
  designs[8].reconstruction.relaxation_start = 0.5;
  designs[9].reconstruction.relaxation_end = 0.5;
  designs[10].reconstruction.initial_guess = InitialGuess::centroid;
  designs[11].reconstruction.window = 9.0;
  designs[12].reconstruction.outside = OutsideDetector::zero;
  designs[13].reconstruction.oversampling = 2;
  designs[14].reconstruction.unwrapping = UnwrappingMethod::quality_guided;
  designs[15].detector.photon_rate = 1e8;
  designs[15].detector.exposure = 1e-3;
  designs[16].detector.exposure = 1e-3;
  return designs;
}

TEST(DesignSummary, TellsDesignsApartBySettingsOtherThanPlanes) {
  const std::vector<SensorDesign> designs = different_designs();
  std::set<std::string> texts;
  for (const SensorDesign& design : designs) texts.insert(to_json(design, {}, 0.125).dump());
  EXPECT_EQ(texts.size(), designs.size());
}

TEST(DesignSummary, GivesItsDesignBackToTheLastBit) {
  for (SensorDesign design : different_designs()) {
    design.planes = {-1e5 / 3.0, 0.0, 47123.456789012345};
    design.detector.window *= 1.0 + 1e-15;
    design.detector.read_noise = std::nextafter(0.1, 1.0);
    design.reconstruction.tolerance *= 1.0 / 3.0;
    const Json json = Json::parse(to_json(design, {}, 0.125).dump());
    const SensorDesign back = design_from_json(json);
    EXPECT_EQ(back.planes, design.planes);
    EXPECT_EQ(back.detector.window, design.detector.window);
    EXPECT_EQ(back.detector.photons, design.detector.photons);
    EXPECT_EQ(back.detector.read_noise, design.detector.read_noise);
    EXPECT_EQ(back.reconstruction.tolerance, design.reconstruction.tolerance);
    EXPECT_EQ(to_json(back, {}, 0.125), json) << "which tells designs apart";
  }
}

TEST(DesignSummary, OfNoDesignIsRefused) {
  const Json whole = to_json(SensorDesign(), {}, 0.125);
  for (const char* member : {"planes_m", "pupil_pixels", "relaxation", "stopping", "exposure_s"}) {
    Json json = whole;
    json.erase(member);
    EXPECT_THROW(design_from_json(json), Json::exception) << member;
    json[member] = Json::object();
    EXPECT_THROW(design_from_json(json), Json::exception) << member;
  }
  for (const char* member : {"pupil_pixels", "max_loops", "oversampling"}) {
    for (const double number : {0.5, 1e300, -1e300, 2147483648.0}) {
      Json json = whole;
      json[member] = number;
      EXPECT_THAT(
          [&] { design_from_json(json); },
          testing::ThrowsMessage<std::runtime_error>(testing::EndsWith("should be a whole number")))
          << member;
    }
  }
  for (const char* word : {"stopping", "initial_guess", "outside", "unwrapping"}) {
    Json json = whole;
    json[word] = "best";
    EXPECT_THAT([&] { design_from_json(json); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::StartsWith(std::string(word) + " is 'best', but should be ")));
  }
}

}  // namespace
}  // namespace nlcwfs
