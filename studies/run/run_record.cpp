// What every run leaves in its folder.
#include "studies/run/run_record.hpp"

#include "model/input_error.hpp"
#include "results/archive/archive_memory.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "studies/run/page_data.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/text.hpp"

#include <spdlog/spdlog.h>

namespace nlcwfs {

namespace {

std::optional<Archive> reused(const Request& request) {
  if (!request.reuse) return std::nullopt;
  return Archive::reopened(*request.reuse / "archive.sqlite");
}

/// What the run has made so far. Of an older version, which noted nothing: what surely is its own.
std::vector<RunFile> made_files(const Request& request, const Archive& archive) {
  std::vector<RunFile> made;
  if (const auto noted = archive.noted_files()) {
    for (const std::string& name : *noted) {
      made.push_back({name});
      const std::vector<RunFile> pictures = picture_files({name});
      made.insert(made.end(), pictures.begin(), pictures.end());
    }
  } else {
    std::ranges::copy_if(request.command->files, std::back_inserter(made), [](const RunFile& file) {
      return file.name.find('*') == std::string::npos;
    });
  }
  return made;
}

/// A run that is gone on with overwrites no file that it has not made.
void require_no_others(const Request& request, std::span<const RunFile> made) {
  for (const auto& entry : std::filesystem::directory_iterator(*request.resume)) {
    const std::string name = entry.path().filename().string();
    const bool is_written = std::ranges::any_of(
        request.command->files, [&](const RunFile& file) { return file.name == name; });
    if (!is_written || is_named(name, made)) continue;
    throw InputError("--resume", one_line(request.resume->string()),
                     fmt::format("has a file {} that the run has not made and would write", name),
                     "move it elsewhere");
  }
}

}  // namespace

bool is_complete(const std::filesystem::path& folder) {
  try {
    const nlohmann::ordered_json summary = json_of(text_of_file(folder / "summary.json"));
    return summary.is_object() && summary.contains("interrupted") &&
           summary.at("interrupted") == false;
  } catch (const std::runtime_error&) {
    return false;  // there is none that can be read
  }
}

RunRecord::RunRecord(const Request& request)
    : request_(request),
      folder_(request.resume ? OutputFolder::of_earlier_run(*request.resume)
                             : OutputFolder(request.output, request.command->name)),
      lock_(request.resume ? std::make_unique<FolderLock>(folder_.path()) : nullptr),
      archive_(request.resume ? Archive::reopened(folder_.file("archive.sqlite"))
                              : Archive(folder_.file("archive.sqlite"), request.command->name)),
      memory_(std::make_shared<ArchiveMemory>(archive_, reused(request))) {
  if (request.resume) {
    archive_.clear_evaluations();
    const std::vector<RunFile> made = made_files(request, archive_);
    require_no_others(request, made);
    folder_.remove_results(made);
  } else {
    // Last: a folder that has it has all that it takes to go on.
    folder_.write("config.cfg", request.configuration.dump());
    lock_ = std::make_unique<FolderLock>(folder_.path());
  }
  folder_.tell_writes([this](const std::string& name) { archive_.note_file(name); });
  if (!request.silent) print_notes_on_keys(request);
}

std::string RunRecord::how_to_go_on() const {
  return "go on with: " + resume_command(*request_.command, folder_.path());
}

std::string RunRecord::how_to_try_again() const {
  if (request_.command->resumption == Resumption::none) return {};
  return "; to try it again: " + resume_command(*request_.command, folder_.path());
}

void RunRecord::adopt(DesignTrial& trial) const {
  trial.remember_in(memory_);
  trial.run_on(request_.runner);
}

void RunRecord::note_interrupted(const std::string& what) {
  if (request_.silent) throw RunInterrupted(fmt::format("interrupted when {}", what));
  interruption_ = what;
}

void RunRecord::note_missing_screens(const TriedDesign& tried, const DesignTrial& trial) {
  const auto done = static_cast<int>(tried.costs.size());
  if (done == trial.screen_count()) return;
  note_interrupted(fmt::format("{} of {} screens were done", done, trial.screen_count()));
}

void RunRecord::add(const ArchivedEvaluation& evaluation) {
  archive_.add(evaluation);
  if (evaluation.failure.empty()) {
    spdlog::debug("{}: a design, cost {:.6g}, {:.3g} s", evaluation.stage, evaluation.cost,
                  evaluation.seconds);
  } else {
    spdlog::debug("{}: a design failed, {:.3g} s: {}", evaluation.stage, evaluation.seconds,
                  without_controls(evaluation.failure));
  }
}

void RunRecord::write_design(std::string_view file, const SensorDesign& design,
                             const DesignSpace& space, std::string_view source) const {
  Configuration configuration = request_.configuration;
  set_design(configuration, design, space, source);
  folder_.write(file, configuration.dump());
}

void RunRecord::write_summary(const nlohmann::ordered_json& results) {
  // Before the run counts as complete.
  archive_.commit();
  folder_.sync();
  nlohmann::ordered_json config;
  for (const ConfigurationKey& key : configuration_keys()) {
    const std::string& value = request_.configuration.value_text(key.name);
    config[key.name] = nullptr;
    if (!value.empty()) config[key.name] = value;
  }
  nlohmann::ordered_json summary{{"command", request_.command->name},
                                 {"version", version()},
                                 {"interrupted", !interruption_.empty()},
                                 {"config", config}};
  summary.update(results);
  folder_.write("summary.json", summary.dump(2) + "\n");
  if (request_.silent) return;
  try {
    write_page(folder_.path(), *request_.command);
  } catch (const std::exception& error) {
    fmt::print("note: there is no report.html: {}\n", error.what());
  }
}

void RunRecord::close() const {
  if (!interruption_.empty()) {
    print("Interrupted when {}: the results are of these.\n", interruption_);
    if (request_.command->resumption != Resumption::none) {
      print("Go on with: {}\n", resume_command(*request_.command, folder_.path()));
    }
  }
  const std::filesystem::path page = folder_.file("report.html");
  if (std::filesystem::exists(page)) print("Open {} in a browser.\n", page.string());
  print("Results are in {}.\n", folder_.path().string());
  if (!interruption_.empty()) throw RunInterrupted();
}

}  // namespace nlcwfs
