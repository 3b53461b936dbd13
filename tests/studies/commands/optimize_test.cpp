// Tests of the command optimize, run as a user does.
#include "studies/settings/setup.hpp"
#include "tests/studies/run_results.hpp"

#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;
using Json = nlohmann::json;

using Optimize = Program;

TEST_F(Optimize, VariesWhatItIsTold) {
  const ProgramRun finished =
      done("optimize", "run",
           {"--search.layout", "free", "--search.plane_count", "3,4",
            "--search.relaxation=-0.3:0.7", "--search.initial_guess", "flat,centroid",
            "--search.pupil_pixels", "8,16", "--search.budget", "40"});
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("  with pupil_pixels "), HasSubstr("initial_guess ")));
  const auto table = read_table("run/search.csv");
  const auto column = [&](const std::string& name) {
    const auto place = std::ranges::find(table[0], name) - table[0].begin();
    std::set<std::string> values;
    for (std::size_t row = 1; row < table.size(); ++row) {
      values.insert(table[row].at(static_cast<std::size_t>(place)));
    }
    return values;
  };
  EXPECT_THAT(column("pupil_pixels"), ElementsAre("16", "8"));
  EXPECT_THAT(column("initial_guess"), ElementsAre("0", "1"));
  EXPECT_GT(column("relaxation").size(), 10u);
  EXPECT_EQ(column("tolerance_m").size(), 1u);

  // The best design's configuration is the best design.
  const Json best = summary("run")["best"];
  const SensorDesign design = [] {
    Configuration configuration;
    configuration.read_file("run/best.cfg");
    return design_of(configuration);
  }();
  EXPECT_EQ(design.planes, best["planes_m"].get<std::vector<double>>());
  EXPECT_EQ(design.detector.pupil_pixels, best["pupil_pixels"]);
  EXPECT_EQ(design.reconstruction.relaxation_start, best["relaxation"][0]);
  EXPECT_EQ(design.reconstruction.relaxation_end, best["relaxation"][1]);
}

TEST_F(Optimize, EndsWhereItIsTold) {
  const auto ended = [](const std::string& folder, const Arguments& more) {
    const ProgramRun finished = done("optimize", folder, more);
    return std::pair(finished.output, summary(folder));
  };
  const auto [target_text, target] =
      ended("target", {"--search.target", "1000", "--search.budget", "50"});
  EXPECT_EQ(target["termination"], "target_reached");
  EXPECT_LT(target["evaluations"], 10);
  EXPECT_THAT(target_text, HasSubstr("until search.target was reached"));
  const auto [stagnation_text, stagnation] =
      ended("stagnation", {"--search.stagnation", "3", "--search.budget", "500"});
  EXPECT_EQ(stagnation["termination"], "stagnated");
  EXPECT_LT(stagnation["evaluations"], 500);
  EXPECT_THAT(stagnation_text, HasSubstr("until search.stagnation designs in a row"));
  const auto [time_text, time] =
      ended("time", {"--search.time_limit", "1ms", "--search.budget", "100000"});
  EXPECT_EQ(time["termination"], "time_limit");
  EXPECT_THAT(time_text, HasSubstr("until search.time_limit"));
}

TEST_F(Optimize, ACheapSearchOnlyGivesStarts) {
  const ProgramRun finished =
      done("optimize", "run",
           {"--search.cheap_budget", "12", "--search.cheap_screens", "1", "--search.budget", "8"});
  EXPECT_THAT(finished.output, HasSubstr("before that 12 in the cheap search"));
  const Json json = summary("run");
  EXPECT_EQ(json["cheap_evaluations"], 12);
  EXPECT_EQ(json["evaluations"], 8);
  EXPECT_EQ(json["search_reconstructions"], 12 * 1 + 8 * 2);
  EXPECT_EQ(archived("run", "SELECT count(*) FROM evaluations WHERE stage = 'cheap search'"), 12.0);
  // Its best design is the full search's first.
  EXPECT_EQ(archived("run",
                     "SELECT count(*) FROM evaluations a, evaluations b WHERE a.stage = 'search' "
                     "AND b.stage = 'cheap search' AND json_extract(a.design, '$.planes_m') = "
                     "json_extract(b.design, '$.planes_m') AND b.cost = (SELECT min(cost) FROM "
                     "evaluations WHERE stage = 'cheap search') AND a.id = 13"),
            1.0);
  EXPECT_EQ(std::ranges::count(contents("run/search.csv"), '\n'), 1 + 8);
}

TEST_F(Optimize, TheTimeLimitIsThatOfBothSearches) {
  const ProgramRun finished = done("optimize", "run",
                                   {"--search.cheap_budget", "100000", "--search.budget", "100000",
                                    "--search.time_limit", "10ms"});
  const Json json = summary("run");
  EXPECT_EQ(json["termination"], "time_limit");
  EXPECT_GE(json["cheap_evaluations"], 1);
  EXPECT_EQ(json["evaluations"], 1);
}

TEST_F(Optimize, ACheapSearchDoesNotEndAtTheTarget) {
  done("optimize", "run", {"--search.cheap_budget", "9", "--search.target", "1000"});
  const Json json = summary("run");
  EXPECT_EQ(json["cheap_evaluations"], 9);
  EXPECT_EQ(json["termination"], "target_reached");
}

TEST_F(Optimize, AnyCheapWindowIsRoundedToOneThatTheGridCanHave) {
  done("optimize", "run", {"--search.cheap_budget", "6", "--search.cheap_window", "0.53"});
  EXPECT_EQ(archived("run",
                     "SELECT count(*) FROM evaluations WHERE stage = 'cheap search' AND "
                     "json_extract(design, '$.reconstruction_window') = 2.25"),
            6.0);
}

TEST_F(Optimize, AnInterruptInTheCheapSearchLeavesACompleteResult) {
  const ProgramRun finished = run(
      {"optimize", "--config", "tiny.cfg", "--output", "run", "--search.cheap_budget", "1000000"},
      "timeout --foreground --preserve-status --signal INT 2 ");
  EXPECT_EQ(finished.exit_code, 3) << finished.errors;
  EXPECT_THAT(finished.output, HasSubstr("how far each variable may move is not known"));
  const Json json = summary("run");
  EXPECT_EQ(json["termination"], "stop_requested");
  EXPECT_EQ(json["evaluations"], 1);
  EXPECT_EQ(json["best"]["performance"]["screens"], 2);
}

TEST_F(Optimize, RacesSaveReconstructionsAndKeepTheWinner) {
  const Arguments more{"--screens.count", "16", "--search.budget", "30"};
  const auto optimized = [&](const std::string& folder, const std::string& race) {
    Arguments arguments = more;
    arguments.insert(arguments.end(), {"--search.race", race});
    done("optimize", folder, arguments);
    return summary(folder);
  };
  const Json all = optimized("all", "0");
  const Json raced = optimized("raced", "0.05");
  EXPECT_EQ(all["given_up"], 0);
  EXPECT_EQ(all["search_reconstructions"], 30 * 16);
  EXPECT_GT(raced["given_up"], 0);
  EXPECT_LT(raced["search_reconstructions"], 30 * 16);
  EXPECT_EQ(raced["saved_reconstructions"], 30 * 16 - raced["search_reconstructions"].get<int>());
  EXPECT_EQ(all["saved_reconstructions"], 0);
  EXPECT_EQ(raced["best"]["planes_m"], all["best"]["planes_m"]);
}

TEST_F(Optimize, AnInterruptedOptimizeVerifiesTheBestSoFar) {
  for (const char* signal : {"INT", "TERM"}) {
    const ProgramRun finished =
        run({"optimize", "--config", "tiny.cfg", "--output", signal, "--search.budget", "1000000"},
            // In the foreground, or timeout signals the process and its group: twice.
            fmt::format("timeout --foreground --preserve-status --signal {} 2 ", signal));
    EXPECT_EQ(finished.exit_code, 3) << finished.errors;
    EXPECT_THAT(finished.output, HasSubstr("until it was interrupted"));
    const Json json = summary(signal);
    EXPECT_EQ(json["termination"], "stop_requested");
    EXPECT_EQ(json["best"]["performance"]["screens"], 2);
    EXPECT_EQ(archived(signal, "SELECT count(*) FROM evaluations WHERE stage = 'search'"),
              json["evaluations"]);
  }
}

TEST_F(Optimize, SaysWhereTheBaselineIsNotBeaten) {
  // The only design that is tried is the baseline itself.
  const ProgramRun finished =
      done("optimize", "run", {"--sensor.planes=-47km,47km,-180km,180km", "--search.budget", "1"});
  EXPECT_THAT(finished.output, HasSubstr("The baseline is NOT beaten"));
  EXPECT_EQ(summary("run")["improvement"]["cost"], 0.0);
}

TEST_F(Optimize, LeavesItsFiles) {
  const ProgramRun finished = done("optimize", "run");
  EXPECT_THAT(names_in("run"), UnorderedElementsAreArray(with_closer_look(
                                   {"archive.sqlite", "best.cfg", "config.cfg", "report.html",
                                    "search.csv", "search.png", "search.svg", "sensitivity.csv",
                                    "sensitivity.png", "sensitivity.svg", "summary.json"})));
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("6 designs on 2 screens"), HasSubstr("2 fresh screens"),
                    HasSubstr("aseline"), EndsWith("Results are in run.\n")));

  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "optimize");
  expect_design_of_the_contract(json.at("best"));
  expect_design_of_the_contract(json.at("baseline"));
  EXPECT_EQ(json["baseline"]["planes_m"], (Json{-47e3, 47e3, -180e3, 180e3}));
  EXPECT_EQ(json.at("evaluations"), 6);
  // Three designs and the baseline, and a scan on 8 screens: the best, and at least one step on
  // each side of each variable.
  const int scanned = json.at("reconstructions").get<int>() - (6 * 2 + 4 * 2);
  EXPECT_GE(scanned, (1 + 2 * 2) * 8);
  EXPECT_EQ(scanned % 8, 0);
  EXPECT_EQ(json.at("search_reconstructions"), 6 * 2);
  EXPECT_GT(json.at("wall_seconds"), 0.0);
  EXPECT_NEAR(json.at("improvement").at("cost"),
              double(json["baseline"]["cost"]["mean"]) - double(json["best"]["cost"]["mean"]),
              1e-9);
  EXPECT_GE(json["improvement"].at("standard_error"), 0.0);

  EXPECT_EQ(archived("run", "SELECT count(*) FROM evaluations WHERE stage = 'search'"), 6.0);
  EXPECT_EQ(archived("run", "SELECT count(*) FROM evaluations WHERE stage = 'verify'"), 4.0);
  const Json& ranking = json.at("ranking");
  ASSERT_EQ(ranking.size(), 3u);
  EXPECT_EQ(ranking[0].at("verdict"), "best");
  EXPECT_EQ(ranking[0]["cost"], json["best"]["cost"]);
  EXPECT_EQ(ranking[0].at("cost_above_best").at("mean"), 0.0);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_NEAR(ranking[i]["cost_above_best"]["mean"],
                double(ranking[i]["cost"]["mean"]) - double(ranking[0]["cost"]["mean"]), 1e-9);
    EXPECT_GE(ranking[i]["cost_above_best"]["mean"], 0.0);
    EXPECT_THAT(ranking[i]["verdict"], testing::AnyOf(Json("tied"), Json("worse")));
  }
  for (const char* variable : {"z_near", "z_far"}) {
    const Json& range = json.at("indistinguishable").at(variable);
    EXPECT_LE(range.at("least"), range.at("best"));
    EXPECT_GE(range.at("greatest"), range.at("best"));
  }
  const std::string table = contents("run/search.csv");
  EXPECT_THAT(table, StartsWith("evaluation,planes_m,pupil_pixels,"));
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 6);
}

TEST_F(Optimize, TheBestConfigurationEvaluatesToWhatWasVerified) {
  done("optimize", "run", {"--detector.photons", "1e6"});
  // The verification's screens, noise and twice as fine truth.
  const ProgramRun again = run({"evaluate", "--config", "run/best.cfg", "--output", "again",
                                "--screens.seed", "1000003", "--simulation.pupil_samples", "64"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  const Json verified = repeatable_summary("run")["best"];
  const Json evaluated = repeatable_summary("again")["design"];
  EXPECT_EQ(verified["planes_m"], evaluated["planes_m"]);
  EXPECT_EQ(verified["cost"], evaluated["cost"]);
  EXPECT_EQ(verified["performance"], evaluated["performance"]);
}

TEST_F(Optimize, SearchesFreeLayoutsOfAnyPlaneCount) {
  done("optimize", "run",
       {"--search.layout", "free", "--search.plane_count", "3", "--search.z2", "5km:50km",
        "--detector.photons", "1e5", "--sensor.planes", "-60km,20km,60km"});
  const Json best = summary("run").at("best");
  EXPECT_EQ(best["planes_m"].size(), 3u);
  EXPECT_GE(best["planes_m"][1], 5e3 - 1e-6);
  EXPECT_LE(best["planes_m"][1], 50e3 + 1e-6);
  EXPECT_THAT(contents("run/search.csv"), HasSubstr("1,\"-60000,20000,60000\","))
      << "the user's own design is tried first";
}

TEST_F(Optimize, ADesignIsFoundForSeveralConditions) {
  const ProgramRun finished =
      done("optimize", "run",
           {"--seeing.d_over_r0", "3,6", "--detector.photons", "1e5,1e6", "--objective.aggregate",
            "worst", "--objective.limits", "total_wfe_nm<1", "--verify.screens", "4"});
  EXPECT_THAT(finished.output, AllOf(HasSubstr("\n  under each condition "),
                                     HasSubstr("\n  D/r0 = 6, 1e+06 photons ")));
  const Json json = summary("run");
  const int scanned = json["reconstructions"].get<int>() - (6 * 2 + 4 * 4) * 4;
  EXPECT_GE(scanned, (1 + 2 * 2) * 8 * 4);
  EXPECT_EQ(scanned % (8 * 4), 0);
  for (const char* name : {"best", "baseline"}) {
    const Json& design = json[name];
    const Json& conditions = design.at("conditions");
    ASSERT_EQ(conditions.size(), 4u);
    EXPECT_EQ(conditions[1]["photons"], 1e6);
    EXPECT_NEAR(conditions[2]["d_over_r0"], 6.0, 1e-12);
    EXPECT_GT(design["violation"], 1.0);
    EXPECT_EQ(design["performance"]["screens"], 16);
    double mean = 0.0;
    for (const Json& condition : conditions) {
      EXPECT_EQ(condition["performance"]["screens"], 4);
      mean += double(condition["performance"]["residual_wfe_nm"]["mean"]) / 4.0;
    }
    EXPECT_NEAR(design["performance"]["residual_wfe_nm"]["mean"], mean, 1e-9 * mean);
    // Of residual WFE / 10 nm + 0.1 x loops under the worst condition.
    double worst = 0.0;
    for (const Json& condition : conditions) {
      const Json& performance = condition["performance"];
      worst = std::max(worst, double(performance["residual_wfe_nm"]["mean"]) / 10.0 +
                                  0.1 * double(performance["fractional_loops"]["mean"]));
    }
    EXPECT_NEAR(design["cost"]["mean"], worst, 1e-9 * worst);
  }
}

TEST_F(Optimize, TheObjectiveMayBeTheErrorBudget) {
  done("evaluate", "run",
       {"--objective.kind", "error_budget", "--objective.wind_speed", "10",
        "--objective.time_per_loop", "1us", "--detector.exposure", "1us"});
  const Json design = summary("run")["design"];
  // In microseconds the turbulence hardly changes.
  const double total = design["performance"]["total_wfe_nm"]["mean"];
  EXPECT_GT(design["cost"]["mean"], total);
  EXPECT_NEAR(double(design["cost"]["mean"]) / total, 1.0, 1e-3);
  EXPECT_FALSE(design.contains("conditions"));
  EXPECT_EQ(design["violation"], 0.0);
}

TEST_F(Optimize, OfDesignsThatDoNotWorkNoneBeatsAnother) {
  EXPECT_THAT(done("optimize", "run", {"--seeing.d_over_r0", "40"}).output,
              AllOf(HasSubstr("This design does not work as a sensor"), Not(HasSubstr("beat"))));
  EXPECT_THAT(contents("run/report.html"),
              Not(HasSubstr("The best design beats the baseline: it costs")));
  EXPECT_FALSE(summary("run")["best"]["futility"].is_null());
}

}  // namespace
}  // namespace nlcwfs
