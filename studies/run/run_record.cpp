#include "studies/run/run_record.hpp"

#include "results/archive/archive_memory.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "studies/command_line/commands.hpp"
#include "studies/commands/report.hpp"
#include "studies/run/version.hpp"

#include <fmt/format.h>

namespace nlcwfs {

namespace {

std::optional<Archive> reused(const CommandLine& command_line) {
  if (!command_line.reuse) return std::nullopt;
  return Archive::reopened(*command_line.reuse / "archive.sqlite");
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

RunRecord::RunRecord(const CommandLine& command_line)
    : command_line_(command_line),
      folder_(command_line.resume ? OutputFolder::of_earlier_run(*command_line.resume)
                                  : OutputFolder(command_line.output, command_line.command)),
      lock_(command_line.resume ? std::make_unique<FolderLock>(folder_.path()) : nullptr),
      archive_(command_line.resume ? Archive::reopened(folder_.file("archive.sqlite"))
                                   : Archive(folder_.file("archive.sqlite"), command_line.command)),
      memory_(std::make_shared<ArchiveMemory>(archive_, reused(command_line))) {
  if (command_line.resume) {
    archive_.clear_evaluations();
    folder_.remove_results();
  } else {
    // Last: a folder that has it has all that it takes to go on.
    folder_.write("config.cfg", command_line.configuration.dump());
    lock_ = std::make_unique<FolderLock>(folder_.path());
  }
  if (!command_line.silent) print_ignored_keys(command_line);
}

std::string RunRecord::how_to_go_on() const {
  return "go on with: " + resume_command(command_line_.command, folder_.path());
}

void RunRecord::adopt(DesignTrial& trial) const {
  trial.remember_in(memory_);
  trial.run_on(command_line_.runner);
}

void RunRecord::note_interrupted(const std::string& what) {
  if (command_line_.silent) throw RunInterrupted(fmt::format("interrupted when {}", what));
  interruption_ = what;
}

void RunRecord::note_missing_screens(const TriedDesign& tried, const DesignTrial& trial) {
  const auto done = static_cast<int>(tried.costs.size());
  if (done == trial.screen_count()) return;
  note_interrupted(fmt::format("{} of {} screens were done", done, trial.screen_count()));
}

void RunRecord::write_summary(const nlohmann::ordered_json& results) {
  // Before the run counts as complete.
  archive_.commit();
  folder_.sync();
  nlohmann::ordered_json config;
  for (const ConfigurationKey& key : configuration_keys()) {
    const Configuration& configuration = command_line_.configuration;
    const std::string& value = configuration.value_text(key.name);
    config[key.name] =
        value.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(value);
  }
  nlohmann::ordered_json summary{{"command", command_line_.command},
                                 {"version", version()},
                                 {"interrupted", !interruption_.empty()},
                                 {"config", config}};
  summary.update(results);
  folder_.write("summary.json", summary.dump(2) + "\n");
  if (command_line_.silent) return;
  try {
    write_page(folder_.path());
  } catch (const std::exception& error) {
    fmt::print("note: there is no report.html: {}\n", error.what());
  }
}

void RunRecord::close() const {
  if (!interruption_.empty()) {
    print("Interrupted when {}: the results are of these.\n", interruption_);
    if (command_of(command_line_.command).resumable) {
      print("Go on with: {}\n", resume_command(command_line_.command, folder_.path()));
    }
  }
  const std::filesystem::path page = folder_.file("report.html");
  if (std::filesystem::exists(page)) print("Open {} in a browser.\n", page.string());
  print("Results are in {}.\n", folder_.path().string());
  if (!interruption_.empty()) throw RunInterrupted();
}

}  // namespace nlcwfs
