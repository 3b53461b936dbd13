// reproduce: Every study of Letchev et al. 2022, and what their claims have come to.
#include "model/input_error.hpp"
#include "results/archive/run_files.hpp"
#include "results/tables/json_numbers.hpp"
#include "studies/commands/commands.hpp"
#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/report.hpp"
#include "studies/run/command.hpp"
#include "studies/run/interrupt.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/request.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/stopwatch.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/verified_ranking.hpp"
#include "studies/settings/setup.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Whether the folder of a run has the run's configuration, so that what it holds may be kept.
bool is_of(const PlannedRun& run, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "config.cfg")) return false;
  try {
    Configuration kept;
    kept.read_file(folder / "config.cfg");
    return kept == run.configuration;
  } catch (const InputError&) {
    return false;  // of a version that had other keys
  }
}

bool has_archive(const std::filesystem::path& folder) {
  const std::filesystem::path archive = folder / "archive.sqlite";
  // A run that was killed at once leaves an empty one.
  return std::filesystem::exists(archive) && std::filesystem::file_size(archive) > 0;
}

/// Runs what of the plan is not done yet.
void run_missing(const std::vector<PlannedRun>& runs, const RunRecord& record,
                 const std::shared_ptr<TrialRunner>& runner) {
  const std::filesystem::path& folder = record.folder().path();
  const auto is_done = [&](const PlannedRun& run) {
    const std::filesystem::path path = folder / run.folder;
    return is_of(run, path) && is_complete(path);
  };
  double all = 0.0;
  double done = 0.0;
  for (const PlannedRun& run : runs) {
    all += work_of(run);
    if (is_done(run)) done += work_of(run);
  }
  Progress progress("reproduce", all, "transforms");
  progress.starts_at(done);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (is_done(runs[i])) continue;
    const std::string place = fmt::format("part {} of {} ({})", i + 1, runs.size(), runs[i].folder);
    progress.describe(place);
    progress.at(done, work_of(runs[i]));
    const std::filesystem::path path = folder / runs[i].folder;
    Request part{.command = &command_of(runs[i].command),
                 .configuration = runs[i].configuration,
                 .output = path,
                 .runner = runner,
                 .silent = true,
                 .whole = &progress};
    if (is_of(runs[i], path) && part.command->resumption != Resumption::none && has_archive(path)) {
      part.resume = path;
    } else {
      std::filesystem::remove_all(path);  // what a killed run has left, which cannot go on
      std::filesystem::create_directories(path.parent_path());
    }
    try {
      if (InterruptWatch::interrupted()) throw RunInterrupted();
      part.command->run(part);
    } catch (const InputError&) {
      throw;
    } catch (const RunInterrupted&) {
      throw RunInterrupted(fmt::format("in {}; {}", place, record.how_to_go_on()));
    } catch (const VerificationFailed& failure) {
      throw std::runtime_error(
          fmt::format("{}: {}; {}", runs[i].folder, failure.what_failed(), record.how_to_go_on()));
    } catch (const std::exception& error) {
      throw std::runtime_error(
          fmt::format("{}: {}; {}", runs[i].folder, error.what(), record.how_to_go_on()));
    }
    done += work_of(runs[i]);
  }
}

Json claims_array(const std::vector<Claim>& claims) {
  Json array = Json::array();
  for (const Claim& claim : claims) {
    Json json{{"figure", claim.figure},
              {"claim", claim.sentence},
              {"papers_number", claim.papers},
              {"rule", claim.rule}};
    for (const StudySetup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      json[std::string(to_string(setup))] = {{"number", finding.number},
                                             {"verdict", to_string(finding.verdict)},
                                             {"why", finding.why}};
    }
    array.push_back(std::move(json));
  }
  return array;
}

void run_reproduce(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  if (configuration.integer("screens.count") < 2) {
    throw InputError("screens.count", configuration.value_text("screens.count"),
                     "at least 2 with reproduce: a mean needs its standard error");
  }
  const Stopwatch stopwatch;
  const std::vector<std::string> figures = figures_of(configuration);
  const std::vector<PlannedRun> runs = planned_runs(configuration);
  RunRecord record(request);
  const std::filesystem::path& folder = record.folder().path();
  run_missing(runs, record, request.runner);

  const ReproducedRuns reproduced(folder);
  const std::vector<Claim> claims = checked_claims(reproduced, figures);
  const std::vector<std::string> notes = write_reproduction_report(
      record.folder(), reproduced, claims, figures, configuration.integer("screens.count"));
  Json names = Json::array();
  for (const PlannedRun& run : runs) names.push_back(run.folder);
  record.write_summary(
      {{"runs", names}, {"claims", claims_array(claims)}, {"wall_seconds", stopwatch.seconds()}});

  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  for (const Claim& claim : claims) {
    fmt::print("Figure {}: {} ({})\n", claim.figure, claim.sentence, claim.papers);
    for (const StudySetup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      fmt::print("  {:<8} {:<20} {}\n", to_string(setup), to_string(finding.verdict),
                 finding.number);
    }
  }
  fmt::print(
      "\nIn the paper's set-up: {}.\nWith an extended truth and the rule difference: {}.\n"
      "report.md has every claim and figure.\n",
      count_text(claims, StudySetup::paper), count_text(claims, StudySetup::extended));
  record.close();
}

std::string of_reproduce(const Json& summary) {
  const Json& claims = summary.at("claims");
  std::string text;
  for (const auto& [setup, title] :
       {std::pair{"paper", "In the paper's set-up"}, {"extended", "with an extended truth"}}) {
    std::map<std::string, int> counts;
    for (const Json& claim : claims) ++counts[claim.at(setup).at("verdict").get<std::string>()];
    std::vector<std::string> parts;
    parts.reserve(counts.size());
    for (const auto& [verdict, count] : counts) {
      parts.push_back(fmt::format("{} {}", count, verdict));
    }
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", title, fmt::join(parts, ", "));
  }
  return fmt::format("Of {} claims: {}.", claims.size(), text);
}

}  // namespace

Command reproduce_command() {
  return {
      .name = "reproduce",
      .group = "The paper and this machine",
      .description =
          "run every study of Letchev et al. 2022 and hold its claims against the results",
      .about =
          "Runs the paper's figures in its own set-up and with an extended truth, and judges "
          "its claims one by one. It takes about an hour; --figure N runs a part, and an "
          "interrupted run goes on with --resume.",
      .keys = {"screens.count", "screens.seed", "detector", "reconstruction",
               "simulation.pupil_samples", "simulation.precision", "objective", "search.precision",
               "verify", "response.frequencies", "response.amplitude", "reproduce"},
      .examples = {"nlcwfs reproduce --figure 8 --screens.count 4"},
      .run = run_reproduce,
      .resumption = Resumption::by_parts,
      .options = {{.name = "figure",
                   .value_name = "N",
                   .description = "run only this figure of the paper, or another part that "
                                  "reproduce.figures knows; may be given several times",
                   .key = "reproduce.figures",
                   .choices = figures_of(Configuration()),
                   .repeats = true}},
      .files = {{"report.md"},
                {"claims.csv", FileRole::table},
                {"figure-*.csv", FileRole::table, false},
                {"numerics.csv", FileRole::table, false},
                {"response*.csv", FileRole::table, false},
                {"figure-*"},
                {"response*"}},
      .verdict = of_reproduce};
}

}  // namespace nlcwfs
