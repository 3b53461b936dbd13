// Tests of the command response, run as a user does.
#include "tests/studies/program.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

std::ptrdiff_t line_count(const std::string& text) { return std::ranges::count(text, '\n'); }

class ResponseStudy : public Program {
 protected:
  /// A pair close to the pupil, where the Talbot effect blinds it at the 28th cycle, on the
  /// reconstructor's own grid.
  static inline const Arguments pair{"--sensor.planes=-600m,600m",
                                     "--simulation.truth",
                                     "matched",
                                     "--detector.pupil_pixels",
                                     "64",
                                     "--reconstruction.window",
                                     "2",
                                     "--response.frequencies",
                                     "5,14,20,28"};
  static inline const Arguments with_photons{
      "--detector.photons", "1e7", "--screens.count", "16", "--response.frequencies", "2,5"};

  static Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  static Json response_of(const std::string& folder) {
    return summary(folder)["design"]["response"];
  }
};

TEST_F(ResponseStudy, LeavesItsFiles) {
  const ProgramRun finished = done("response", "run");
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "report.html", "response.csv",
                          "response.png", "response.svg", "summary.json"));
  EXPECT_THAT(finished.output,
              AllOf(StartsWith("0.5 m telescope at 532 nm"), HasSubstr("Sinusoids of 10 nm (peak)"),
                    HasSubstr("recovered share"), Not(HasSubstr("noise")),
                    EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json["command"], "response");
  EXPECT_EQ(json["cycles_per_pupil"], (Json{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}))
      << "all below half of 16 pixels";
  EXPECT_EQ(json["amplitude_m"], 1e-8);
  EXPECT_EQ(json["wavefronts"], 2);
  EXPECT_EQ(json["design"]["planes_m"], (Json{-180e3, 180e3, -47e3, 47e3}));
  EXPECT_FALSE(json.contains("pairs"));
  const Json& response = json["design"]["response"];
  EXPECT_FALSE(response.contains("amplitude_noise_nm"));
  for (const char* figure :
       {"recovered_share", "recovered_amplitude_nm", "residual_wfe_nm", "fractional_loops",
        "talbot_contrast_per_rad", "effective_contrast_per_rad"}) {
    EXPECT_EQ(response.at(figure).size(), 7u) << figure;
  }
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_DOUBLE_EQ(response["recovered_amplitude_nm"][i]["mean"],
                     10.0 * double(response["recovered_share"][i]["mean"]));
  }
  const std::string table = contents("run/response.csv");
  EXPECT_EQ(line_count(table), 8);
  EXPECT_THAT(table, AllOf(StartsWith("planes,pair_distance_m,cycles_per_pupil,period_m,"),
                           HasSubstr("\ndesign,,4,0.125,")));
}

TEST_F(ResponseStudy, APairSeesWhatThePredictedContrastSays) {
  done("response", "run",
       joined(pair, {"--response.amplitude", "1nm", "--reconstruction.tolerance", "0",
                     "--reconstruction.max_loops", "2"}));
  const Json response = response_of("run");
  const auto share = [&](std::size_t i) { return double(response["recovered_share"][i]["mean"]); };
  const auto contrast = [&](const char* name, std::size_t i) { return double(response[name][i]); };
  EXPECT_NEAR(contrast("talbot_contrast_per_rad", 2), 2.0, 0.01);
  EXPECT_NEAR(share(2), 1.0, 0.01);
  EXPECT_NEAR(contrast("talbot_contrast_per_rad", 3), 0.0, 0.01);
  EXPECT_LT(contrast("effective_contrast_per_rad", 3), 0.5);
  EXPECT_LT(share(3), 0.2) << "Talbot blind";
  EXPECT_LT(contrast("effective_contrast_per_rad", 0), 0.5);
  EXPECT_LT(share(0), 0.2) << "too slow to show yet";
  EXPECT_NEAR(share(1), 1.0, 0.03) << "an eighth of the Talbot distance";
}

TEST_F(ResponseStudy, EqualSeedsGiveEqualFilesWithAnyNumberOfThreads) {
  const Arguments more{"--detector.photons",   "1e7",      "--response.frequencies", "2,5",
                       "--response.distances", "20km,60km"};
  done("response", "one", joined(more, {"--threads", "1"}));
  done("response", "two", joined(more, {"--threads", "2"}));
  EXPECT_EQ(repeatable_summary("one"), repeatable_summary("two"));
  for (const char* file : {"/response.csv", "/response.svg", "/response-map-recovered.svg"}) {
    EXPECT_EQ(contents(std::string("one") + file), contents(std::string("two") + file)) << file;
  }
  const ProgramRun repeated = run({"response", "--config", "one/config.cfg", "--output", "again"});
  EXPECT_EQ(repeated.exit_code, 0) << repeated.errors;
  EXPECT_EQ(repeatable_summary("again"), repeatable_summary("one"));
}

TEST_F(ResponseStudy, AFrequencysFiguresAreItsOwn) {
  done("response", "many", {"--response.frequencies", "1,2.5,6"});
  done("response", "one", {"--response.frequencies", "2.5"});
  const Json many = response_of("many");
  const Json one = response_of("one");
  for (const auto& [figure, values] : one.items()) EXPECT_EQ(values[0], many[figure][1]) << figure;
}

TEST_F(ResponseStudy, AnotherSeedDrawsOtherSinusoids) {
  done("response", "one", {"--response.frequencies", "2.5"});
  done("response", "other", {"--response.frequencies", "2.5", "--screens.seed", "2"});
  EXPECT_NE(response_of("one")["recovered_share"], response_of("other")["recovered_share"]);
}

TEST_F(ResponseStudy, PairsAreDesignsOfTheirOwn) {
  const ProgramRun finished =
      done("response", "run",
           {"--response.distances", "20km:80km:3", "--response.frequencies", "1:5:3"});
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "report.html", "response-map-loops.png",
                          "response-map-loops.svg", "response-map-recovered.png",
                          "response-map-recovered.svg", "response-map-residual.png",
                          "response-map-residual.svg", "response.csv", "response.png",
                          "response.svg", "summary.json"));
  EXPECT_THAT(finished.output, HasSubstr("Pairs of planes at 3 distances"));
  EXPECT_EQ(line_count(contents("run/response.csv")), 1 + 4 * 3);
  EXPECT_THAT(contents("run/response.csv"), HasSubstr("\npair,50000,3,"));
  EXPECT_THAT(contents("run/response-map-recovered.svg"), HasSubstr("half the Talbot distance"));
  const Json pairs = summary("run")["pairs"];
  EXPECT_EQ(pairs["distances_m"], (Json{20e3, 50e3, 80e3}));
  ASSERT_EQ(pairs["responses"].size(), 3u);
  done("response", "alone", {"--sensor.planes=-50km,50km", "--response.frequencies", "1:5:3"});
  EXPECT_EQ(pairs["responses"][1], response_of("alone"));
}

TEST_F(ResponseStudy, TheNoiseIsThatOfThePhotons) {
  const ProgramRun finished = done("response", "many", with_photons);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("noise, nm"), HasSubstr("predicted")));
  const Json many = response_of("many");
  done("response", "few",
       {"--detector.photons", "1e5", "--screens.count", "16", "--response.frequencies", "2,5"});
  const Json few = response_of("few");
  for (std::size_t i = 0; i < 2; ++i) {
    const double predicted = many["predicted_amplitude_noise_nm"][i];
    EXPECT_NEAR(few["predicted_amplitude_noise_nm"][i], 10.0 * predicted, 1e-9);
    // What the loop converges to is no best estimate, but not far from one.
    for (const auto& [response, limit] :
         {std::pair{many, predicted}, std::pair{few, 10.0 * predicted}}) {
      const Json& noise = response["amplitude_noise_nm"][i];
      const double bound = 4.0 * double(noise["standard_error"]);
      EXPECT_GT(noise["standard_deviation"], limit - bound);
      EXPECT_LT(noise["standard_deviation"], 2.0 * limit + bound);
    }
  }
  EXPECT_THAT(contents("many/response.csv"), Not(HasSubstr(",,,\n")))
      << "a number in the columns of the noise";
}

TEST_F(ResponseStudy, OneWavefrontTellsNoSpread) {
  done("response", "run",
       {"--detector.photons", "1e6", "--screens.count", "1", "--response.frequencies", "2"});
  EXPECT_FALSE(response_of("run").contains("amplitude_noise_nm"));
  EXPECT_THAT(contents("run/response.csv"), EndsWith(",,,\n"));
}

}  // namespace
}  // namespace nlcwfs
