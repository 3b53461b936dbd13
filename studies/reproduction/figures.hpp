// The paper's figures: all that the program knows of each, and what goes through their list.
#pragma once

#include "studies/reproduction/claim_rules.hpp"
#include "studies/reproduction/markdown_report.hpp"
#include "studies/reproduction/plan.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// A figure of the paper, or another part of its reproduction.
struct PaperFigure {
  std::string_view name;     ///< as reproduce.figures has it
  std::string_view heading;  ///< in report.md
  std::string_view text;     ///< below the heading
  /// Adds the runs that it needs in one of both set-ups; null where it needs none in both.
  void (*plan)(Plan& plan, StudySetup setup) = nullptr;
  /// Adds the runs that it needs in one set-up alone, behind all the others.
  void (*plan_alone)(Plan& plan) = nullptr;
  /// Its tables and pictures.
  void (*report)(MarkdownReport& report, const ReproducedRuns& runs) = nullptr;
  std::vector<ClaimRule> claims = {};  ///< that its runs can check, in the order of the paper
};

/// All of them, in the order of report.md.
const std::vector<PaperFigure>& paper_figures();

/// The names of the figures that a configuration asks for.
/// @throws InputError where reproduce.figures names one that is not known
std::vector<std::string> figures_of(const Configuration& configuration);

/// Everything that these need; figures share runs.
/// @param configuration  gives the sizes (section reproduce), the screens and the search's
///                       precision; the paper's set-up is laid over its defaults
/// @throws InputError where it has another telescope, seeing, sensor or sweep than the paper's
std::vector<PlannedRun> planned_runs(const Configuration& configuration);

/// The claims that the figures' runs can check, in the order of the paper.
std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures);

}  // namespace nlcwfs
