#pragma once

#include "studies/reproduction/plan.hpp"

#include <map>
#include <string>
#include <vector>

namespace nlcwfs {

class ReproducedRuns;

/// What a claim of the paper has come to.
enum class ClaimVerdict {
  reproduced,
  in_trend,
  not_reproduced,
  open  ///< the runs do not have what it takes to tell
};
/// As reports have it.
std::string_view to_string(ClaimVerdict verdict);

/// What one set-up says of a claim.
struct ClaimFinding {
  std::string number;                         ///< ours, with its standard error where it is a mean
  ClaimVerdict verdict = ClaimVerdict::open;  ///< what came of it
  std::string why = {};                       ///< what decides it there, one line
};

/// A sentence of the paper that can be checked.
struct Claim {
  std::string figure;    ///< of reproduced_figures, whose runs it is checked on
  std::string sentence;  ///< in our words
  std::string papers;    ///< its number
  std::string rule;      ///< what counts as reproduced, and what as its trend
  std::map<StudySetup, ClaimFinding> findings;  ///< of each set-up
};

/// The claims that the figures' runs can check, in the order of the paper.
std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures);

}  // namespace nlcwfs
