// The two set-ups that the paper's studies are run in.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace nlcwfs {

/// In which of two set-ups a study is run.
enum class StudySetup {
  paper,    ///< the paper's: data on the reconstruction's own grid, rms_change
  extended  ///< data on an extended grid, difference
};
/// Both of them.
inline constexpr std::array setups{StudySetup::paper, StudySetup::extended};

/// As names of runs have it.
constexpr std::string_view to_string(StudySetup setup) {
  return setup == StudySetup::paper ? "paper" : "extended";
}

/// As report.md has it.
constexpr const char* title_of(StudySetup setup) {
  return setup == StudySetup::paper ? "the paper's set-up" : "extended truth, rule difference";
}

/// Where a run is, below the reproduction's folder: "figure-3/paper-4".
/// @param name  empty where the set-up is all of it
inline std::string run_folder(std::string_view figure, StudySetup setup,
                              std::string_view name = {}) {
  return fmt::format("{}/{}{}{}", figure, to_string(setup), name.empty() ? "" : "-", name);
}

/// How a file beside report.md begins: "figure-3-paper-4".
inline std::string file_name(std::string_view figure, StudySetup setup,
                             std::string_view name = {}) {
  return fmt::format("{}-{}{}{}", figure, to_string(setup), name.empty() ? "" : "-", name);
}

}  // namespace nlcwfs
