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

using Advise = Program;

TEST_F(Advise, LeavesItsFiles) {
  const ProgramRun finished = done("advise", "run");
  EXPECT_THAT(names_in("run"), ElementsAre("advised.cfg", "archive.sqlite", "config.cfg",
                                           "law.json", "report.html", "summary.json"));
  EXPECT_THAT(finished.output, AllOf(HasSubstr("0.5 m telescope at 532 nm, D/r0 = 4"),
                                     HasSubstr("Fresnel number"), HasSubstr("residual WFE, nm"),
                                     HasSubstr("fractional loops"), Not(HasSubstr("simulated")),
                                     Not(HasSubstr("warning")), EndsWith("Results are in run.\n")));

  const LawFile law = parse_law_file(built_in_law_text(), "");
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "advise");
  EXPECT_EQ(json.at("design").at("planes_m"), law.law.planes({}, 0.125));
  EXPECT_EQ(json["design"].at("pupil_pixels"), 16);
  EXPECT_FALSE(json["design"].contains("performance"));
  const MeanAndError wfe = law.law.residual_wfe.predict(4.0);
  const Json& predicted = json.at("predicted");
  EXPECT_EQ(predicted.at("extrapolated"), false);
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
  done("advise", "first");
  done("advise", "again", {"--advise.law", "first/law.json"});
  EXPECT_EQ(contents("first/law.json"), contents("again/law.json"));
  for (const char* part : {"design", "predicted", "law"}) {
    EXPECT_EQ(summary("first")[part], summary("again")[part]);
  }
}

TEST_F(Advise, SaysWhereItExtrapolates) {
  const ProgramRun finished = done("advise", "run", {"--seeing.d_over_r0", "40"});
  EXPECT_THAT(finished.output, HasSubstr("warning: D/r0 = 40 is outside that range"));
  EXPECT_EQ(summary("run")["predicted"]["extrapolated"], true);
}

TEST_F(Advise, NotesWhatTheLawsDesignsHaveOtherwise) {
  // tiny.cfg has other detectors and truths than the built-in law.
  done("advise", "run");
  nlohmann::ordered_json law = nlohmann::ordered_json::parse(contents("run/law.json"));
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
  const ProgramRun finished = done("advise", "run", {"--verify"});
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
