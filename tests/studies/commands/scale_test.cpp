// Tests of scale: a design moved to another telescope at constant Fresnel numbers.
#include "studies/settings/setup.hpp"
#include "tests/studies/run_results.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

using Scale = Program;

TEST_F(Scale, LeavesItsFiles) {
  const ProgramRun finished = done("scale", "run", {"--scale.diameter", "2m"});
  EXPECT_THAT(names_in("run"), ElementsAre("archive.sqlite", "config.cfg", "report.html",
                                           "scaled.cfg", "summary.json"));
  EXPECT_THAT(finished.output,
              AllOf(StartsWith("From: 0.5 m telescope"), HasSubstr("To: 2 m telescope"),
                    HasSubstr("scaled.cfg"), EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "scale");
  // 16 times the distances: (2 / 0.5)^2.
  EXPECT_EQ(json.at("scaled").at("planes_m"), (Json{-2880e3, 2880e3, -752e3, 752e3}));
  for (int plane = 0; plane < 4; ++plane) {
    EXPECT_NEAR(json["scaled"]["fresnel_numbers"][plane], json["design"]["fresnel_numbers"][plane],
                1e-9);
  }
}

TEST_F(Scale, BandsMoveToAnotherWavelengthWithTheDesign) {
  const Arguments band{"--source.bands", "500nm:600nm", "--source.wavelengths", "3"};
  done("evaluate", "here", band);
  Arguments moved = band;
  moved.insert(moved.end(), {"--scale.wavelength", "1064nm"});
  done("scale", "scaled", moved);
  done("evaluate", "there", {"--config", "scaled/scaled.cfg"});
  const auto residual = [](const char* folder) {
    return double(summary(folder)["design"]["performance"]["residual_wfe_nm"]["mean"]);
  };
  EXPECT_NEAR(residual("there"), 2.0 * residual("here"), 1e-6 * residual("here"));
  done("evaluate", "one");
  EXPECT_GT(residual("here"), residual("one"));
}

TEST_F(Scale, AScaledDesignDoesTheSameInWaves) {
  done("evaluate", "here");
  done("scale", "scaled", {"--scale.diameter", "8.2m", "--scale.wavelength", "1.064um"});
  const ProgramRun moved = run({"evaluate", "--config", "scaled/scaled.cfg", "--output", "there"});
  ASSERT_EQ(moved.exit_code, 0) << moved.errors;
  const Json here = summary("here")["design"]["performance"];
  Json there = summary("there")["design"]["performance"];
  for (const char* metric : {"residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm"}) {
    for (const char* part : {"mean", "standard_error"}) {
      there[metric][part] = double(there[metric][part]) / 2.0;
    }
  }
  expect_same_performance(there, here, 1e-6);
}

TEST_F(Scale, ScalingThereAndBackIsNoChange) {
  const Arguments design{"--telescope.relay_beam_diameter",
                         "10mm",
                         "--seeing.outer_scale",
                         "25m",
                         "--search.z_near",
                         "5km:100km",
                         "--search.z_far",
                         "50km:200km"};
  Arguments there = design;
  there.insert(there.end(), {"--scale.diameter", "8.2m", "--scale.wavelength", "1um",
                             "--scale.relay_beam_diameter", "20mm"});
  done("scale", "there", there);
  const ProgramRun back =
      run({"scale", "--config", "there/scaled.cfg", "--output", "back", "--scale.diameter", "0.5m",
           "--scale.wavelength", "532nm", "--scale.relay_beam_diameter", "10mm"});
  ASSERT_EQ(back.exit_code, 0) << back.errors;

  Configuration original;
  original.read_file("there/config.cfg");
  Configuration returned;
  returned.read_file("back/scaled.cfg");
  for (const char* key :
       {"telescope.diameter", "telescope.wavelength", "telescope.relay_beam_diameter",
        "seeing.outer_scale", "reconstruction.tolerance"}) {
    EXPECT_NEAR(returned.length(key) / original.length(key), 1.0, 1e-12) << key;
  }
  EXPECT_NEAR(returned.numbers("seeing.d_over_r0").front(), 4.0, 1e-12);
  for (const char* key : {"sensor.planes", "baseline.planes"}) {
    for (std::size_t plane = 0; plane < 4; ++plane) {
      EXPECT_NEAR(returned.lengths(key).at(plane) / original.lengths(key).at(plane), 1.0, 1e-12);
    }
  }
  for (const char* key : {"search.z_near", "search.z_far"}) {
    const auto range_of = [&](const Configuration& configuration) {
      return std::get<ValueRange>(configuration.domain(key).value());
    };
    EXPECT_NEAR(range_of(returned).lower / range_of(original).lower, 1.0, 1e-12);
    EXPECT_NEAR(range_of(returned).upper / range_of(original).upper, 1.0, 1e-12);
  }
  const Json json = summary("there");
  // z (d/D)^2 before and after: the beam twice as wide, at 532 / 1000 of the wavelength.
  EXPECT_NEAR(json["scaled"]["planes_bench_m"][0],
              double(json["design"]["planes_bench_m"][0]) * 4.0 * 0.532, 1e-9);
}

TEST_F(Scale, TheRelayStaysUnlessAnotherIsGiven) {
  done("scale", "run", {"--telescope.relay_beam_diameter", "10mm", "--scale.diameter", "8m"});
  const Json json = summary("run");
  EXPECT_NEAR(json["scaled"]["planes_bench_m"][0], json["design"]["planes_bench_m"][0], 1e-9);
  EXPECT_THAT(contents("run/scaled.cfg"), HasSubstr("relay_beam_diameter = 0.01\n"));
}

}  // namespace
}  // namespace nlcwfs
