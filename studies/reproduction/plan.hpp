// The runs that a reproduction is made of, as its figures ask for them.
#pragma once

#include "studies/reproduction/study_setup.hpp"
#include "studies/settings/configuration.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

/// Keys and values.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One run of a command that a reproduction is made of.
struct PlannedRun {
  std::string folder;           ///< below the reproduction's: "figure-3/paper-4"
  std::string command;          ///< that it runs
  Configuration configuration;  ///< all of its keys
};

/// Of the paper's maps and its fifth plane, m.
inline constexpr double farthest = 250e3;

/// How many times as many wavefronts the designs at the paper's distances are evaluated on.
inline constexpr int more_screens = 16;

/// As a list in a configuration.
std::string list_text(const std::vector<double>& values);

/// What figures add their runs to; they share those that have the same folder.
class Plan {
 public:
  /// @param given    what the user configured, which outlives the plan
  /// @param figures  that it asks for
  /// @throws InputError where it has another telescope, seeing, sensor or sweep than the paper's
  Plan(const Configuration& given, std::vector<std::string> figures);

  /// What the user configured.
  const Configuration& given() const { return given_; }

  /// Whether a figure is asked for.
  bool has(std::string_view figure) const;

  /// The paper's planes in one of the two set-ups.
  Configuration base(StudySetup setup) const;

  /// Adds a run unless it is there already.
  void add(const std::string& folder, const std::string& command, Configuration configuration,
           const Settings& values);

  /// The sweep of near and far pair at one D/r0.
  /// @param order  in which -near, near, -far, far are visited, such as "1234"
  void add_map(const std::string& folder, StudySetup setup, int ratio, const std::string& order);

  /// Those of four planes and of three at D/r0 = 4.
  void add_plane_count_maps(StudySetup setup);

  /// The paper's planes, or others at its distances, one for one.
  /// @param papers_places  of the paper's planes, counted from 0
  void add_design(StudySetup setup, std::string_view name,
                  const std::vector<std::size_t>& papers_places);

  /// All of them, in the order in which they were added.
  std::vector<PlannedRun> runs() && { return std::move(runs_); }

 private:
  const Configuration& given_;
  std::vector<std::string> figures_;
  std::set<std::string> folders_;
  std::vector<PlannedRun> runs_;
};

/// How much a run takes beside others, for predictions of the time left: samples that Fourier
/// transforms see, in 1e9. Loops are guessed, and the verification of a sweep is left out.
double work_of(const PlannedRun& run);

}  // namespace nlcwfs
