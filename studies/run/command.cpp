// What a command is.
#include "studies/run/command.hpp"

#include "results/text/quantity_text.hpp"
#include "studies/settings/setup.hpp"

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

namespace {

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

void print_assumed_seeing(const Request& request) {
  const Configuration& configuration = request.configuration;
  const auto is_given = [&](std::string_view key) {
    return configuration.value_text(key) != Configuration().value_text(key);
  };
  if (!request.command->reads("seeing.d_over_r0") || !request.command->is_of_one_seeing ||
      is_seeing_given(configuration) ||
      !(is_given("telescope.diameter") || is_given("telescope.wavelength"))) {
    return;
  }
  const Telescope telescope = telescope_of(configuration);
  fmt::print(
      "note: no seeing was given for this telescope: D/r0 = {} is assumed, r0 = {} at {}; give "
      "seeing.fried_parameter, seeing.fwhm or seeing.d_over_r0\n",
      configuration.value_text("seeing.d_over_r0"),
      format_length(seeing_of(configuration, telescope).fried_parameter),
      format_length(telescope.wavelength));
}

}  // namespace

void print_notes_on_keys(const Request& request) {
  print_ignored_keys(request);
  print_assumed_seeing(request);
}

}  // namespace nlcwfs
