// Tests of the command trade, run as a user does.
#include "studies/settings/configuration.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;
using Json = nlohmann::json;

const std::vector<std::string> default_objectives{"total_wfe_nm", "model_seconds",
                                                  "detector_pixels", "plane_count"};

std::vector<double> means(const Json& design) {
  std::vector<double> values;
  for (const std::string& name : default_objectives) {
    values.push_back(design["objectives"].at(name).at("mean"));
  }
  return values;
}

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  return a != b && std::ranges::equal(a, b, std::ranges::less_equal());
}

std::size_t line_count(const std::string& path) {
  const std::string text = contents(path);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class TradeStudy : public Program {
 protected:
  static ProgramRun traded(const std::string& folder, const Arguments& more = {}) {
    Arguments arguments{"--trade.budget", "72"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return done("trade", folder, arguments);
  }
};

TEST_F(TradeStudy, LeavesItsFiles) {
  const ProgramRun finished = traded("run");
  EXPECT_THAT(names_in("run"),
              UnorderedElementsAreArray(with_closer_look(
                  {"archive.sqlite", "config.cfg", "report.html", "front.csv", "front.png",
                   "front.svg", "knee.cfg", "search.csv", "summary.json"})));
  EXPECT_THAT(finished.output,
              AllOf(StartsWith("0.5 m telescope at 532 nm, D/r0 = 4"),
                    HasSubstr("Tried 72 designs of 2 to 5 planes on 2 screens"),
                    HasSubstr("all that trade.budget allows"), HasSubstr("Front, on the fresh"),
                    HasSubstr("Best total_wfe_nm with plane_count of at most"),
                    HasSubstr("Knee (*)"), EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json["command"], "trade");
  EXPECT_EQ(json["objectives"], Json(default_objectives));
  EXPECT_EQ(json["evaluations"], 72);
  EXPECT_EQ(line_count("run/search.csv"), 73u);
  EXPECT_EQ(line_count("run/front.csv"), json["front"].size() + 1);
  EXPECT_EQ(json["reconstructions"], 72 * 2 + 2 * json["front"].size());
  for (const Json& design : json["front"]) {
    EXPECT_EQ(design["performance"]["screens"], 2);
    EXPECT_EQ(design["objectives"]["total_wfe_nm"], design["performance"]["total_wfe_nm"]);
    EXPECT_EQ(design["objectives"]["plane_count"]["mean"], design["planes_m"].size());
    const double width = 2.0 * double(design["pupil_pixels"]);
    EXPECT_EQ(design["objectives"]["detector_pixels"]["mean"],
              width * width * double(design["planes_m"].size()));
  }
}

TEST_F(TradeStudy, MarksTheDesignsThatAnotherBettersOnTheFreshScreens) {
  traded("run", {"--verify.screens", "8"});
  const Json front = summary("run")["front"];
  ASSERT_GE(front.size(), 4u);
  const auto betters = [&](const Json& one, const Json& other) {
    return dominates(means(one), means(other));
  };
  int dominated = 0;
  for (const Json& design : front) {
    const bool by_means =
        std::ranges::any_of(front, [&](const Json& other) { return betters(other, design); });
    // What chance may have done is a tie.
    EXPECT_EQ(bool(design["dominated"]) || !design["tied_with"].is_null(), by_means);
    EXPECT_FALSE(bool(design["dominated"]) && !design["tied_with"].is_null());
    if (!design["tied_with"].is_null()) {
      EXPECT_TRUE(betters(front.at(std::size_t(design["tied_with"])), design));
    }
    // Fewer planes or pixels are no chance.
    const bool is_clear = std::ranges::any_of(front, [&](const Json& other) {
      return betters(other, design) && (means(other)[2] < means(design)[2]);
    });
    EXPECT_TRUE(!is_clear || bool(design["dominated"]));
    dominated += bool(design["dominated"]) ? 1 : 0;
  }
  EXPECT_GT(dominated, 0) << "the test shows little";
}

TEST_F(TradeStudy, AggregatesItsObjectivesAsTheCostIs) {
  const ProgramRun finished =
      traded("run", {"--seeing.d_over_r0", "3,6", "--objective.aggregate", "worst",
                     "--trade.objectives", "total_wfe_nm,field_strehl,plane_count"});
  EXPECT_THAT(finished.output, HasSubstr("note: objectives are aggregated over the conditions as "
                                         "objective.aggregate = worst says"));
  const Json front = summary("run")["front"];
  ASSERT_FALSE(front.empty());
  for (const Json& design : front) {
    const auto of = [&](int condition, const char* metric) {
      return double(design["conditions"][std::size_t(condition)]["performance"][metric]["mean"]);
    };
    EXPECT_NEAR(design["objectives"]["total_wfe_nm"]["mean"],
                std::max(of(0, "total_wfe_nm"), of(1, "total_wfe_nm")), 1e-9);
    EXPECT_NEAR(design["objectives"]["field_strehl"]["mean"],
                std::min(of(0, "field_strehl"), of(1, "field_strehl")), 1e-12);
  }
}

TEST_F(TradeStudy, TheKneeAndTheBestsStandOnTheFront) {
  traded("run");
  const Json json = summary("run");
  const Json& front = json["front"];
  const Json& knee = front.at(std::size_t(json["knee"]));
  EXPECT_FALSE(knee["dominated"]);
  Configuration knee_configuration;
  knee_configuration.read_file("run/knee.cfg");
  EXPECT_EQ(Json(knee_configuration.lengths("sensor.planes")), knee["planes_m"]);
  EXPECT_EQ(knee_configuration.integer("detector.pupil_pixels"), knee["pupil_pixels"]);
  EXPECT_EQ(knee_configuration.integer("reconstruction.oversampling"), knee["oversampling"]);

  for (const char* objective : {"model_seconds", "detector_pixels", "plane_count"}) {
    const Json& bests = json["best_within"].at(objective);
    ASSERT_FALSE(bests.empty());
    for (const Json& best : bests) {
      const Json& chosen = front.at(std::size_t(best["design"]));
      for (const Json& other : front) {
        if (other["dominated"] || other["objectives"][objective]["mean"] > best["bound"]) continue;
        EXPECT_LE(chosen["objectives"]["total_wfe_nm"]["mean"],
                  other["objectives"]["total_wfe_nm"]["mean"]);
      }
    }
  }
  for (const Json& winner : json["best_of_planes_and_pixels"]) {
    const Json& chosen = front.at(std::size_t(winner["design"]));
    EXPECT_EQ(chosen["planes_m"].size(), winner["plane_count"]);
    EXPECT_EQ(chosen["pupil_pixels"], winner["pupil_pixels"]);
  }
}

TEST_F(TradeStudy, EqualSeedsGiveEqualFilesWithAnyNumberOfThreads) {
  for (const char* algorithm : {"nsga2", "nspso"}) {
    const std::string one = std::string(algorithm) + "-one";
    const std::string two = std::string(algorithm) + "-two";
    traded(one, {"--trade.algorithm", algorithm, "--threads", "1"});
    traded(two, {"--trade.algorithm", algorithm, "--threads", "2"});
    EXPECT_EQ(repeatable_summary(one), repeatable_summary(two));
    for (const char* file : {"/search.csv", "/front.csv", "/knee.cfg", "/config.cfg"}) {
      EXPECT_EQ(contents(one + file), contents(two + file)) << file;
    }
  }
  EXPECT_NE(contents("nsga2-one/search.csv"), contents("nspso-one/search.csv"));
}

TEST_F(TradeStudy, ItsConfigurationRepeatsIt) {
  traded("run");
  const ProgramRun repeated = run({"trade", "--config", "run/config.cfg", "--output", "again"});
  EXPECT_EQ(repeated.exit_code, 0) << repeated.errors;
  EXPECT_EQ(repeatable_summary("again"), repeatable_summary("run"));
  EXPECT_EQ(contents("again/config.cfg"), contents("run/config.cfg"));
}

TEST_F(TradeStudy, VerifiesSomeOfEachNumberOfPlanesAndPixels) {
  traded("all");
  traded("some", {"--trade.verified", "5"});
  const Json all = summary("all");
  const Json some = summary("some");
  EXPECT_EQ(some["front_of_search"], all["front_of_search"]);
  EXPECT_EQ(some["front"].size(), 5u);
  std::set<std::pair<std::size_t, int>> cells;
  for (const Json& design : some["front"]) {
    cells.emplace(design["planes_m"].size(), design["pupil_pixels"]);
  }
  EXPECT_EQ(cells.size(), 5u);
}

TEST_F(TradeStudy, TheHypervolumeIsAgainstTheReferencePoint) {
  // Two objectives, whose area can be added up.
  const Arguments two{"--trade.objectives", "total_wfe_nm,field_strehl"};
  const auto with = [&](const std::string& reference) {
    Arguments arguments = two;
    arguments.insert(arguments.end(), {"--trade.reference", reference});
    return arguments;
  };
  traded("run", with("200,0"));
  const Json json = summary("run");
  EXPECT_EQ(json["reference_point"], (Json{{"total_wfe_nm", 200.0}, {"field_strehl", 0.0}}));
  EXPECT_FALSE(json["reference_is_of_the_run"]);
  std::vector<std::pair<double, double>> points;
  for (const Json& design : json["front"]) {
    if (design["dominated"]) continue;
    points.emplace_back(design["objectives"]["total_wfe_nm"]["mean"],
                        design["objectives"]["field_strehl"]["mean"]);
  }
  std::ranges::sort(points);
  double area = 0.0;
  double strehl = 0.0;
  for (const auto& [wfe, better] : points) {
    if (wfe >= 200.0) continue;
    area += (200.0 - wfe) * (better - strehl);
    strehl = better;
  }
  EXPECT_GT(area, 0.0);
  EXPECT_NEAR(json["hypervolume"], area, 1e-9 * area);
  EXPECT_NEAR(json["hypervolume_fraction"], area / 200.0, 1e-9);

  traded("unset", two);
  EXPECT_TRUE(summary("unset")["reference_is_of_the_run"]);
  EXPECT_EQ(summary("unset")["reference_point"]["total_wfe_nm"], 133.0);
  traded("worthless", with("1,1"));
  EXPECT_EQ(summary("worthless")["hypervolume"], 0.0);
}

TEST_F(TradeStudy, TheReferencePointIsBeyondTheLargestDesignOfTheSpace) {
  traded("run", {"--detector.pupil_pixels", "16", "--search.pupil_pixels", "32,8",
                 "--search.reconstruction_oversampling", "2,1"});
  const Json json = summary("run");
  EXPECT_EQ(json["reference_point"]["detector_pixels"], 7.0 * 64.0 * 64.0);
  double slowest = 0.0;
  for (const Json& design : json["front"]) {
    const double seconds = design["objectives"]["model_seconds"]["mean"];
    EXPECT_LE(seconds, json["reference_point"]["model_seconds"]);
    slowest = std::max(slowest, seconds);
  }
  EXPECT_GT(slowest, 0.0);
}

TEST_F(TradeStudy, KeepsTheLimits) {
  const ProgramRun finished =
      traded("run", {"--objective.limits", "plane_count<3.5,total_wfe_nm<150"});
  const Json json = summary("run");
  for (const Json& design : json["front"]) {
    EXPECT_LE(design["planes_m"].size(), 3u);
    if (design["violation"] == 0.0) {
      EXPECT_LE(design["performance"]["total_wfe_nm"]["mean"], 150.0);
    } else {
      EXPECT_FALSE(design["dominated"]);
    }
  }
  EXPECT_EQ(json["front"][std::size_t(json["knee"])]["violation"], 0.0);

  const ProgramRun none = traded("none", {"--objective.limits", "total_wfe_nm<1e-3"});
  EXPECT_THAT(none.output, HasSubstr("no design was found that keeps objective.limits"));
  EXPECT_THAT(none.output, HasSubstr("there is no front.svg: there is no value to draw"));
  EXPECT_TRUE(summary("none")["front"].empty());
  EXPECT_TRUE(summary("none")["knee"].is_null());
  EXPECT_EQ(summary("none")["hypervolume"], 0.0);
  EXPECT_THAT(names_in("none"), Not(Contains("knee.cfg")));
}

TEST_F(TradeStudy, WithAMatchedTruthPixelsDoNotVary) {
  const ProgramRun finished = traded("run", {"--preset", "paper"});
  EXPECT_THAT(finished.output, HasSubstr("note: with simulation.truth = matched"));
  const Json front = summary("run")["front"];
  for (const Json& design : front) {
    EXPECT_EQ(design["pupil_pixels"], 16);
    EXPECT_EQ(design["oversampling"], 1);
  }
}

TEST_F(TradeStudy, AnInterruptedOneVerifiesTheFrontSoFar) {
  const ProgramRun finished =
      run({"trade", "--config", "tiny.cfg", "--output", "run", "--trade.budget", "1000000"},
          // In the foreground, or timeout signals the process and its group: twice.
          "timeout --foreground --preserve-status --signal INT 2 ");
  EXPECT_EQ(finished.exit_code, 3) << finished.errors;
  EXPECT_THAT(finished.output, HasSubstr("until it was interrupted"));
  const Json json = summary("run");
  EXPECT_EQ(json["termination"], "stop_requested");
  EXPECT_EQ(json["front"].size(),
            std::min(json["front_of_search"].get<std::size_t>(), std::size_t{24}));
  EXPECT_EQ(line_count("run/search.csv"), std::size_t(json["evaluations"]) + 1);
}

}  // namespace
}  // namespace nlcwfs
