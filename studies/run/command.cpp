// What a command is.
#include "studies/run/command.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

bool Command::reads(std::string_view key) const {
  return std::ranges::any_of(keys, [&](std::string_view wanted) {
    return key == wanted || (key.starts_with(wanted) && key.substr(wanted.size()).starts_with('.'));
  });
}

std::string resume_command(const Command& command, const std::filesystem::path& folder) {
  return fmt::format("nlcwfs {} --resume {}", command.name, folder.string());
}

void print_ignored_keys(const Request& request) {
  std::vector<std::string> ignored;
  for (const ConfigurationKey& key : configuration_keys()) {
    if (request.configuration.source(key.name) == "on the command line" &&
        !request.command->reads(key.name)) {
      ignored.push_back(key.name);
    }
  }
  if (ignored.empty()) return;
  fmt::print("note: {0} does not use {1}; nlcwfs {0} --help lists what it uses\n",
             request.command->name, fmt::join(ignored, ", "));
}

}  // namespace nlcwfs
