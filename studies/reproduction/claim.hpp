// A claim of the paper and what it has come to.
#pragma once

#include "studies/reproduction/study_setup.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// What a claim of the paper has come to.
enum class ClaimVerdict {
  reproduced,
  in_trend,
  not_reproduced,
  open  ///< the runs do not have what it takes to tell
};
/// As report.md has it.
std::string_view to_string(ClaimVerdict verdict);

/// What one set-up says of a claim.
struct ClaimFinding {
  std::string number;                         ///< ours, with its standard error where it is a mean
  ClaimVerdict verdict = ClaimVerdict::open;  ///< what came of it
  std::string why = {};                       ///< what decides it there, one line
};

/// A sentence of the paper that can be checked.
struct Claim {
  std::string figure;    ///< whose runs it is checked on
  std::string sentence;  ///< in our words
  std::string papers;    ///< its number
  std::string rule;      ///< what counts as reproduced, and what as its trend
  std::map<StudySetup, ClaimFinding> findings;  ///< of each set-up
};

/// "11 reproduced, 6 reproduced in trend, 4 not reproduced"
std::string count_text(const std::vector<Claim>& claims, StudySetup setup);

/// All about them as comma-separated values, a row each.
std::string claims_table(const std::vector<Claim>& claims);

}  // namespace nlcwfs
