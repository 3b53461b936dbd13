#pragma once

#include "model/statistics.hpp"
#include "studies/reproduction_plan.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// The summaries of a reproduction's runs.
class ReproducedRuns {
 public:
  /// @param folder  of the reproduction
  explicit ReproducedRuns(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// @throws std::runtime_error with path and cause where it cannot be read
  const nlohmann::ordered_json& summary(const std::string& run) const;

 private:
  std::filesystem::path folder_;
  mutable std::map<std::string, nlohmann::ordered_json> read_;
};

/// What a claim of the paper has come to.
enum class ClaimVerdict { reproduced, in_trend, not_reproduced };
std::string_view to_string(ClaimVerdict verdict);

/// What one set-up says of a claim.
struct ClaimFinding {
  std::string number;  ///< ours, with its standard error where it is a mean
  ClaimVerdict verdict;
};

/// A sentence of the paper that can be checked.
struct Claim {
  std::string figure;    ///< of reproduced_figures, whose runs it is checked on
  std::string sentence;  ///< in our words
  std::string papers;    ///< its number
  std::string rule;      ///< what counts as reproduced, and what as its trend
  std::map<Setup, ClaimFinding> findings;
  std::string why;  ///< what decides it, one line
};

/// The claims that the figures' runs can check.
std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures);

}  // namespace nlcwfs
