// Tests of law: the scaling law of the best designs at several seeings.
#include "studies/settings/law_file.hpp"
#include "tests/studies/program.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;

using Law = Program;

TEST_F(Law, IsFittedToTheBestDesignsAndFollowedByAdvise) {
  const ProgramRun finished = done("law", "run", {"--law.d_over_r0", "2,3,4,5"});
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("D/r0 = 5:"), HasSubstr("nlcwfs advise --advise.law run/law.json"),
                    EndsWith("Results are in run.\n")));
  const LawFile file = read_law_file("run/law.json");
  ASSERT_EQ(file.data.size(), 4u);
  EXPECT_EQ(file.law.least_d_over_r0, 2.0);
  EXPECT_EQ(file.law.greatest_d_over_r0, 5.0);
  EXPECT_EQ(file.law.order, (std::array{3, 4, 1, 2}));
  EXPECT_EQ(file.conditions.value_text("detector.pupil_pixels"), "16");
  EXPECT_EQ(file.conditions.value_text("search.order"), "3412");

  // The data are the designs of the summary.
  const auto summary = nlohmann::json::parse(contents("run/summary.json"));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& design = summary.at("designs").at(i);
    double near = HUGE_VAL;
    for (const double z : design.at("planes_talbot")) near = std::min(near, std::abs(z));
    EXPECT_NEAR(file.data[i].z_near_talbot.mean, near, 1e-9 * near);
    EXPECT_GT(file.data[i].z_near_talbot.standard_error, 0.0);
    EXPECT_NEAR(file.data[i].residual_wfe.mean * 532.0,
                design.at("performance").at("residual_wfe_nm").at("mean"), 1e-9);
  }
  const ProgramRun advice = done("advise", "advice", {"--advise.law", "run/law.json"});
  EXPECT_THAT(advice.output, HasSubstr("By the law of 4 searches, D/r0 = 2 to 5"));
}

TEST_F(Law, AnInterruptedOneKeepsWhatIsDone) {
  const ProgramRun stopped =
      run({"law", "--config", "tiny.cfg", "--output", "run", "--search.budget", "1000000",
           "--law.d_over_r0", "3,4,5,6,8,10"},
          // In the foreground, or timeout signals the process and its group: twice.
          "timeout --foreground --preserve-status --signal INT 2 ");
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_THAT(stopped.errors,
              ContainsRegex("nlcwfs: interrupted: 0 of 6 seeings were done, and a law needs 4; at "
                            "D/r0 = [0-9.]+ [^;]*; go on with: nlcwfs law --resume run\n$"));
}

TEST_F(Law, RefusesBadInputInOneLine) {
  const auto refused = [](const Arguments& more) {
    Arguments arguments{"law", "--config", "tiny.cfg", "--output", "run"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << finished.output;
    EXPECT_FALSE(std::filesystem::exists("run"));
    return finished.errors;
  };
  EXPECT_THAT(refused({"--search.order", "3412,1234"}), HasSubstr("search.order = 3412,1234"));
  EXPECT_THAT(refused({"--law.d_over_r0", "4,5"}),
              HasSubstr("law.d_over_r0 = 4,5: at least 4 different values"));
  EXPECT_THAT(refused({"--law.d_over_r0", "4,4.01,4.02,4.03"}),
              HasSubstr("that reach over a factor of 1.1"));
  EXPECT_THAT(refused({"--search.layout", "free"}), HasSubstr("search.layout = free: symmetric"));
  EXPECT_THAT(refused({"--search.plane_count", "3,4"}), HasSubstr("search.plane_count = 3,4: 4"));
  EXPECT_THAT(refused({"--search.z_near", "20km"}), HasSubstr("search.z_near = 20km: a range"));
  EXPECT_THAT(refused({"--search.z_far", "90km,120km"}), HasSubstr("a range that the law's"));
  EXPECT_THAT(refused({"--detector.photons", "1e4,1e5"}), HasSubstr("detector.photons"));
}

}  // namespace
}  // namespace nlcwfs
