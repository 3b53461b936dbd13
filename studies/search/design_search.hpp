// One best design is searched, verified, and how far it may move is scanned.
#pragma once

#include "optimizer/chained_search.hpp"
#include "results/pictures/search_pictures.hpp"
#include "studies/search/verified_ranking.hpp"

namespace nlcwfs {

/// @throws InputError where all of some sub-space's design is fixed
void require_variables(const std::vector<SubSpace>& sub_spaces);

/// With each value that a space's discrete variables have, and both ends of the others, one at a
/// time.
std::vector<SensorDesign> outstanding_designs(const DesignSpace& space);

/// Checks these.
/// @throws InputError where the trial cannot have such a design
void require_valid_designs(const DesignSpace& space, const DesignTrial& trial);

/// What a search found, and what it took.
struct DesignSearchResult {
  SearchResult search;  ///< of the search proper
  /// The search's best few on fresh screens, by their costs there, best first.
  std::vector<RankedDesign> ranking;
  TriedDesign baseline;   ///< on the same screens
  Improvement gain = {};  ///< of the best over the baseline
  /// Of the variables that were scanned before an interrupt.
  std::vector<OptimumRange> ranges;
  std::string interrupted_when;     ///< for people; empty where it was not
  int cheap_evaluations = 0;        ///< designs of the cheap stage
  int given_up = 0;                 ///< designs that races gave up
  long search_reconstructions = 0;  ///< of both stages
  long saved_reconstructions = 0;   ///< that races left out
  long reconstructions = 0;         ///< verification and ranges included
  double search_seconds = 0.0;      ///< of both stages, s
  std::string table;                ///< CSV of the designs of the search
  std::vector<SearchStep> steps;    ///< of the search

  /// The best of the ranking.
  const TriedDesign& best() const { return ranking.front().verified; }
};

/// A Setup with the search of the sections search, baseline and verify, checked as a whole when it
/// is made.
class DesignSearch : public TrialSetup {
 public:
  /// @throws InputError where values do not go together
  explicit DesignSearch(const Configuration& configuration);

  /// The trials of all its stages, for RunRecord::adopt.
  std::vector<DesignTrial*> trials();

  /// The cheap stage where there is one, the search, the verification on fresh screens and the
  /// scan of how far the best design's variables may move. An interrupt of the search ends it with
  /// the best designs so far, which are verified all the same; one of the verification ends it with
  /// the designs that are done and their baseline, or the best alone on as many screens as are done
  /// of both.
  /// @param whole  see Progress
  DesignSearchResult run(RunRecord& record, const Progress* whole = nullptr) const;

  const DesignSpace space;      ///< that the search has designs of
  SearchOptions options;        ///< of the search proper
  DesignTrial trial;            ///< of the search
  DesignTrial verification;     ///< on fresh screens
  DesignTrial scan;             ///< for the ranges
  const SensorDesign baseline;  ///< that the best is compared with

 private:
  struct CheapStage {
    DesignTrial trial;
    DesignSpace space;
    SearchOptions options;
  };

  SearchResult search_stage(const std::string& name, const DesignSpace& stage_space,
                            const DesignTrial& stage_trial, SearchOptions stage_options,
                            RunRecord& record, std::string then, const Progress* whole,
                            DesignSearchResult& result) const;
  void add_cheap_stage(const Configuration& configuration);
  void verify(RunRecord& record, const Progress* whole, DesignSearchResult& result) const;
  void scan_ranges(const Progress* whole, DesignSearchResult& result) const;

  std::optional<CheapStage> cheap_;
  int candidates_;
};

}  // namespace nlcwfs
