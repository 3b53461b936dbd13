// Designs are tried on fresh screens, and ranked there.
#pragma once

#include "objectives/design_comparison.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/settings/trials.hpp"

#include <cstddef>
#include <stdexcept>

namespace nlcwfs {

/// Of a verification of so many designs, in screens under each condition.
/// @param then, whole  see Progress
Progress verification_progress(const DesignTrial& verification, std::size_t designs,
                               std::string then = {}, const Progress* whole = nullptr);

/// Whether a design was tried on all screens of a trial: no watch ended it early.
bool is_whole(const TriedDesign& tried, const DesignTrial& trial);

/// Checks that designs can be verified.
/// @throws InputError naming verify.truth_factor
void require_verifiable(const DesignTrial& verification, const std::vector<SensorDesign>& designs,
                        const FreshScreens& fresh);

/// Thrown where a design fails on the fresh screens; says how to try it again.
class VerificationFailed : public std::runtime_error {
 public:
  /// @param what_failed   the design, and why
  /// @param how_to_go_on  may be empty
  VerificationFailed(std::string what_failed, const std::string& how_to_go_on)
      : std::runtime_error(what_failed + how_to_go_on), what_failed_(std::move(what_failed)) {}

  /// The design, and why it failed.
  const std::string& what_failed() const { return what_failed_; }

 private:
  std::string what_failed_;
};

/// A design on fresh screens, archived where the watch did not end it early.
/// @throws VerificationFailed, once that is archived and logged
TriedDesign verified_design(const SensorDesign& design, const DesignTrial& verification,
                            RunRecord& record, const ScreenWatch& watch);

/// The same of one of several designs: nothing where it fails, of which it warns.
/// @param is_last_hope  none before has survived, and none follows
/// @throws VerificationFailed where it is
std::optional<TriedDesign> verified_candidate(const SensorDesign& design,
                                              const DesignTrial& verification, RunRecord& record,
                                              const ScreenWatch& watch, bool is_last_hope);

/// One of the best designs of a search or a sweep, held against the best of them on fresh screens.
struct RankedDesign {
  std::size_t candidate = 0;  ///< its place among those that were to be verified
  TriedDesign verified;       ///< on fresh screens
  /// The best design's cost minus this one's, paired by screen; better or worse than the best where
  /// it can be told apart.
  Improvement against_best = {};
};

/// Those that keep the limits, or come closest, first; of these by their costs.
/// @param candidates  with verified designs
std::vector<RankedDesign> ranked(std::vector<RankedDesign> candidates);

/// A ranking as summaries have it.
nlohmann::ordered_json to_json(const std::vector<RankedDesign>& ranking,
                               const DesignTrial& verification);

/// For people, whether the best few can be told apart; empty where there is one.
/// @param of  what found them: "The search"
std::string ranking_text(const std::vector<RankedDesign>& ranking, std::string_view of);

}  // namespace nlcwfs
