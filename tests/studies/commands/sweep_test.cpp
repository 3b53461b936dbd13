// Tests of sweep: every design of the configured grid, the best of them verified on fresh screens.
#include "results/archive/archive.hpp"
#include "studies/settings/configuration.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;
using Json = nlohmann::json;

using SweepStudy = Program;

/// The rows of a table, without those whose text has quotes, each by the names of its header.
std::vector<std::map<std::string, std::string>> table_of(const std::string& path) {
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> header;
  std::istringstream text(contents(path));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) {
      rows.back()[header[i]] = cells[i];
    }
  }
  return rows;
}

/// A table without its measured times.
std::string repeatable_table(const std::string& path) {
  std::string text;
  for (auto& row : table_of(path)) {
    row.erase("seconds");
    row.erase("seconds_standard_error");
    for (const auto& [name, value] : row) text += name + '=' + value + ' ';
    text += '\n';
  }
  return text;
}

/// What goes before a program that is to get a signal as soon as it has archived some designs.
std::string signalled(const std::string& signal) {
  std::ofstream("signalled.sh") << "signal=$1; shift; \"$@\" & pid=$!\n"
                                   "while [ $(wc -c < run/archive.sqlite || echo 0) -lt 24000 ]\n"
                                   "do sleep 0.01; done 2> /dev/null\n"
                                   "kill -s $signal $pid; wait $pid\n";
  return "sh signalled.sh " + signal + ' ';
}

const std::vector<std::string> grid{"--sweep.z_near", "20km:60km:3",        "--sweep.z_far",
                                    "80km:160km:2",   "--sweep.relaxation", "0,0.3"};

TEST_F(SweepStudy, LeavesItsFiles) {
  const ProgramRun finished = done("sweep", "run", grid);
  EXPECT_THAT(names_in("run"),
              UnorderedElementsAreArray(with_closer_look(
                  {"archive.sqlite", "best.cfg", "config.cfg", "report.html", "map-cost.fits",
                   "map-cost.png", "map-cost.svg", "map-fractional_loops.fits",
                   "map-fractional_loops.png", "map-fractional_loops.svg", "map-residual_wfe.fits",
                   "map-residual_wfe.png", "map-residual_wfe.svg", "summary.json", "sweep.csv"})));
  EXPECT_THAT(finished.output,
              AllOf(StartsWith("0.5 m telescope"), HasSubstr("12 designs at 12 points of a grid"),
                    HasSubstr("2 fresh"), EndsWith("Results are in run.\n")));
  const Json json = summary("run");
  EXPECT_EQ(json.at("command"), "sweep");
  EXPECT_EQ(json.at("points"), 12);
  EXPECT_EQ(json.at("evaluations"), 12);
  EXPECT_EQ(json.at("failures"), 0);
  // Every design and once more the best on the sweep's 2 screens, the best three on 2 fresh ones.
  EXPECT_EQ(json.at("search_reconstructions"), 12 * 2);
  EXPECT_EQ(json.at("reconstructions"), 12 * 2 + 2 + 3 * 2);
  EXPECT_GT(json.at("wall_seconds"), json.at("search_seconds"));
  EXPECT_EQ(json.at("grid").at("axes"),
            (Json::array({{{"name", "z_near"}, {"unit", "m"}, {"values", {20e3, 40e3, 60e3}}},
                          {{"name", "z_far"}, {"unit", "m"}, {"values", {80e3, 160e3}}},
                          {{"name", "relaxation"}, {"unit", ""}, {"values", {0.0, 0.3}}}})));
  const Archive archive = Archive::reopened("run/archive.sqlite");
  EXPECT_EQ(std::ranges::count(archive.evaluations(), "sweep", &ArchivedEvaluation::stage), 12);
  EXPECT_EQ(std::ranges::count(archive.evaluations(), "verify", &ArchivedEvaluation::stage), 3);
}

TEST_F(SweepStudy, RanksItsBestDesignsOnFreshScreens) {
  const ProgramRun finished = done("sweep", "run", grid);
  EXPECT_THAT(finished.output, HasSubstr("The sweep's best 3 designs on the fresh screens:"));
  const Json json = summary("run");
  const Json& ranking = json["ranking"];
  ASSERT_EQ(ranking.size(), 3u);
  EXPECT_EQ(ranking[0]["planes_m"], json["best"]["planes_m"]);
  EXPECT_EQ(ranking[0]["verdict"], "best");
  // They are the grid's cheapest.
  std::vector<double> costs;
  for (const auto& row : table_of("run/sweep.csv")) costs.push_back(std::stod(row.at("cost")));
  std::ranges::sort(costs);
  EXPECT_LE(json["best_on_search_screens"]["cost"]["mean"], costs[2] * (1.0 + 1e-9));
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GE(ranking[i]["cost"]["mean"], ranking[i - 1]["cost"]["mean"]);
    EXPECT_NEAR(ranking[i]["cost_above_best"]["mean"],
                double(ranking[i]["cost"]["mean"]) - double(ranking[0]["cost"]["mean"]), 1e-9);
  }
}

TEST_F(SweepStudy, SavesEveryMetricThatTheConfigurationSaysEnoughFor) {
  done("sweep", "still", {"--sweep.pupil_pixels", "8,16"});
  const Json still = summary("still")["grid"];
  for (const char* metric :
       {"model_seconds", "detector_pixels", "plane_count", "captured_energy", "latency_seconds"}) {
    ASSERT_TRUE(still.contains(metric)) << metric;
    EXPECT_TRUE(still["standard_error"].contains(metric));
  }
  EXPECT_EQ(still["detector_pixels"][0], (Json{4 * 16 * 16, 4 * 32 * 32}));
  EXPECT_LE(still["captured_energy"][0][0], 1.0);
  EXPECT_FALSE(still.contains("servo_wfe_nm")) << "there is no wind";
  done("sweep", "windy", {"--objective.wind_speed", "10"});
  EXPECT_TRUE(summary("windy")["grid"].contains("servo_wfe_nm"));
}

TEST_F(SweepStudy, ItsMatricesAndItsTableAgree) {
  done("sweep", "run", grid);
  const Json object = summary("run").at("grid");
  const auto rows = table_of("run/sweep.csv");
  ASSERT_THAT(rows, SizeIs(12));
  for (const char* metric :
       {"cost", "residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl", "loops",
        "fractional_loops", "seconds", "fft_count", "violation"}) {
    ASSERT_EQ(object.at(metric).size(), 3u);
    if (metric != std::string("violation")) {
      EXPECT_EQ(object.at("standard_error").at(metric)[1][1][1],
                std::stod(rows[7].at(metric + std::string("_standard_error"))));
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
      EXPECT_EQ(object[metric][row / 4][row / 2 % 2][row % 2], std::stod(rows[row].at(metric)));
    }
  }
  EXPECT_EQ(rows[7].at("z_near_m"), "40000");
  EXPECT_EQ(rows[7].at("z_far_m"), "160000");
  EXPECT_EQ(rows[7].at("relaxation"), "0.3");
}

TEST_F(SweepStudy, APointIsWhatEvaluateSaysOfItsDesign) {
  done("sweep", "run", grid);
  done("evaluate", "one",
       {"--sensor.planes=-160km,160km,-40km,40km", "--reconstruction.relaxation", "0.3",
        "--simulation.precision", "single"});
  const Json object = summary("run").at("grid");
  const Json design = summary("one").at("design");
  EXPECT_EQ(object["cost"][1][1][1], design["cost"]["mean"]);
  EXPECT_EQ(object["residual_wfe_nm"][1][1][1], design["performance"]["residual_wfe_nm"]["mean"]);
  EXPECT_EQ(std::stod(table_of("run/sweep.csv")[7].at("cost_standard_error")),
            design["cost"]["standard_error"]);
}

TEST_F(SweepStudy, ItsBestIsTheLeastOfTheGridAndIsVerified) {
  done("sweep", "run", grid);
  const Json json = summary("run");
  double least = 1e9;
  for (const auto& row : table_of("run/sweep.csv"))
    least = std::min(least, std::stod(row.at("cost")));
  EXPECT_EQ(json.at("best_on_search_screens").at("cost").at("mean"), least);
  EXPECT_EQ(json["best"]["planes_m"], json["best_on_search_screens"]["planes_m"]);

  // On the verification's screens and twice as fine truth.
  const ProgramRun again = run({"evaluate", "--config", "run/best.cfg", "--output", "again",
                                "--screens.seed", "1000003", "--simulation.pupil_samples", "64"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(repeatable_summary("run")["best"], repeatable_summary("again")["design"]);
}

TEST_F(SweepStudy, HasNoPicturesWithoutGnuplotAndSaysSo) {
  const ProgramRun finished =
      run({"sweep", "--config", "tiny.cfg", "--output", "run"}, "PATH=/nowhere ");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("note: there is no map-cost.svg, map-residual_wfe.svg, "
                              "map-fractional_loops.svg: gnuplot: No such file"),
                    HasSubstr("note: there is no design.svg, ")));
  EXPECT_THAT(names_in("run"),
              ElementsAre("archive.sqlite", "best.cfg", "config.cfg", "loops.csv", "report.html",
                          "summary.json", "sweep.csv", "typical-images.fits", "typical-phases.fits",
                          "worst-images.fits", "worst-phases.fits"));
}

TEST_F(SweepStudy, ADesignThatFailsLeavesAGap) {
  done("sweep", "run", {"--sweep.pupil_pixels", "16,12"});
  const Json json = summary("run");
  EXPECT_EQ(json.at("failures"), 2);
  EXPECT_EQ(json.at("evaluations"), 4);
  EXPECT_TRUE(json["grid"]["cost"][0][1].is_null());
  EXPECT_TRUE(json["grid"]["cost"][0][0].is_number());
  EXPECT_THAT(contents("run/sweep.csv"), HasSubstr("a multiple of detector.pupil_pixels"));
  // Designs of different pixels are compared by their total error.
  EXPECT_NEAR(json["grid"]["cost"][0][0],
              double(json["grid"]["total_wfe_nm"][0][0]) / 10.0 +
                  0.1 * double(json["grid"]["fractional_loops"][0][0]),
              1e-12);
}

TEST_F(SweepStudy, EndsWhereTooManyDesignsFailOneAfterTheOther) {
  const ProgramRun failed =
      run({"sweep", "--config", "tiny.cfg", "--output", "run", "--sweep.z_near", "20km:60km:5",
           "--sweep.z_far", "80km:160km:5", "--simulation.time_limit", "1us"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.errors,
              HasSubstr("20 of 25 designs failed one after the other, the last with: a wavefront "
                        "took longer than simulation.time_limit, 1e-06 s; the archive has all of "
                        "them: nlcwfs export run"));
  const ProgramRun exported = run({"export", "run", "--output", "table"});
  EXPECT_EQ(exported.exit_code, 0) << exported.errors;
  EXPECT_EQ(summary("table").at("failed"), 20);
}

TEST_F(SweepStudy, SweepsPlaneCountsAndOrders) {
  done("sweep", "run", {"--sweep.plane_count", "2,3,4", "--sweep.z_far", "100km,160km"});
  const Json costs = summary("run")["grid"]["cost"];
  // plane_count, z_near, z_far: two planes have no far pair.
  EXPECT_EQ(costs[0][0][0], costs[0][0][1]);
  EXPECT_NE(costs[1][0][0], costs[1][0][1]);
  EXPECT_EQ(summary("run")["evaluations"], 2 + 4 + 4);

  done("sweep", "orders", {"--sweep.order", "3412,1234", "--sweep.z_far", "30km,60km"});
  const Json json = summary("orders");
  EXPECT_EQ(json["grid"]["axes"][0]["values"], (Json{"3412", "1234"}));
  // Both pairs have both distances: the grid has each design twice, but for equal pairs, whose
  // orders are equal too.
  EXPECT_EQ(json["points"], 8);
  EXPECT_EQ(json["evaluations"], 4);
  EXPECT_EQ(json["grid"]["cost"][0][0][1], json["grid"]["cost"][1][1][0]);
}

TEST_F(SweepStudy, AnAxisBeyondTheGivenPlanesAddsAPlane) {
  std::ofstream("free.cfg") << contents("tiny.cfg").substr(0, contents("tiny.cfg").find("[sweep]"));
  std::filesystem::rename("free.cfg", "tiny.cfg");
  done("sweep", "run",
       {"--sweep.layout", "free", "--sweep.z5", "10km,30km", "--sweep.initial_guess",
        "flat,centroid"});
  const Json json = summary("run");
  ASSERT_EQ(json["best"]["planes_m"].size(), 5u);
  EXPECT_EQ(json["best"]["planes_m"][0], -180e3);
  EXPECT_EQ(json["grid"]["axes"][1]["values"], (Json{"flat", "centroid"}));
}

TEST_F(SweepStudy, SetsEverythingThatTheBestHasOtherwise) {
  // Also what has one value alone.
  done(
      "sweep", "run",
      {"--sweep.relaxation_start", "0.3", "--sweep.relaxation_end", "-0.1,0.1", "--sweep.tolerance",
       "2nm,3nm", "--sweep.detector_window", "2.5", "--sweep.reconstruction_window", "5",
       "--sweep.initial_guess", "centroid", "--sweep.reconstruction_oversampling", "2"});
  Configuration best;
  best.read_file("run/best.cfg");
  const Json design = summary("run")["best"];
  EXPECT_EQ(design["planes_m"].get<std::vector<double>>(), best.lengths("sensor.planes"));
  EXPECT_EQ(design["detector_window"], best.number("detector.window"));
  EXPECT_EQ(design["reconstruction_window"], best.number("reconstruction.window"));
  EXPECT_EQ(design["tolerance_m"], best.length("reconstruction.tolerance"));
  EXPECT_EQ(design["initial_guess"], best.choice("reconstruction.initial_guess"));
  EXPECT_EQ(best.choice("reconstruction.initial_guess"), "centroid");
  EXPECT_EQ(best.integer("reconstruction.oversampling"), 2);
  EXPECT_EQ(design["oversampling"], best.integer("reconstruction.oversampling"));
  EXPECT_EQ(design["relaxation"][0], best.ramp("reconstruction.relaxation").first);
  EXPECT_EQ(design["relaxation"][1], best.ramp("reconstruction.relaxation").second);
}

TEST_F(SweepStudy, GoesOnAfterBeingKilledAsIfItHadNot) {
  const Arguments large{"--sweep.z_near", "20km:60km:7", "--sweep.z_far", "80km:160km:7"};
  done("sweep", "whole", large);
  Arguments killed{"sweep", "--config", "tiny.cfg", "--output", "run"};
  killed.insert(killed.end(), large.begin(), large.end());
  EXPECT_NE(run(killed, signalled("KILL")).exit_code, 0);
  ASSERT_FALSE(std::filesystem::exists("run/summary.json"));

  const ProgramRun resumed = run({"sweep", "--resume", "run"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_THAT(resumed.output, ContainsRegex(" \\([1-9][0-9]* of them in an earlier run\\)"));
  EXPECT_EQ(names_in("run"), names_in("whole"));
  EXPECT_EQ(repeatable_summary("run"), repeatable_summary("whole"));
  EXPECT_EQ(repeatable_table("run/sweep.csv"), repeatable_table("whole/sweep.csv"));
  for (const char* file : {"config.cfg", "best.cfg"}) {
    EXPECT_EQ(contents(std::string("run/") + file), contents(std::string("whole/") + file)) << file;
  }
  EXPECT_EQ(Archive::reopened("run/archive.sqlite").evaluations().size(), 49u + 3u)
      << "each design once, and the verifications";

  // Killed between the summary and the page.
  std::filesystem::remove("run/report.html");
  const ProgramRun again = run({"sweep", "--resume", "run"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.output, HasSubstr("nothing is left to do"));
  EXPECT_EQ(names_in("run"), names_in("whole"));
}

TEST_F(SweepStudy, AnInterruptLeavesWhatIsDoneAndSaysHowToGoOn) {
  Arguments arguments{"sweep", "--config",       "tiny.cfg",      "--output",
                      "run",   "--sweep.z_near", "20km:60km:5000"};
  const ProgramRun stopped = run(arguments, signalled("INT"));
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_THAT(stopped.errors,
              AllOf(HasSubstr("\nnlcwfs: interrupted: "), HasSubstr(" of 5000 designs are done"),
                    EndsWith("go on with: nlcwfs sweep --resume run\n")));
  EXPECT_THAT(names_in("run"), ElementsAre("archive.sqlite", "config.cfg"));
}

TEST_F(SweepStudy, DoesNotGoOnWithAnotherCommandsRun) {
  done("optimize", "run");
  std::filesystem::remove("run/summary.json");
  const ProgramRun finished = run({"sweep", "--resume", "run"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(
      finished.errors,
      HasSubstr("--resume = run: is a run of optimize; name the folder of an interrupted sweep"));
}

TEST_F(SweepStudy, RefusesGridsThatCannotBe) {
  std::filesystem::remove("tiny.cfg");
  struct Refusal {
    Arguments arguments;
    std::string message;
  };
  for (const auto& [arguments, message] : std::vector<Refusal>{
           {{}, "sweep.z_near = not set: a sweep needs an axis, such as --sweep.z_near 5km:"},
           {{"--sweep.z_near", "1km:2km"}, "sweep.z_near = 1km:2km: min:max:count"},
           {{"--sweep.z_near", "0,1km"}, "sweep.z_near = 0,1km: "},
           {{"--sweep.plane_count", "2:4:3"}, "sweep.plane_count = 2:4:3: "},
           {{"--sweep.plane_count", "4,4"}, "sweep.plane_count = 4,4: each value once"},
           {{"--sweep.plane_count", "7"}, "sweep.plane_count = 7: "},
           {{"--sweep.z1", "1km,2km"}, "sweep.z1 = 1km,2km: is for sweep.layout = free"},
           {{"--sweep.z_third", "1km,2km"}, "sweep.z_third = 1km,2km: there are at most 4"},
           {{"--sweep.plane_count", "4,6"}, "sweep.z_third = not set: sensor.planes has no such"},
           {{"--sweep.plane_count", "4,6", "--sweep.z_third", "9km"},
            "sweep.order = not set: sensor.planes has no such order of 6 planes"},
           {{"--sweep.order", "312"}, "sweep.order = 312: has no order of 4 planes"},
           {{"--sweep.order", "3412,312"}, "sweep.order = 312: an order of 4 planes"},
           {{"--sweep.layout", "free", "--sweep.order", "all"}, "sweep.order = all: is for"},
           {{"--sweep.layout", "free", "--sweep.z6", "1km"}, "sweep.z5 = not set: sensor.planes"},
           {{"--sensor.planes", "1km,2km,3km", "--sweep.z_near", "1km"},
            "sensor.planes = 1km,2km,3km: pairs -z, +z"},
           {{"--sensor.planes", "1,2,3,4,5,6,7", "--sweep.order", "all"},
            "sensor.planes = 1,2,3,4,5,6,7: 2 to 6 planes"},
           {{"--sweep.relaxation", "0,1"}, "sweep.relaxation = 0,1: "},
           {{"--sweep.relaxation", "0,0.5", "--sweep.relaxation_end", "0.1"},
            "sweep.relaxation = 0,0.5: either relaxation, or"},
           {{"--sweep.z_near", "1km:2km:1001", "--sweep.z_far", "1km:2km:1000"},
            "sweep.z_near = 1km:2km:1001: with the other axes the grid has 1.001e+06 points"}}) {
    Arguments all{"sweep", "--output", "run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramRun finished = run(all);
    EXPECT_EQ(finished.exit_code, 2) << message;
    EXPECT_THAT(finished.errors, StartsWith("nlcwfs: " + message));
    EXPECT_EQ(std::ranges::count(finished.errors, '\n'), 1);
    EXPECT_FALSE(std::filesystem::exists("run"));
  }
}

TEST_F(SweepStudy, FailsWhereAllItsDesignsDo) {
  const ProgramRun finished =
      run({"sweep", "--config", "tiny.cfg", "--output", "run", "--sweep.pupil_pixels", "12,20"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.errors, HasSubstr("every design of the grid failed; the first: "));
}

}  // namespace
}  // namespace nlcwfs
