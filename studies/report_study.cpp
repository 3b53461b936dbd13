#include "studies/report_study.hpp"

#include "results/output_folder.hpp"
#include "results/report_page.hpp"
#include "studies/commands.hpp"
#include "studies/report_data.hpp"
#include "studies/studies.hpp"

#include <fmt/format.h>

namespace nlcwfs {

void write_report(const std::filesystem::path& folder) {
  const nlohmann::ordered_json data = report_data(folder);
  const std::string title =
      fmt::format("nlcwfs {}: {}", data.at("command").get<std::string>(),
                  std::filesystem::absolute(folder).lexically_normal().filename().string());
  OutputFolder::of_earlier_run(folder).write("report.html", report_page(title, data));
}

void run_report(const CommandLine& command_line) {
  const std::filesystem::path folder = command_line.arguments.front();
  write_report(folder);
  print_ignored_keys(command_line);
  fmt::print("{} is written.\n", (folder / "report.html").string());
}

}  // namespace nlcwfs
