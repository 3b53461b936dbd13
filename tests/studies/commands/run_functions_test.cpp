#include "results/fits/fits_cube.hpp"
#include "studies/commands/commands.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/setup.hpp"
#include "tests/studies/program.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <sqlite3.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;
using Json = nlohmann::json;

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

/// The rows of a table, its header first; cells in quotes come as "quoted".
std::vector<std::vector<std::string>> read_table(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(contents(path));
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::istringstream cells(std::regex_replace(line, std::regex(R"("[^"]*")"), "quoted"));
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// The one number that a query of an archive gives.
double archived(const std::string& folder, const std::string& sql) {
  sqlite3* opened = nullptr;
  EXPECT_EQ(sqlite3_open((folder + "/archive.sqlite").c_str(), &opened), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, sqlite3_close);
  sqlite3_stmt* prepared = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(opened, sql.c_str(), -1, &prepared, nullptr), SQLITE_OK);
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(prepared,
                                                                             sqlite3_finalize);
  EXPECT_EQ(sqlite3_step(prepared), SQLITE_ROW) << sqlite3_errmsg(opened);
  return sqlite3_column_double(prepared, 0);
}

/// What every design of a summary has, with its performance.
void expect_design_of_the_contract(const Json& design) {
  EXPECT_THAT(keys_of(design),
              IsSupersetOf({"planes_m", "planes_talbot", "fresnel_numbers", "pupil_pixels",
                            "detector_window", "photons", "cost", "performance"}));
  EXPECT_THAT(keys_of(design.at("performance")),
              IsSupersetOf({"residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl",
                            "loops", "fractional_loops", "seconds", "fft_count", "captured_energy",
                            "converged_fraction", "screens"}));
  EXPECT_EQ(design["performance"]["captured_energy"].size(), design["planes_m"].size());
}

void expect_same_performance(const Json& actual, const Json& expected, double tolerance) {
  for (const char* metric : {"residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl",
                             "fractional_loops", "loops", "fft_count"}) {
    for (const char* part : {"mean", "standard_error"}) {
      const double value = expected.at(metric).at(part);
      EXPECT_NEAR(actual.at(metric).at(part), value, tolerance * std::abs(value))
          << metric << ' ' << part;
    }
  }
  EXPECT_EQ(actual.at("screens"), expected.at("screens"));
  EXPECT_EQ(actual.at("converged_fraction"), expected.at("converged_fraction"));
}

/// Not those that need more than a configuration (a folder, frames), print no results, or take no
/// other telescope or sweep than the paper's.
bool runs_on_the_tiny_configuration(const Command& command) {
  const std::set<std::string> others{"manual", "reconstruct", "reproduce"};
  return command.arguments.empty() && !others.contains(command.name);
}

using Studies = Program;

TEST_F(Studies, EvaluateLeavesItsFiles) {
  const ProgramRun finished = done("evaluate", "run");
  EXPECT_THAT(names_in("run"),
              UnorderedElementsAreArray(with_closer_look(
                  {"archive.sqlite", "config.cfg", "report.html", "screens.csv", "summary.json"})));
  EXPECT_THAT(finished.output, AllOf(StartsWith("0.5 m telescope at 532 nm, D/r0 = 4"),
                                     HasSubstr("residual WFE, nm"), HasSubstr("2 screens"),
                                     EndsWith("Results are in run.\n")));

  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "evaluate");
  EXPECT_EQ(json.at("version"), version());
  EXPECT_EQ(json.at("config").size(), configuration_keys().size());
  EXPECT_EQ(json["config"].at("detector.pupil_pixels"), "16");
  EXPECT_TRUE(json["config"].at("seeing.outer_scale").is_null());
  expect_design_of_the_contract(json.at("design"));
  EXPECT_EQ(json["design"]["planes_m"], (Json{-180e3, 180e3, -47e3, 47e3}));
  EXPECT_EQ(json["design"]["performance"]["screens"], 2);

  EXPECT_EQ(archived("run", "SELECT count(*) FROM evaluations"), 1.0);
  EXPECT_EQ(archived("run", "SELECT cost FROM evaluations"), json["design"]["cost"]["mean"]);
  EXPECT_EQ(archived("run",
                     "SELECT json_extract(performance, '$.total_wfe_nm.mean') "
                     "FROM evaluations"),
            json["design"]["performance"]["total_wfe_nm"]["mean"]);

  const auto table = read_table("run/screens.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_THAT(table[0], ElementsAre("screen", "residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm",
                                    "field_strehl", "loops", "fractional_loops", "seconds",
                                    "fft_count", "converged"));
  EXPECT_NEAR((std::stod(table[1][1]) + std::stod(table[2][1])) / 2.0,
              json["design"]["performance"]["residual_wfe_nm"]["mean"], 1e-9);
}

TEST_F(Studies, ADesignThatBreaksALimitIsWarnedOf) {
  for (const char* command : {"evaluate", "optimize", "sweep"}) {
    const std::string output =
        done(command, command, {"--objective.limits", "plane_count<2,loops>0,loops<1"}).output;
    EXPECT_THAT(output,
                AllOf(HasSubstr("warning: objective.limits asks for plane_count below 2, which is "
                                "4.00 +- 0.00\n"),
                      HasSubstr("asks for loops below 1"), Not(HasSubstr("loops above"))))
        << command;
  }
}

TEST_F(Studies, OptimizeVariesWhatItIsTold) {
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

TEST_F(Studies, OptimizeEndsWhereItIsTold) {
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

TEST_F(Studies, ACheapSearchOnlyGivesStarts) {
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

TEST_F(Studies, TheTimeLimitIsThatOfBothSearches) {
  const ProgramRun finished = done("optimize", "run",
                                   {"--search.cheap_budget", "100000", "--search.budget", "100000",
                                    "--search.time_limit", "10ms"});
  const Json json = summary("run");
  EXPECT_EQ(json["termination"], "time_limit");
  EXPECT_GE(json["cheap_evaluations"], 1);
  EXPECT_EQ(json["evaluations"], 1);
}

TEST_F(Studies, ACheapSearchDoesNotEndAtTheTarget) {
  done("optimize", "run", {"--search.cheap_budget", "9", "--search.target", "1000"});
  const Json json = summary("run");
  EXPECT_EQ(json["cheap_evaluations"], 9);
  EXPECT_EQ(json["termination"], "target_reached");
}

TEST_F(Studies, AnyCheapWindowIsRoundedToOneThatTheGridCanHave) {
  done("optimize", "run", {"--search.cheap_budget", "6", "--search.cheap_window", "0.53"});
  EXPECT_EQ(archived("run",
                     "SELECT count(*) FROM evaluations WHERE stage = 'cheap search' AND "
                     "json_extract(design, '$.reconstruction_window') = 2.25"),
            6.0);
}

TEST_F(Studies, AnInterruptInTheCheapSearchLeavesACompleteResult) {
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

TEST_F(Studies, RacesSaveReconstructionsAndKeepTheWinner) {
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

TEST_F(Studies, AnInterruptedOptimizeVerifiesTheBestSoFar) {
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

TEST_F(Studies, OptimizeSaysWhereTheBaselineIsNotBeaten) {
  // The only design that is tried is the baseline itself.
  const ProgramRun finished =
      done("optimize", "run", {"--sensor.planes=-47km,47km,-180km,180km", "--search.budget", "1"});
  EXPECT_THAT(finished.output, HasSubstr("The baseline is NOT beaten"));
  EXPECT_EQ(summary("run")["improvement"]["cost"], 0.0);
}

TEST_F(Studies, OptimizeLeavesItsFiles) {
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

TEST_F(Studies, TheBestConfigurationEvaluatesToWhatWasVerified) {
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

TEST_F(Studies, OptimizeSearchesFreeLayoutsOfAnyPlaneCount) {
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

TEST_F(Studies, ScreensLeavesItsFiles) {
  const ProgramRun finished = done("screens", "run");
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "config.cfg", "report.html", "screens.fits",
                          "structure_function.csv", "summary.json"));
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("2 screens of 32 x 32 samples"), EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "screens");
  EXPECT_EQ(json.at("screens"), 2);
  EXPECT_EQ(json.at("samples"), 32);
  const FitsCube cube = read_fits_cube("run/screens.fits", "screens.file");
  EXPECT_EQ(cube.unit, "rad");
  EXPECT_EQ(cube.slices.size(), 2u);
  EXPECT_EQ(cube.slices.at(0).rows(), 32);
  // 0.5 m over 32 samples, about the middle.
  EXPECT_THAT(contents("run/screens.fits"), AllOf(HasSubstr("CRPIX1  =                 16.5"),
                                                  HasSubstr("CDELT2  =             0.015625"),
                                                  HasSubstr("CTYPE3  = 'SCREEN  '")));
  // Four directions of 31 separations.
  EXPECT_EQ(read_table("run/structure_function.csv").size(), 1u + 4 * 31);
}

TEST_F(Studies, ScaleLeavesItsFiles) {
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

TEST_F(Studies, TheConfigurationOfARunReproducesIt) {
  const Arguments settings{"--detector.photons",
                           "1e5",
                           "--detector.read_noise",
                           "1.5",
                           "--screens.seed",
                           "7",
                           "--seeing.fwhm",
                           "0.8",
                           "--seeing.outer_scale",
                           "25m",
                           "--telescope.diameter",
                           "60cm",
                           "--reconstruction.relaxation",
                           "-0.3:0.2",
                           "--simulation.precision",
                           "single",
                           "--search.z_far",
                           "100km:200km",
                           "--scale.wavelength",
                           "850nm"};
  for (const Command& command : commands()) {
    if (!runs_on_the_tiny_configuration(command)) continue;
    const std::string first = command.name + "-first";
    const std::string again = command.name + "-again";
    done(command.name, first, settings);
    const ProgramRun repeated =
        run({command.name, "--config", first + "/config.cfg", "--output", again});
    ASSERT_EQ(repeated.exit_code, 0) << repeated.errors;
    EXPECT_EQ(repeatable_summary(first), repeatable_summary(again)) << command.name;
    EXPECT_EQ(names_in(first), names_in(again));
    for (const char* file : {"config.cfg", "best.cfg", "scaled.cfg", "search.csv", "screens.fits",
                             "structure_function.csv", "typical-images.fits", "worst-phases.fits",
                             "loops.csv", "sensitivity.csv"}) {
      EXPECT_EQ(contents(first + '/' + file), contents(again + '/' + file)) << file;
    }
  }
}

TEST_F(Studies, TheSeedDecidesTheResult) {
  done("evaluate", "one");
  done("evaluate", "two", {"--screens.seed", "2"});
  EXPECT_NE(summary("one")["design"]["performance"]["residual_wfe_nm"],
            summary("two")["design"]["performance"]["residual_wfe_nm"]);
}

TEST_F(Studies, TheNumberOfThreadsDoesNotMatter) {
  for (const Command& command : commands()) {
    if (!runs_on_the_tiny_configuration(command)) continue;
    const Arguments more{"--screens.count",  "5",  "--detector.photons", "1e5",
                         "--scale.diameter", "2m", "--verify.screens",   "3"};
    for (const std::string threads : {"1", "2"}) {
      Arguments arguments = more;
      arguments.insert(arguments.end(), {"--threads", threads});
      done(command.name, command.name + threads, arguments);
    }
    EXPECT_EQ(repeatable_summary(command.name + "1"), repeatable_summary(command.name + "2"));
  }
}

TEST_F(Studies, ScreensFromAFileAreTheSimulatedOnes) {
  done("evaluate", "simulated");
  done("screens", "screens");
  done("evaluate", "from_file", {"--screens.file", "screens/screens.fits"});
  const Json expected = summary("simulated")["design"]["performance"];
  // The file's have no piston, which changes the last bits of the fields.
  expect_same_performance(summary("from_file")["design"]["performance"], expected, 1e-6);

  FitsCube cube = read_fits_cube("screens/screens.fits", "screens.file");
  for (Image<double>& screen : cube.slices) screen *= 532e-9 / (2.0 * std::numbers::pi);
  cube.unit = "m";
  write_fits_cube("metres.fits", cube);
  done("evaluate", "from_metres", {"--screens.file", "metres.fits"});
  expect_same_performance(summary("from_metres")["design"]["performance"], expected, 1e-6);
}

TEST_F(Studies, AFileDecidesHowManyScreensThereAre) {
  done("screens", "screens", {"--screens.count", "3"});
  done("evaluate", "run", {"--screens.file", "screens/screens.fits", "--screens.count", "7"});
  EXPECT_EQ(summary("run")["design"]["performance"]["screens"], 3);
}

TEST_F(Studies, ScreensOfAnotherSamplingAreResampledWithANote) {
  done("screens", "fine", {"--simulation.pupil_samples", "64"});
  const ProgramRun finished = done("evaluate", "run", {"--screens.file", "fine/screens.fits"});
  EXPECT_THAT(finished.output, HasSubstr("note: fine/screens.fits: 64 x 64 samples were resampled "
                                         "to the truth's 32 x 32\n"));
  EXPECT_THAT(done("optimize", "best", {"--screens.file", "fine/screens.fits"}).output,
              AllOf(HasSubstr("note: fine/screens.fits: 64 x 64"),
                    HasSubstr("note: the verification is on simulated screens")));
  done("screens", "equal");
  EXPECT_THAT(done("evaluate", "unchanged", {"--screens.file", "equal/screens.fits"}).output,
              Not(HasSubstr("note:")));
}

TEST_F(Studies, BandsMoveToAnotherWavelengthWithTheDesign) {
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

TEST_F(Studies, ADesignIsFoundForSeveralConditions) {
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

TEST_F(Studies, TheObjectiveMayBeTheErrorBudget) {
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

TEST_F(Studies, AScaledDesignDoesTheSameInWaves) {
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

TEST_F(Studies, ScalingThereAndBackIsNoChange) {
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

TEST_F(Studies, TheRelayStaysUnlessAnotherIsGiven) {
  done("scale", "run", {"--telescope.relay_beam_diameter", "10mm", "--scale.diameter", "8m"});
  const Json json = summary("run");
  EXPECT_NEAR(json["scaled"]["planes_bench_m"][0], json["design"]["planes_bench_m"][0], 1e-9);
  EXPECT_THAT(contents("run/scaled.cfg"), HasSubstr("relay_beam_diameter = 0.01\n"));
}

TEST_F(Studies, ThePapersPresetRunsOnItsMatchedTruth) {
  // A file would override the preset's window.
  std::filesystem::remove("tiny.cfg");
  std::ofstream("tiny.cfg") << "[detector]\npupil_pixels = 16\n[screens]\ncount = 2\n";
  const ProgramRun finished = done("evaluate", "run", {"--preset", "paper"});
  EXPECT_THAT(finished.output, HasSubstr("matched truth"));
  const Json design = summary("run")["design"];
  EXPECT_EQ(design["detector_window"], 4.0);
  for (const double energy : design["performance"]["captured_energy"]) {
    EXPECT_NEAR(energy, 1.0, 1e-12) << "the whole periodic grid is measured";
  }
}

TEST_F(Studies, WithoutAFolderOfTheUsersRunsAreNumbered) {
  for (const std::string folder : {"results/evaluate-1", "results/evaluate-2"}) {
    const ProgramRun finished = run({"evaluate", "--config", "tiny.cfg", "--quiet"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.errors, "");
    EXPECT_THAT(finished.output, EndsWith("Results are in " + folder + ".\n"));
    EXPECT_TRUE(std::filesystem::exists(folder + "/summary.json"));
  }
}

TEST_F(Studies, FoldersMayHaveAnyName) {
  for (const std::string folder :
       {"two words/and parents", "it's", "\xC3\xBC", "slash/", "file:a?b"}) {
    const ProgramRun finished = run({"evaluate", "--config", "tiny.cfg", "--output", folder});
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_TRUE(std::filesystem::exists(folder + "/summary.json")) << folder;
    EXPECT_TRUE(std::filesystem::exists(folder + "/archive.sqlite")) << folder;
  }
}

TEST_F(Studies, HelpVersionAndDumpWorkOnEveryCommandAndLeaveNothing) {
  const ProgramRun bare = run({"--version"});
  EXPECT_EQ(bare.output, "nlcwfs " + std::string(version()) + "\n");
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  for (const Command& command : commands()) {
    const ProgramRun help = run({command.name, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.output, HasSubstr("nlcwfs " + command.name));
    EXPECT_EQ(run({command.name, "--version"}).output, bare.output);

    const ProgramRun dump = run({command.name, "--dump-config", "--telescope.diameter", "1.8m"});
    EXPECT_EQ(dump.exit_code, 0);
    EXPECT_THAT(dump.output, HasSubstr("diameter = 1.8m\n"));
    std::ofstream("dump.cfg") << dump.output;
    EXPECT_EQ(run({command.name, "--dump-config", "--config", "dump.cfg"}).output, dump.output);
    EXPECT_EQ(help.errors + dump.errors, "");
  }
  EXPECT_THAT(names_in("."), ElementsAre("dump.cfg", "errors.txt", "output.txt", "tiny.cfg"));
}

}  // namespace
}  // namespace nlcwfs
