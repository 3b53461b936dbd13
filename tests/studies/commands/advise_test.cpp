// Tests of the command advise, run as a user does.
#include "studies/settings/law_file.hpp"
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

/// With law.json, whose designs have tiny.cfg's detector and truth.
class Advise : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    done("advise", "first");
    nlohmann::ordered_json law = nlohmann::ordered_json::parse(contents("first/law.json"));
    law["conditions"] = {{"detector.pupil_pixels", "16"},
                         {"detector.window", "2"},
                         {"reconstruction.window", "4"},
                         {"simulation.pupil_samples", "32"}};
    std::ofstream("law.json") << law;
  }
};

TEST_F(Advise, LeavesItsFiles) {
  const ProgramRun finished = done("advise", "run", {"--advise.law", "law.json"});
  EXPECT_THAT(names_in("run"), ElementsAre("advised.cfg", "archive.sqlite", "config.cfg",
                                           "law.json", "report.html", "summary.json"));
  EXPECT_THAT(finished.output, AllOf(HasSubstr("0.5 m telescope at 532 nm, D/r0 = 4"),
                                     HasSubstr("Fresnel number"), HasSubstr("residual WFE, nm"),
                                     HasSubstr("fractional loops"), Not(HasSubstr("simulated")),
                                     Not(HasSubstr("note:")), EndsWith("Results are in run.\n")));

  const LawFile law = parse_law_file(built_in_law_text(), "");
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "advise");
  EXPECT_EQ(json.at("design").at("planes_m"), law.law.planes({}, 0.125));
  EXPECT_EQ(json["design"].at("pupil_pixels"), 16);
  EXPECT_FALSE(json["design"].contains("performance"));
  const MeanAndError wfe = law.law.residual_wfe.predict(4.0);
  const Json& predicted = json.at("predicted");
  EXPECT_EQ(predicted.at("extrapolated"), false);
  EXPECT_TRUE(predicted.at("reasons_for_none").empty());
  EXPECT_NEAR(predicted.at("residual_wfe_nm").at("mean"), 532.0 * wfe.mean, 1e-9);
  EXPECT_NEAR(predicted["residual_wfe_nm"].at("standard_error"), 532.0 * wfe.standard_error, 1e-9);
  EXPECT_GT(predicted["residual_wfe_nm"]["standard_error"], 0.0);
  const MeanAndError near = law.law.z_near_talbot.predict(4.0);
  EXPECT_EQ(predicted.at("z_near_talbot").at("mean"), near.mean);
  EXPECT_EQ(predicted["z_near_talbot"].at("standard_error"), near.standard_error);
  const auto least_size = [](const Json& values) {
    double least = HUGE_VAL;
    for (const double value : values) least = std::min(least, std::abs(value));
    return least;
  };
  EXPECT_NEAR(least_size(json["design"]["planes_talbot"]), near.mean, 1e-9);
  EXPECT_NEAR(least_size(json["design"]["fresnel_numbers"]),
              predicted.at("far_fresnel_number").at("mean"), 1e-9);
  EXPECT_EQ(predicted.at("fractional_loops").at("mean"),
            law.law.fractional_loops.predict(4.0).mean);
  EXPECT_EQ(json.at("law"), Json(to_json(law.law)));
  EXPECT_FALSE(json.contains("difference"));
}

TEST_F(Advise, ItsConfigurationIsThatOfTheDesign) {
  done("advise", "run", {"--telescope.diameter", "8.2m"});
  const ProgramRun moved =
      run({"scale", "--config", "run/advised.cfg", "--scale.diameter", "0.5m", "--output", "back"});
  ASSERT_EQ(moved.exit_code, 0) << moved.errors;
  EXPECT_EQ(summary("back")["design"]["planes_m"], summary("run")["design"]["planes_m"]);
  done("advise", "small");
  for (std::size_t plane = 0; plane < 4; ++plane) {
    EXPECT_NEAR(summary("back")["scaled"]["planes_m"][plane],
                summary("small")["design"]["planes_m"][plane], 1e-6);
  }
}

TEST_F(Advise, TheLawThatARunLeavesGivesTheSameAdvice) {
  done("advise", "again", {"--advise.law", "first/law.json"});
  EXPECT_EQ(contents("first/law.json"), contents("again/law.json"));
  for (const char* part : {"design", "predicted", "law"}) {
    EXPECT_EQ(summary("first")[part], summary("again")[part]);
  }
}

TEST_F(Advise, PredictsNothingOfWhatItsLawDoesNotCover) {
  const std::vector<std::pair<Arguments, std::string>> cases{
      {{"--seeing.d_over_r0", "40"}, "D/r0 is 40, where the law's designs have 3 to 10"},
      {{"--detector.photons", "2e4"}, "detector.photons is 20000"},
      {{"--detector.photons", "2e4", "--detector.read_noise", "1.5"}, "detector.read_noise is 1.5"},
      {{"--telescope.central_obscuration", "0.12"}, "telescope.central_obscuration is 0.12"},
      {{"--detector.pupil_pixels", "8"}, "detector.pupil_pixels is 8"},
      {{"--source.bands", "500nm:564nm"}, "source.bands is 500nm:564nm"},
      {{"--reconstruction.relaxation", "0.5"}, "reconstruction.relaxation is 0.5"}};
  for (const auto& [settings, reason] : cases) {
    Arguments arguments{"--advise.law", "law.json"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    std::filesystem::remove_all("run");
    EXPECT_THAT(done("advise", "run", arguments).output,
                AllOf(HasSubstr("What it reaches is not predicted"), HasSubstr("note: " + reason),
                      HasSubstr("--verify"), Not(HasSubstr("residual WFE"))))
        << reason;
    const Json predicted = summary("run")["predicted"];
    EXPECT_THAT(predicted["reasons_for_none"].dump(), HasSubstr(reason));
    EXPECT_FALSE(predicted.contains("residual_wfe_nm"));
    EXPECT_THAT(contents("run/report.html"), HasSubstr("What it reaches is not predicted: "));
  }
}

TEST_F(Advise, SimulatesWhatItDoesNotPredict) {
  EXPECT_THAT(done("advise", "run", {"--verify"}).output,
              AllOf(HasSubstr("What it reaches is not predicted"), HasSubstr("On 2 fresh screens"),
                    HasSubstr("residual WFE, nm"), Not(HasSubstr("standard errors"))));
  EXPECT_FALSE(summary("run").contains("difference"));
  EXPECT_EQ(summary("run")["design"]["performance"]["screens"], 2);
}

TEST_F(Advise, NotesWhatTheLawsDesignsHaveOtherwise) {
  nlohmann::ordered_json law = nlohmann::ordered_json::parse(contents("law.json"));
  law["conditions"] = {{"detector.pupil_pixels", "16"},     {"detector.window", "2"},
                       {"reconstruction.window", "4.0"},    {"simulation.pupil_samples", "32"},
                       {"reconstruction.tolerance", "2nm"}, {"seeing.outer_scale", "10m"},
                       {"objective.wfe_scale", "20nm"},     {"telescope.wavelength", "1064nm"},
                       {"telescope.diameter", "1m"},        {"reconstruction.relaxation", "0.5"}};
  std::ofstream("law.json") << law;
  const auto notes = [](const std::string& folder, const Arguments& more) {
    Arguments arguments{"--advise.law", "law.json", "--reconstruction.relaxation", "0.5:0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string output = done("advise", folder, arguments).output;
    return output.substr(0, output.find("0.5 m telescope"));
  };
  // The outer scale in diameters and the optical path in wavelengths are those of the law.
  EXPECT_EQ(notes("equal", {"--seeing.outer_scale", "500cm"}), "");
  EXPECT_EQ(notes("other", {"--reconstruction.tolerance", "2nm", "--detector.photons", "1e5"}),
            "note: seeing.outer_scale is not set, where the law's designs have 5 m at this "
            "telescope\n"
            "note: detector.photons is 100000, where the law's designs have no photon noise\n"
            "note: reconstruction.tolerance is 2 nm, where the law's designs have 1 nm at this "
            "telescope\n");
}

TEST_F(Advise, VerifyingSimulatesWhatIsPredicted) {
  const ProgramRun finished = done("advise", "run", {"--verify", "--advise.law", "law.json"});
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("on 2 fresh screens"), HasSubstr("predicted"), HasSubstr("simulated"),
                    HasSubstr("standard errors)"), HasSubstr("light captured")));
  const Json json = summary("run");
  const Json& performance = json.at("design").at("performance");
  EXPECT_EQ(performance.at("screens"), 2);
  for (const char* metric : {"residual_wfe_nm", "fractional_loops"}) {
    const Json& predicted = json["predicted"].at(metric);
    const Json& simulated = performance.at(metric);
    const Json& difference = json.at("difference").at(metric);
    EXPECT_NEAR(difference.at("mean"), double(simulated["mean"]) - double(predicted["mean"]), 1e-9);
    EXPECT_NEAR(
        difference.at("standard_error"),
        std::hypot(double(simulated["standard_error"]), double(predicted["standard_error"])), 1e-9);
    EXPECT_NEAR(difference.at("standard_errors"),
                double(difference["mean"]) / double(difference["standard_error"]), 1e-9);
  }

  // On the verification's screens and twice as fine truth.
  const ProgramRun again = run({"evaluate", "--config", "run/advised.cfg", "--output", "again",
                                "--screens.seed", "1000003", "--simulation.pupil_samples", "64"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(repeatable_summary("again")["design"]["performance"],
            repeatable_summary("run")["design"]["performance"]);
}

TEST_F(Advise, RefusesBadInputInOneLine) {
  const auto expect_refused = [](const Arguments& more, const std::string& start) {
    Arguments arguments{"advise", "--config", "tiny.cfg", "--output", "run"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.output, "");
    EXPECT_THAT(refused.errors, StartsWith("nlcwfs: " + start));
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
    EXPECT_FALSE(std::filesystem::exists("run"));
  };
  expect_refused({"--advise.law", "missing.json"}, "advise.law = missing.json: cannot be read (");
  std::ofstream("empty.json") << "{}";
  expect_refused({"--advise.law", "empty.json"},
                 "advise.law = empty.json: is no law file; give the law.json that a run of law");
  expect_refused({"--seeing.d_over_r0", "10000"},
                 "seeing.d_over_r0 = 10000: too far from the law's designs");
  expect_refused({"--seeing.d_over_r0", "0.01"},
                 "seeing.d_over_r0 = 0.01: too far from the law's designs");
  expect_refused({"--detector.pupil_pixels", "15"}, "detector.pupil_pixels = 15: ");
  expect_refused({"--verify", "--verify.seed", "1"}, "verify.seed = 1: another seed");
  expect_refused({"--verify", "--simulation.pupil_samples", "20"},
                 "verify.truth_factor = 2: the finer truth does not suit the design: ");
}

}  // namespace
}  // namespace nlcwfs
