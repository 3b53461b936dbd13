// report: The page of an earlier run, again.
#include "studies/commands/report.hpp"

#include "model/input_error.hpp"
#include "studies/commands/commands.hpp"
#include "studies/run/page_data.hpp"
#include "studies/settings/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

const Command& command_of_run(const std::filesystem::path& folder) {
  const nlohmann::ordered_json summary = summary_of_run(folder);
  const nlohmann::ordered_json name = summary.value("command", nlohmann::ordered_json());
  std::set<std::string> known;
  for (const Command& command : commands()) {
    if (command.verdict == nullptr) continue;
    if (name == command.name) return command;
    known.insert(command.name);
  }
  throw InputError("DIR", one_line(folder.string()),
                   fmt::format("its summary.json is of the command {}, and there is a page for the "
                               "results of {}",
                               one_line(name.dump()), fmt::join(known, ", ")));
}

namespace {

void run_report(const Request& request) {
  const std::filesystem::path folder = request.arguments.front();
  write_page(folder, command_of_run(folder));
  print_notes_on_keys(request);
  fmt::print("{} is written.\n", (folder / "report.html").string());
}

}  // namespace

Command report_command() {
  return {.name = "report",
          .group = "Results of a run",
          .description = "make the page report.html of a run's folder again",
          .about =
              "Every run leaves report.html, a page that shows its results in a browser. This "
              "makes it anew from the files that are in the folder, also where some are missing "
              "or another version has written them, and says so. It writes nothing else.",
          .keys = {},
          .examples = {"nlcwfs report results/optimize-1"},
          .run = run_report,
          .arguments = {{"DIR"}}};
}

}  // namespace nlcwfs
