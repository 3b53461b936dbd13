// Tests: bad input of every kind gives one line that names key, value and remedy.
#include "results/fits/fits_cube.hpp"
#include "tests/studies/program.hpp"

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Demands one line on standard error and nothing on standard output.
void expect_one_line(const ProgramRun& refused) {
  EXPECT_EQ(refused.output, "");
  EXPECT_THAT(refused.errors, StartsWith("nlcwfs: "));
  EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
  EXPECT_TRUE(refused.errors.ends_with('\n'));
}

class BadInput : public Program {
 protected:
  /// Demands that the tiny configuration with `more` is refused with exit code 2 in one line
  /// `nlcwfs: key = value: ...allowed...`, and leaves no folder.
  static void expect_refused(const std::string& command, const Arguments& more,
                             const std::string& key_and_value, const std::string& allowed) {
    Arguments arguments{command, "--config", "tiny.cfg", "--output", "run"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    expect_one_line(refused);
    EXPECT_THAT(refused.errors,
                AllOf(StartsWith("nlcwfs: " + key_and_value + ": "), HasSubstr(allowed)));
    EXPECT_FALSE(std::filesystem::exists("run") || std::filesystem::exists("results"));
  }
};

TEST_F(BadInput, OfTheCommandLine) {
  expect_refused("evaluate", {"--detector.pupil_pixel", "16"},
                 "command line = --detector.pupil_pixel", "did you mean --detector.pupil_pixels?");
  expect_refused("optimise", {}, "command line = optimise", "which has evaluate, ");
  expect_refused("optimise", {}, "command line = optimise", "; did you mean optimize?");
  expect_refused("evaluate", {"optimize"}, "command line = optimize", "nothing may follow");
  expect_refused("evaluate", {"--telescope.diameter", "1.8", "m"}, "command line = m",
                 "a value is one word, such as 0.5m");
  expect_refused("evaluate", {"--sensor.planes", "-47km,", "47km"}, "command line = 47km",
                 "a value is one word, such as 0.5m or -47km,47km");
  expect_refused("evaluate", {"--screens.count"}, "screens.count = (nothing)", "a whole number");
  expect_refused("evaluate", {"--threads", "-1"}, "--threads = -1", "from 0 (all cores)");
  expect_refused("evaluate", {"--preset", "papr"}, "--preset = papr", "the only one is paper");
  expect_refused("evaluate", {"--source.bands", "600nm:500nm"}, "source.bands = 600nm:500nm",
                 "SHORTEST:LONGEST from 1e-09 m to 0.001 m");
  expect_refused("evaluate", {"--source.bands", "500nm:600nm,600nm:700nm"},
                 "source.bands = 500nm:600nm,600nm:700nm", "one for each of the 4 planes");
  expect_refused("optimize", {"--source.division", "split"}, "source.division = split",
                 "source.bands must be set");
  expect_refused("evaluate", {"--source.bands", "500nm:600nm", "--source.weights", "1,2"},
                 "source.weights = 1,2", "one for each of the 20");
  expect_refused("reproduce", {"--reproduce.figures", "3,9"}, "reproduce.figures = 3,9",
                 "a list of 3, 4, 5");
  for (const Arguments& arguments : {Arguments{}, Arguments{"--quiet"}}) {
    const ProgramRun refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    expect_one_line(refused);
    EXPECT_THAT(refused.errors,
                HasSubstr("command line = (nothing): a command must stand there, one of evaluate"));
  }
}

TEST_F(BadInput, OfAConfigurationFile) {
  expect_refused("evaluate", {"--config", "missing.cfg"}, "--config = missing.cfg", "No such file");
  std::filesystem::create_directory("folder");
  expect_refused("evaluate", {"--config", "folder"}, "--config = folder", "a directory");
  std::ofstream("typo.cfg") << "[detector]\npupil_pixls = 3\n";
  expect_refused("evaluate", {"--config", "typo.cfg"}, "detector.pupil_pixls = 3",
                 "in typo.cfg, line 2; did you mean detector.pupil_pixels?");
  std::ofstream("garbage.cfg") << "\x01\x02 = \nnonsense";
  expect_refused("evaluate", {"--config", "garbage.cfg"}, "--config = garbage.cfg",
                 "line 1 is no text");
  expect_refused("evaluate", {"--config", "/dev/zero"}, "--config = /dev/zero",
                 "longer than 16 MiB");
}

TEST_F(BadInput, OfSingleValues) {
  expect_refused("evaluate", {"--telescope.diameter", "half a metre"},
                 "telescope.diameter = half a metre", "a length from 0.0001 m to 1000 m");
  expect_refused("evaluate", {"--telescope.diameter", "-1"}, "telescope.diameter = -1",
                 "a length from 0.0001 m to 1000 m");
  expect_refused("evaluate", {"--telescope.wavelength", "532parsec"},
                 "telescope.wavelength = 532parsec", "in nm, um, mm, cm, m or km");
  expect_refused("evaluate", {"--telescope.wavelength", "850"}, "telescope.wavelength = 850",
                 "a length from 1e-09 m to 0.001 m in nm, um, mm, cm, m or km, such as 532nm");
  expect_refused("evaluate", {"--telescope.diameter", "8200"}, "telescope.diameter = 8200",
                 "a length from 0.0001 m to 1000 m");
  for (const std::string key :
       {"telescope.diameter", "telescope.wavelength", "telescope.relay_beam_diameter",
        "seeing.d_over_r0", "seeing.fried_parameter", "seeing.fwhm", "objective.wfe_scale"}) {
    expect_refused("evaluate", {"--" + key, "1e-300"}, key + " = 1e-300", "");
  }
  expect_refused("evaluate", {"--screens.count", "0"}, "screens.count = 0", "from 1 to");
  expect_refused("evaluate", {"--screens.count", "2.5"}, "screens.count = 2.5", "a whole number");
  expect_refused("evaluate", {"--seeing.d_over_r0", "nan"}, "seeing.d_over_r0 = nan", "a number");
  expect_refused("evaluate", {"--reconstruction.relaxation", "1"}, "reconstruction.relaxation = 1",
                 "above -1 and below 1");
  expect_refused("evaluate", {"--simulation.truth", "real"}, "simulation.truth = real",
                 "one of extended, matched");
  expect_refused("evaluate", {"--detector.photons", "1e16"}, "detector.photons = 1e16", "1e+15");
  expect_refused("evaluate", {"--reconstruction.max_loops", "10001"},
                 "reconstruction.max_loops = 10001", "from 1 to 10000");
}

TEST_F(BadInput, OfValuesThatDoNotGoTogether) {
  expect_refused("evaluate", {"--seeing.fwhm", "0.8", "--seeing.fried_parameter", "10cm"},
                 "seeing.fried_parameter = 10cm", "set only one of");
  expect_refused("evaluate", {"--detector.read_noise", "3"}, "detector.read_noise = 3",
                 "needs detector.photons or detector.photon_rate above 0");
  expect_refused(
      "evaluate",
      {"--detector.photons", "1e5", "--detector.photon_rate", "1e8", "--detector.exposure", "1ms"},
      "detector.photon_rate = 1e8", "only one of it and detector.photons");
  expect_refused("evaluate", {"--detector.photon_rate", "1e8"}, "detector.photon_rate = 1e8",
                 "needs detector.exposure");
  expect_refused("evaluate", {"--detector.pupil_pixels", "15"}, "detector.pupil_pixels = 15",
                 "an even number");
  expect_refused("evaluate", {"--detector.window", "2.05"}, "detector.window = 2.05",
                 "even whole number of samples, but is 32.8; the nearest window is 2");
  expect_refused("evaluate", {"--detector.window", "0.5"}, "detector.window = 0.5", "from 1");
  expect_refused("evaluate", {"--reconstruction.window", "1.5"}, "reconstruction.window = 1.5",
                 "at least detector.window, which is 2");
  expect_refused("evaluate", {"--simulation.pupil_samples", "40"}, "simulation.pupil_samples = 40",
                 "a multiple of detector.pupil_pixels, which is 16");
  expect_refused("evaluate", {"--reconstruction.oversampling", "3"},
                 "reconstruction.oversampling = 3", "multiple or a divisor");
  expect_refused("evaluate",
                 {"--simulation.truth", "matched", "--reconstruction.oversampling", "2"},
                 "reconstruction.oversampling = 2", "1 with a matched truth");
  expect_refused("evaluate", {"--sensor.planes", "47km"}, "sensor.planes = 47km",
                 "at least 2 distances");
  expect_refused("evaluate", {"--sensor.planes", "47km,5000km"}, "sensor.planes = 5000km",
                 "distances within +-4699 km, where the Fresnel number is 0.1");
  expect_refused("evaluate", {"--telescope.central_obscuration", "0.99"},
                 "telescope.central_obscuration = 0.99", "leaves none of 16 x 16 samples");
  expect_refused("evaluate",
                 {"--detector.window", "1", "--simulation.pupil_samples", "8192", "--sensor.planes",
                  "47km,4000km"},
                 "sensor.planes = 4000km", "fewer samples reach farther");
  expect_refused("evaluate", {"--seeing.d_over_r0", "1e200"}, "seeing.d_over_r0 = 1e200", "10000");
  expect_refused("optimize", {"--search.exposure", "1ms:2ms"}, "search.exposure = 1ms:2ms",
                 "nothing without detector.photon_rate");
  expect_refused("evaluate", {"--reconstruction.tolerance", "1"}, "reconstruction.tolerance = 1",
                 "0.001 m");
  expect_refused("scale", {"--scale.relay_beam_diameter", "20"}, "scale.relay_beam_diameter = 20",
                 "from 1e-06 m to 1 m");
  expect_refused("optimize", {"--search.order", "12"}, "search.order = 12",
                 "an order of 4 planes, see search.plane_count");
  expect_refused("advise", {"--seeing.fried_parameter", "12"}, "seeing.fried_parameter = 12",
                 "a D/r0 from 0.1 to 10000, this is 0.042; r0 has its unit: 12cm");
  expect_refused("evaluate", {"--seeing.fwhm", "1e9"}, "seeing.fwhm = 1e9",
                 "a D/r0 from 0.1 to 10000, this is 4.7e+09; it is in arcsec");
  expect_refused("evaluate", {"--seeing.fried_parameter", "1nm"}, "seeing.fried_parameter = 1nm",
                 "a D/r0 from 0.1 to 10000");
  expect_refused("scale", {}, "scale.diameter = (nothing)", "such as --scale.diameter 8.2m");
}

TEST_F(BadInput, IsShownAsItIsTyped) {
  expect_refused("evaluate", {"--sensor.planes", "1e9km, 47km"}, "sensor.planes = 1e9km", "");
  expect_refused("evaluate", {"--detector.photons", "1e300"}, "detector.photons = 1e300", "");
  expect_refused("sweep", {"--sweep.z1", "1km:2km:2"}, "sweep.z1 = 1km:2km:2", "is for");
  expect_refused("optimize", {"--search.reconstruction_oversampling", "3"},
                 "reconstruction.oversampling = 3", "multiple or a divisor");
}

TEST_F(BadInput, OfRangesSaysWhy) {
  const auto expect_reason = [](const std::string& range, const std::string& why) {
    expect_refused("sweep", {"--sweep.z_near", range}, "sweep.z_near = " + range,
                   "such as 5km:100km:24; " + why + " (on the command line)");
  };
  expect_reason("60km:5km:3", "the minimum is not below the maximum");
  expect_reason("5km:5km:3", "the minimum is not below the maximum");
  expect_reason("5km:60km", "the count is missing");
  expect_reason("5km:60km:1", "at least 2 values");
  expect_reason("5km:60km:100000000", "at most 100000 values");
  expect_reason("0:60km:3:log", "log needs a minimum above 0");
  expect_refused("optimize", {"--search.z_near", "60km:5km"}, "search.z_near = 60km:5km",
                 "; the minimum is not below the maximum (");
  expect_refused("optimize", {"--search.order", "3412,1235"}, "search.order = 3412,1235",
                 "; 1235: 4 planes have the numbers 1 to 4 (");
  expect_refused("evaluate", {"--source.bands", "400:800"}, "source.bands = 400:800",
                 "; without a unit it is in m (");
  expect_refused("evaluate", {"--telescope.wavelength", "850"}, "telescope.wavelength = 850",
                 "; without a unit it is in m (");
}

TEST_F(BadInput, OfListsThatRepeatAValue) {
  const auto expect_twice = [](const std::string& command, const std::string& key,
                               const std::string& list, const std::string& value) {
    expect_refused(command, {"--" + key, list}, key + " = " + list,
                   "each value once, but " + value + " is twice");
  };
  expect_twice("optimize", "seeing.d_over_r0", "4,8,4.0", "4");
  expect_twice("optimize", "detector.photons", "1e4,10000", "1e4");
  expect_twice("optimize", "search.z_near", "20km,20000m", "20km");
  expect_twice("optimize", "search.initial_guess", "flat,flat", "flat");
  expect_twice("optimize", "search.order", "3412,3412", "3412");
  expect_twice("sweep", "sweep.z_near", "30km,30km", "30km");
  expect_twice("law", "law.d_over_r0", "3,3,3,3", "3");
  expect_twice("reproduce", "reproduce.figures", "3,3", "3");
  // Planes may be equal.
  done("evaluate", "equal", {"--sensor.planes", "30km,30km,-60km"});
}

TEST_F(BadInput, OfAResponse) {
  expect_refused("response", {"--response.frequencies", "0,1"}, "response.frequencies = 0,1",
                 "above 0");
  expect_refused("response", {"--response.frequencies", "5:1:3"}, "response.frequencies = 5:1:3",
                 "such as 1:16:16");
  expect_refused("response", {"--response.frequencies", "1,3,1"}, "response.frequencies = 1,3,1",
                 "each value once, but 1 is twice");
  expect_refused("response", {"--response.frequencies", "7.9,8"}, "response.frequencies = 8",
                 "below 8 cycles per pupil diameter, half of detector.pupil_pixels");
  expect_refused("response",
                 {"--response.frequencies", "9", "--simulation.truth", "matched",
                  "--detector.pupil_pixels", "18"},
                 "response.frequencies = 9", "below 9 cycles");
  expect_refused("response", {"--response.amplitude", "0"}, "response.amplitude = 0",
                 "a length above 0");
  expect_refused("response", {"--response.amplitude", "1rad"}, "response.amplitude = 1rad",
                 "a length above 0");
  expect_refused("response", {"--response.distances", "10km,-10km"},
                 "response.distances = 10km,-10km", "above 0");
  expect_refused("response", {"--response.distances", "10km,10000m"},
                 "response.distances = 10km,10000m", "each value once");
  expect_refused("response", {"--response.distances", "10km,5000km"}, "response.distances = 5000km",
                 "no pair of planes can be there");
  expect_refused("response", {"--sensor.planes", "47km"}, "sensor.planes = 47km",
                 "at least 2 distances");
  expect_refused("response", {"--simulation.pupil_samples", "40"}, "simulation.pupil_samples = 40",
                 "a multiple of detector.pupil_pixels");
  expect_refused("response", {"--screens.count", "1000000", "--simulation.pupil_samples", "64"},
                 "screens.count = 1000000", "GiB of memory");
  expect_refused("response", {"--detector.photons", "1e4,1e5"}, "detector.photons = 1e4,1e5",
                 "one value for this command");
}

TEST_F(BadInput, OfABenchmark) {
  expect_refused("benchmark", {"--detector.pupil_pixels", "15"}, "detector.pupil_pixels = 15",
                 "an even number");
  expect_refused("benchmark", {"--simulation.pupil_samples", "40"}, "simulation.pupil_samples = 40",
                 "a multiple of detector.pupil_pixels");
  expect_refused("benchmark", {"--simulation.pupil_samples", "64", "--screens.count", "1000000"},
                 "screens.count = 1000000", "GiB of memory");
  expect_refused("benchmark", {"--screens.file", "missing.fits"}, "screens.file = missing.fits",
                 "");
  expect_refused("benchmark", {"--search.budget", "0"}, "search.budget = 0", "from 1 to");
  expect_refused("benchmark", {"--threads", "-1"}, "--threads = -1", "from 0 (all cores)");
}

TEST_F(BadInput, OfASearch) {
  expect_refused("optimize", {"--verify.seed", "1"}, "verify.seed = 1",
                 "another seed than screens.seed");
  expect_refused("optimize", {"--search.optimizer", "sbplex"}, "search.optimizer = sbplex",
                 "direct_l, direct_l_rand, crs2, mlsl, isres, esch, sbplx, nelder_mead, bobyqa, "
                 "cobyla, praxis");
  expect_refused("optimize", {"--search.optimizer", "sbplx+direct_l"},
                 "search.optimizer = sbplx+direct_l", "such as direct_l+sbplx");
  expect_refused("optimize", {"--search.z_near", "50km:5km"}, "search.z_near = 50km:5km",
                 "min:max");
  expect_refused("optimize", {"--search.z_near", "-50km:-5km"}, "search.z_near = -50km:-5km",
                 "above 0");
  expect_refused("optimize", {"--search.z_far", "50km:5000km"}, "search.z_far = 50km:5000km",
                 "within +-4699 km, the farthest that a plane may be");
  expect_refused("optimize", {"--search.layout", "free", "--search.z1", "0:5km"},
                 "search.z1 = 0:5km", "neither of them 0");
  expect_refused("optimize", {"--search.z1", "5km:50km"}, "search.z1 = 5km:50km",
                 "search.layout = free");
  expect_refused("optimize", {"--search.layout", "free", "--search.z_near", "5km:50km"},
                 "search.z_near = 5km:50km", "search.layout = symmetric");
  expect_refused("optimize", {"--search.layout", "free", "--search.z5", "5km:50km"},
                 "search.z5 = 5km:50km", "4 planes, see search.plane_count");
  expect_refused("optimize", {"--baseline.planes", "47km"}, "baseline.planes = 47km",
                 "at least 2 distances");
  expect_refused("optimize", {"--search.plane_count", "3,3"}, "search.plane_count = 3,3",
                 "each value once");
  expect_refused("optimize", {"--search.order", "1224"}, "search.order = 1224",
                 "orders of plane numbers separated by commas, such as all or 3412,1234; 1224: "
                 "plane 2 is twice");
  expect_refused("optimize", {"--search.pupil_pixels", "16:64"}, "search.pupil_pixels = 16:64",
                 "a list");
  expect_refused("optimize",
                 {"--reconstruction.oversampling", "6", "--reconstruction.window", "2",
                  "--simulation.pupil_samples", "32", "--verify.truth_factor", "2"},
                 "verify.truth_factor = 2", "the finer truth does not suit the design");
  expect_refused("optimize", {"--search.budget", "0"}, "search.budget = 0", "from 1");
  expect_refused("optimize", {"--verify.screens", "1"}, "verify.screens = 1", "from 2");
}

TEST_F(BadInput, OfATrade) {
  expect_refused("trade", {"--trade.objectives", "total_wfe_nm"}, "trade.objectives = total_wfe_nm",
                 "at least two metrics");
  expect_refused("trade", {"--trade.objectives", "total_wfe_nm,model_second"},
                 "trade.objectives = model_second", "did you mean model_seconds? There are ");
  expect_refused("trade", {"--trade.objectives", "loops,loops"}, "trade.objectives = loops,loops",
                 "loops is twice");
  expect_refused("trade", {"--trade.objectives", "total_wfe_nm,seconds"},
                 "trade.objectives = total_wfe_nm,seconds", "take model_seconds");
  expect_refused("trade", {"--trade.objectives", "error_budget_nm,plane_count"},
                 "trade.objectives = error_budget_nm,plane_count",
                 "such as --objective.wind_speed 10");
  expect_refused("trade", {"--trade.reference", "100,0.5"}, "trade.reference = 100,0.5",
                 "4 numbers, one for each of trade.objectives, total_wfe_nm,model_seconds");
  expect_refused("trade", {"--trade.algorithm", "nsga"}, "trade.algorithm = nsga",
                 "one of nsga2, nspso");
  expect_refused("trade", {"--trade.population", "10"}, "trade.population = 10", "a multiple of 4");
  expect_refused("trade", {"--trade.population", "4"}, "trade.population = 4", "from 8");
  expect_refused("trade", {"--trade.budget", "0"}, "trade.budget = 0", "from 1");
  expect_refused("trade", {"--search.plane_count", "7"}, "search.plane_count = 7", "from 2 to 6");
  expect_refused("trade", {"--search.pupil_pixels", "12,16"}, "simulation.pupil_samples = 32",
                 "a multiple of detector.pupil_pixels, which is 12");
  expect_refused("trade", {"--simulation.truth", "matched", "--search.pupil_pixels", "8,16"},
                 "simulation.pupil_samples = 16", "a matched truth has the detector's 8 samples");
  expect_refused("trade", {"--detector.pupil_pixels", "15"}, "detector.pupil_pixels = 15",
                 "an even number");
  expect_refused("trade", {"--verify.seed", "1"}, "verify.seed = 1", "another seed");
  expect_refused("trade", {"--resume", "anywhere"}, "--resume = anywhere", "");
}

TEST_F(BadInput, OfTheObjective) {
  expect_refused("evaluate", {"--objective.kind", "error_budget"}, "objective.kind = error_budget",
                 "needs objective.wind_speed or objective.greenwood_frequency, such as "
                 "--objective.wind_speed 10");
  expect_refused("optimize", {"--objective.limits", "servo_wfe_nm<20"},
                 "objective.limits = servo_wfe_nm<20", "needs objective.wind_speed or");
  expect_refused(
      "optimize", {"--objective.greenwood_frequency", "30", "--objective.wind_speed", "10"},
      "objective.wind_speed = 10", "only one of it and objective.greenwood_frequency, which is 30");
  expect_refused("evaluate", {"--objective.terms", "latency:3"}, "objective.terms = latency:3",
                 "did you mean latency_seconds? There are residual_wfe_nm, ");
  expect_refused("optimize", {"--objective.penalties", "loops>3"}, "objective.penalties = loops>3",
                 "METRIC>BOUND:WEIGHT or METRIC<BOUND:WEIGHT");
  expect_refused("optimize", {"--objective.limits", "loops"}, "objective.limits = loops",
                 "METRIC<BOUND or METRIC>BOUND");
  expect_refused("evaluate", {"--objective.time_per_loop", "-1s"}, "objective.time_per_loop = -1s",
                 "a time above 0");
}

TEST_F(BadInput, OfSeveralConditionsWhereOneIsNeeded) {
  for (const char* command : {"evaluate", "scale", "screens", "benchmark"}) {
    expect_refused(command, {"--seeing.d_over_r0", "4,8"}, "seeing.d_over_r0 = 4,8",
                   "one value for this command");
    expect_refused(command, {"--detector.photons", "1e4,1e5"}, "detector.photons = 1e4,1e5",
                   "one value for this command");
  }
  expect_refused("evaluate", {"--seeing.fried_parameter", "10cm,12cm"},
                 "seeing.fried_parameter = 10cm,12cm", "one value for this command");
  expect_refused("optimize", {"--screens.file", "any.fits", "--seeing.d_over_r0", "4,8"},
                 "screens.file = any.fits", "its screens have one seeing");
  expect_refused("optimize", {"--objective.level", "1"}, "objective.level = 1",
                 "above 0 and below 1");
}

TEST_F(BadInput, OfMoreMemoryThanIsAllowed) {
  expect_refused("screens", {"--screens.count", "1000000", "--simulation.pupil_samples", "64"},
                 "screens.count = 1000000",
                 "1000000 screens of 64 x 64 samples take 30.5 GiB of memory; at most 524288 of "
                 "them fit into the 16 GiB allowed");
  expect_refused("optimize", {"--verify.screens", "1000000"}, "verify.screens = 1000000",
                 "take 30.5 GiB of memory");
  expect_refused("response",
                 {"--response.frequencies", "0.1:4:1001", "--response.distances", "1km:9km:1000"},
                 "response.distances = 1km:9km:1000", "at most 999 with 1001 frequencies");
  expect_refused("evaluate", {"--simulation.pupil_samples", "8192"}, "detector.window = 2",
                 "at most 1 pupil diameters of 8192 samples");
  expect_refused("evaluate",
                 {"--reconstruction.window", "64", "--detector.pupil_pixels", "256",
                  "--simulation.pupil_samples", "256"},
                 "reconstruction.window = 64", "at most 32 pupil diameters of 256 samples");
  expect_refused("optimize",
                 {"--simulation.pupil_samples", "256", "--verify.truth_factor", "16",
                  "--detector.window", "4"},
                 "verify.truth_factor = 16", "at most 8: the search's true field is 1024 samples");
}

TEST_F(BadInput, OfFilesOfScreens) {
  const auto expect_file_refused = [](const std::string& file, const std::string& allowed) {
    expect_refused("evaluate", {"--screens.file", file}, "screens.file = " + file, allowed);
  };
  const std::string long_name(150, 'x');
  expect_file_refused("missing.fits", "there is no such file");
  expect_file_refused("missing/" + long_name + "/" + long_name + ".fits", "n x n x count");
  expect_file_refused(".", "this is a directory");
  std::ofstream("garbage.fits") << "no FITS file at all";
  expect_file_refused("garbage.fits", "it cannot be read");

  const auto save = [](const std::string& name, Image<double> slice, const std::string& unit) {
    write_fits_cube(name, {unit, {std::move(slice)}});
  };
  save("tiny.fits", Image<double>::Zero(1, 1), "rad");
  expect_file_refused("tiny.fits", "at least 2 x 2 samples");
  save("unit.fits", Image<double>::Zero(32, 32), "nm");
  expect_file_refused("unit.fits", "BUNIT must be 'rad' or 'm', but is 'nm'");
  Image<double> with_nan = Image<double>::Zero(32, 32);
  with_nan(13, 14) = std::nan("");
  save("nan.fits", with_nan, "rad");
  expect_file_refused("nan.fits", "values that are not finite");
}

TEST_F(BadInput, OfShapesInFilesOfScreens) {
  const auto expect_shape_refused = [](const std::vector<int>& shape, const std::string& why) {
    std::string header = fmt::format("{:<80}{:<80}", "SIMPLE  =                    T",
                                     "BITPIX  =                  -64");
    header += fmt::format("{:<80}", fmt::format("NAXIS   = {:>20}", shape.size()));
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
      header += fmt::format("{:<80}", fmt::format("NAXIS{}  = {:>20}", axis + 1, shape[axis]));
    }
    header += fmt::format("{:<80}", "END");
    std::ofstream("shape.fits") << fmt::format("{:<2880}", header) << std::string(28800, '\0');
    expect_refused("evaluate", {"--screens.file", "shape.fits"}, "screens.file = shape.fits", why);
  };
  expect_shape_refused({32}, "NAXIS is 1");
  expect_shape_refused({32, 31}, "its slices are 32 x 31, not square");
  expect_shape_refused({3, 2, 2, 2}, "NAXIS is 4");
  expect_shape_refused({100000, 100000}, "take 74.5 GiB of memory, and 16 GiB are allowed");
  expect_shape_refused({200, 200}, "it cannot be read: it is cut short");
  std::ofstream("packed.fits") << "\x1f\x8b";
  expect_refused("evaluate", {"--screens.file", "packed.fits"}, "screens.file = packed.fits",
                 "compressed and must be unpacked first");
}

TEST_F(BadInput, OfAnOutputFolderThatExists) {
  std::filesystem::create_directory("mine");
  std::ofstream("mine/precious") << "data";
  for (const char* command : {"evaluate", "optimize", "screens", "scale"}) {
    const ProgramRun refused = run({command, "--config", "tiny.cfg", "--output", "mine"});
    EXPECT_EQ(refused.exit_code, 2);
    expect_one_line(refused);
    EXPECT_THAT(refused.errors, StartsWith("nlcwfs: --output = mine: exists"));
  }
  EXPECT_EQ(names_in("mine").size(), 1u);
}

TEST_F(BadInput, OfAnOutputFolderThatCannotBeMade) {
  std::ofstream("file") << "in the way";
  // Not even root makes folders in /proc.
  for (const std::string folder : {"file/run", "/proc/run"}) {
    const ProgramRun refused = run({"evaluate", "--config", "tiny.cfg", "--output", folder});
    EXPECT_EQ(refused.exit_code, 2);
    expect_one_line(refused);
    EXPECT_THAT(refused.errors,
                AllOf(StartsWith("nlcwfs: --output = " + folder + ": cannot be made ("),
                      HasSubstr("name a folder where you may write")));
  }
}

TEST_F(BadInput, IsNotToBlameForAFullDisk) {
  // No file may be longer than a few blocks: writing fails as on a full disk.
  for (const char* command : {"evaluate", "screens"}) {
    const ProgramRun failed =
        run({command, "--config", "tiny.cfg", "--output", command}, "trap '' XFSZ; ulimit -f 4; ");
    EXPECT_EQ(failed.exit_code, 1);
    expect_one_line(failed);
    EXPECT_THAT(failed.errors, StartsWith("nlcwfs: failed: cannot "));
    EXPECT_THAT(failed.errors, HasSubstr(std::string(command) + '/'));
  }
}

TEST_F(BadInput, IsNotToBlameWhereStandardOutputIsFull) {
  const ProgramRun failed = run({"evaluate", "--config", "tiny.cfg", "--output", "run"},
                                "full() { \"$@\" > /dev/full; }; full ");
  EXPECT_EQ(failed.exit_code, 1);
  expect_one_line(failed);
  EXPECT_THAT(failed.errors, HasSubstr("cannot write to standard output: No space left"));
  EXPECT_TRUE(std::filesystem::exists("run/summary.json")) << "the results are safe";
}

}  // namespace
}  // namespace nlcwfs
