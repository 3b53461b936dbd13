#include "studies/command_line/commands.hpp"

#include "studies/command_line/command_line.hpp"
#include "studies/command_line/manual_page.hpp"
#include "studies/command_line/shell_completion.hpp"
#include "studies/commands/run_functions.hpp"

#include <algorithm>
#include <initializer_list>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Keys = std::vector<std::string>;

/// What every command that knows a telescope reads.
const Keys site{"telescope", "seeing"};
/// What a simulation of one design takes besides.
const Keys simulation{"source", "screens", "sensor", "detector", "reconstruction", "simulation"};
/// What judges a design.
const Keys judgement{"objective"};
/// What a search may vary, and how it does that.
const Keys space{"search.detector_window",
                 "search.exposure",
                 "search.initial_guess",
                 "search.layout",
                 "search.order",
                 "search.plane_count",
                 "search.precision",
                 "search.pupil_pixels",
                 "search.reconstruction_oversampling",
                 "search.reconstruction_window",
                 "search.relaxation",
                 "search.relaxation_end",
                 "search.relaxation_start",
                 "search.seed",
                 "search.time_limit",
                 "search.tolerance",
                 "search.z1",
                 "search.z2",
                 "search.z3",
                 "search.z4",
                 "search.z5",
                 "search.z6",
                 "search.z_far",
                 "search.z_near",
                 "search.z_third"};
/// What finds one best design in it.
const Keys search{"search", "baseline", "verify"};
/// How a design is simulated on screens that no search has seen.
const Keys fresh_screens{"verify.screens", "verify.seed", "verify.truth_factor"};

/// Lengths of other sections that scale with a design.
const Keys moved_lengths{"baseline.planes",    "objective.wfe_scale",
                         "response.distances", "search.tolerance",
                         "search.z1",          "search.z2",
                         "search.z3",          "search.z4",
                         "search.z5",          "search.z6",
                         "search.z_far",       "search.z_near",
                         "search.z_third",     "sweep.tolerance",
                         "sweep.z1",           "sweep.z2",
                         "sweep.z3",           "sweep.z4",
                         "sweep.z5",           "sweep.z6",
                         "sweep.z_far",        "sweep.z_near",
                         "sweep.z_third"};

Keys joined(std::initializer_list<Keys> lists) {
  Keys all;
  for (const Keys& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

constexpr const char* one_design = "One design";
constexpr const char* best_designs = "The best design";
constexpr const char* laws = "Laws and scaling";
constexpr const char* results = "Results of a run";
constexpr const char* others = "The paper and this machine";

}  // namespace

bool Command::reads(std::string_view key) const {
  return std::ranges::any_of(keys, [&](std::string_view wanted) {
    return key == wanted || (key.starts_with(wanted) && key.substr(wanted.size()).starts_with('.'));
  });
}

const std::vector<Command>& commands() {
  static const std::vector<Command> known{
      {.name = "evaluate",
       .group = one_design,
       .description = "measure one design: wavefront error, loops and time with standard errors",
       .about = "Simulates the sensor of the sections sensor, detector and reconstruction on the "
                "wavefronts of the section screens, and says how well and how fast it recovers "
                "them. Every metric of every wavefront is in screens.csv.",
       .keys = joined({site, simulation, judgement}),
       .examples = {"nlcwfs evaluate --telescope.diameter 1.8 --seeing.fried_parameter 24cm",
                    "nlcwfs evaluate --config results/optimize-1/best.cfg --screens.count 256"},
       .run = run_evaluate,
       .resumable = true},
      {.name = "convergence",
       .group = one_design,
       .description = "follow one design's residual wavefront error from loop to loop",
       .about = "Runs all of reconstruction.max_loops on each wavefront, whatever the tolerance, "
                "and gives the residual wavefront error after each loop as a table and a picture.",
       .keys = joined({site, simulation, judgement}),
       .examples = {"nlcwfs convergence --source.bands 400nm:800nm --source.division split"},
       .run = run_convergence},
      {.name = "response",
       .group = one_design,
       .description =
           "measure how much of single spatial frequencies a design recovers, beside prediction",
       .about = "Puts sinusoidal wavefronts before the sensor, one frequency at a time, and "
                "measures the recovered share; with response.distances also that of pairs of "
                "planes at these distances, as maps. Beside it stand the contrast and the photon "
                "noise that theory lets expect.",
       .keys = joined({site, simulation, {"response"}}),
       .examples = {"nlcwfs response --response.distances 1km:200km:20:log --detector.photons 1e7"},
       .run = run_response},
      {.name = "reconstruct",
       .group = one_design,
       .description =
           "reconstruct the wavefronts of measured detector frames, and say whether they agree",
       .about = "Calibrates the frames of the section frames, runs the loop of the section "
                "reconstruction on them, and writes the phases as phase.fits, which can be the "
                "screens.file of the other commands. What the phases predict for each plane is "
                "held against what was measured there.",
       .keys = joined({site, {"frames", "sensor", "detector", "reconstruction"}}),
       .examples = {"nlcwfs reconstruct --frames frames.fits "
                    "--sensor.planes=-120km,120km,-30km,30km --frames.background dark.fits"},
       .run = run_reconstruct},
      {.name = "screens",
       .group = one_design,
       .description = "make phase screens: a FITS cube and its statistics",
       .about =
           "Writes the wavefronts that the other commands use as screens.fits, and holds their "
           "variances and structure function against theory.",
       .keys = joined({site, {"screens", "simulation.truth", "simulation.pupil_samples"}}),
       .examples = {"nlcwfs screens --screens.count 100 --seeing.outer_scale 25"},
       .run = run_screens},
      {.name = "sweep",
       .group = best_designs,
       .description = "try every design of a grid: maps of all figures, and the best, verified",
       .about = "Tries all designs of the axes of the section sweep, maps every metric over them, "
                "and verifies the best few on fresh screens. It is what a search is checked "
                "against.",
       .keys = joined({site, simulation, judgement, {"sweep", "verify", "search.precision"}}),
       .examples = {"nlcwfs sweep --sweep.z_near 5km:100km:24:log --sweep.z_far 50km:235km:24:log",
                    "nlcwfs sweep --resume results/sweep-1"},
       .run = run_sweep,
       .resumable = true},
      {.name = "optimize",
       .group = best_designs,
       .description = "find a telescope's best design and verify it on fresh screens",
       .about =
           "Searches what the section search lets vary for the lowest cost of the section "
           "objective, verifies the best few designs on fresh screens beside the baseline, and "
           "tells how far each variable may move. best.cfg holds the winner.",
       .keys = joined({site, simulation, judgement, search}),
       .examples =
           {"nlcwfs optimize --telescope.diameter 1.8 --telescope.wavelength 850nm "
            "--seeing.fwhm 0.9",
            "nlcwfs optimize --search.layout free --search.plane_count 3,4 --detector.photons "
            "1e5"},
       .run = run_optimize,
       .resumable = true},
      {.name = "compare",
       .group = best_designs,
       .description =
           "hold a search against a sweep: both best designs on fresh screens, and what each cost",
       .about =
           "Takes the folders of a sweep and of a search for the same telescope, simulates the "
           "best design of each on screens that neither has seen, and gives the paired "
           "difference of their costs.",
       .keys = fresh_screens,
       .examples = {"nlcwfs compare results/sweep-1 results/optimize-1"},
       .run = run_compare,
       .arguments = {"SWEEP", "OPTIMIZE"}},
      {.name = "trade",
       .group = best_designs,
       .description = "try several objectives at once: the front of the best compromises, verified",
       .about =
           "Searches designs that no other betters in all of trade.objectives, over numbers of "
           "planes and pixels, and verifies the front on fresh screens. front.csv has the "
           "front, knee.cfg its knee.",
       .keys = joined({site, simulation, judgement, space, fresh_screens, {"trade"}}),
       .examples = {"nlcwfs trade --trade.objectives total_wfe_nm,model_seconds,plane_count"},
       .run = run_trade,
       .resumable = true},
      {.name = "law",
       .group = laws,
       .description = "fit the scaling law that advise follows to the best designs at several D/r0",
       .about = "Searches the best symmetric design at each of law.d_over_r0 and fits lines to the "
                "planes and what they reach. Its law.json can be the advise.law of another day.",
       .keys =
           joined({{"telescope", "seeing.outer_scale"}, simulation, judgement, search, {"law"}}),
       .examples = {"nlcwfs law --law.d_over_r0 3,4,6,8"},
       .run = run_law,
       .resumable = true},
      {.name = "advise",
       .group = laws,
       .description = "tell a telescope's planes from the scaling law; --verify simulates them",
       .about =
           "Gives the planes of a telescope at once, with the error and the loops that the law "
           "predicts; with --verify they are simulated on fresh screens too.",
       .keys =
           joined({site,
                   {"source", "screens.seed", "sensor", "detector", "reconstruction", "simulation"},
                   judgement,
                   fresh_screens,
                   {"advise"}}),
       .examples = {"nlcwfs advise --telescope.diameter 8.2 --seeing.fried_parameter 1m --verify"},
       .run = run_advise},
      {.name = "scale",
       .group = laws,
       .description = "move a design to another telescope or bench at equal Fresnel numbers",
       .about = "Moves the configured planes to the telescope of the section scale, where they see "
                "the same diffraction, and writes the moved design as scaled.cfg.",
       .keys = joined({site,
                       {"sensor", "source.bands", "detector", "reconstruction", "scale"},
                       moved_lengths}),
       .examples = {"nlcwfs scale --config results/optimize-1/best.cfg --scale.diameter 8.2 "
                    "--scale.relay_beam_diameter 10mm"},
       .run = run_scale},
      {.name = "report",
       .group = results,
       .description = "make the page report.html of a run's folder again",
       .about = "Every run leaves report.html, a page that shows its results in a browser. This "
                "makes it anew from the files that are in the folder, also where some are missing "
                "or another version has written them, and says so. It writes nothing else.",
       .keys = {},
       .examples = {"nlcwfs report results/optimize-1"},
       .run = run_report,
       .arguments = {"DIR"}},
      {.name = "export",
       .group = results,
       .description = "write a run's archive as flat tables: CSV, JSON, FITS",
       .about =
           "Takes the folder of a run, or its archive.sqlite, and writes a row for every design "
           "that was evaluated, with its planes, its properties and every metric with its "
           "standard error.",
       .keys = {"export"},
       .examples = {"nlcwfs export results/optimize-1 --export.formats csv,fits"},
       .run = run_export,
       .arguments = {"RUN"}},
      {.name = "reproduce",
       .group = others,
       .description =
           "run every study of Letchev et al. 2022 and hold its claims against the results",
       .about = "Runs the paper's figures in its own set-up and with an extended truth, and judges "
                "its claims one by one. It takes about an hour; --figure N runs a part, and an "
                "interrupted run goes on with --resume.",
       .keys = {"screens.count", "screens.seed", "detector", "reconstruction",
                "simulation.pupil_samples", "simulation.precision", "objective", "search.precision",
                "verify", "response.frequencies", "response.amplitude", "reproduce"},
       .examples = {"nlcwfs reproduce --figure 8 --screens.count 4"},
       .run = run_reproduce,
       .resumable = true},
      {.name = "benchmark",
       .group = others,
       .description = "time a configuration on this machine; writes files only with --output",
       .about = "Takes about five seconds and says what loops, designs and a whole search of the "
                "configuration cost on this machine.",
       .keys = joined({site, simulation, {"search.budget", "search.time_limit"}}),
       .examples = {"nlcwfs benchmark --detector.pupil_pixels 128 --threads 8"},
       .run = run_benchmark},
      {.name = "manual",
       .group = others,
       .description = "print the manual page, nlcwfs(1)",
       .about = "It has every command, option and key on one page. An installed nlcwfs has it as "
                "man nlcwfs.",
       .keys = {},
       .examples = {"nlcwfs manual | man -l -"},
       .run = run_manual},
      {.name = "completion",
       .group = others,
       .description = "print what lets a shell complete commands, keys and their words",
       .about =
           "Knows bash, zsh and fish; source <(nlcwfs completion bash) turns it on in this bash. "
           "An installed nlcwfs has them in their usual places.",
       .keys = {},
       .examples = {"nlcwfs completion fish > ~/.config/fish/completions/nlcwfs.fish"},
       .run = run_completion,
       .arguments = {"SHELL"}}};
  return known;
}

const Command& command_of(std::string_view name) {
  return *std::ranges::find(commands(), name, &Command::name);
}

std::string resume_command(std::string_view command, const std::filesystem::path& folder) {
  return fmt::format("nlcwfs {} --resume {}", command, folder.string());
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return names;
}

void print_ignored_keys(const CommandLine& command_line) {
  const Command& command = command_of(command_line.command);
  std::vector<std::string> ignored;
  for (const ConfigurationKey& key : configuration_keys()) {
    if (command_line.configuration.source(key.name) == "on the command line" &&
        !command.reads(key.name)) {
      ignored.push_back(key.name);
    }
  }
  if (ignored.empty()) return;
  fmt::print("note: {0} does not use {1}; nlcwfs {0} --help lists what it uses\n", command.name,
             fmt::join(ignored, ", "));
}

}  // namespace nlcwfs
