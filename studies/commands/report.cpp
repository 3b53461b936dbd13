#include "studies/commands/report.hpp"

#include "results/archive/output_folder.hpp"
#include "results/page/page.hpp"
#include "studies/command_line/commands.hpp"
#include "studies/commands/run_functions.hpp"
#include "studies/run/page_data.hpp"

#include <fmt/format.h>

namespace nlcwfs {

void write_page(const std::filesystem::path& folder) {
  const nlohmann::ordered_json data = page_data(folder);
  const std::string title =
      fmt::format("nlcwfs {}: {}", data.at("command").get<std::string>(),
                  std::filesystem::absolute(folder).lexically_normal().filename().string());
  OutputFolder::of_earlier_run(folder).write("report.html", page_of(title, data));
}

void run_report(const CommandLine& command_line) {
  const std::filesystem::path folder = command_line.arguments.front();
  write_page(folder);
  print_ignored_keys(command_line);
  fmt::print("{} is written.\n", (folder / "report.html").string());
}

}  // namespace nlcwfs
