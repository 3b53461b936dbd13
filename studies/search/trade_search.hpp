// The front of several objectives is searched and verified.
#pragma once

#include "optimizer/pareto_search.hpp"
#include "studies/run/run_record.hpp"
#include "studies/settings/trials.hpp"

#include <cstddef>

namespace nlcwfs {

/// A design of a trade's front on fresh screens.
struct TradedDesign {
  TriedDesign verified;                  ///< on fresh screens
  std::vector<MeanAndError> objectives;  ///< there, in the metrics' own units and signs
  /// Another of the front is no worse there in any objective, and in one of them better by
  /// Student's t test at 5 %, paired by screen.
  bool dominated = false;
  /// The first of those that would dominate it if chance were none.
  std::optional<std::size_t> tied_with = {};
  /// The objectives of each screen, and their means as figures to be minimised.
  std::vector<std::vector<double>> samples;
  EvaluatedDesign evaluated;  ///< as the search saw it

  /// Whether it is one of the best compromises: not dominated, and within the limits.
  bool stands() const { return !dominated && evaluated.violation == 0.0; }
};

/// A bound on one objective, and the least of the first objective that is possible within it.
struct BoundedBest {
  double bound;        ///< upper, in the objective's unit
  std::size_t design;  ///< index in the front
};

/// What a trade found, and what it took.
struct TradeResult {
  ParetoResult search;  ///< of all numbers of planes together
  /// The verified designs, ordered by planes, pixels and the first objective.
  std::vector<TradedDesign> front;
  std::optional<std::size_t> knee;       ///< of those that stand; nothing where none does
  std::vector<double> reference_point;   ///< in the metrics' own units and signs
  bool reference_is_of_the_run = false;  ///< some of it is from the first populations
  double hypervolume = 0.0;              ///< of the front, in the product of the units
  /// Of the box between the reference point and the best values that the metrics can have.
  double hypervolume_fraction = 0.0;
  /// For each objective but the first: the first objective's best under ever wider bounds on it.
  std::vector<std::vector<BoundedBest>> bests;
  bool verification_interrupted = false;  ///< whether Ctrl-C left designs of the front unverified
  /// Designs of the front that were to be verified, without those that failed there.
  std::size_t chosen_count = 0;
  long reconstructions = 0;     ///< the verification included
  double search_seconds = 0.0;  ///< without the verification, s
  std::string table;            ///< CSV of the designs of the search
};

/// A Setup with the search of the sections trade, search and verify, checked as a whole when it is
/// made.
class TradeSearch : public TrialSetup {
 public:
  /// @param configuration  with set_trade_defaults
  /// @throws InputError where values do not go together
  explicit TradeSearch(const Configuration& configuration);

  /// The search, and the verification of its front on fresh screens. An interrupt of the search
  /// ends it with the front so far, which is verified all the same; one of the verification ends it
  /// with the designs so far, or the first alone on the screens that are done.
  TradeResult run(RunRecord& record) const;

  const DesignSpace space;                     ///< that the search has designs of
  const std::vector<DesignMetric> objectives;  ///< what is minimised at once
  ParetoOptions options;                       ///< of the search
  DesignTrial trial;                           ///< of the search
  DesignTrial verification;                    ///< on fresh screens

 private:
  void verify_front(TradeResult& result, RunRecord& record) const;
  void judge_front(TradeResult& result) const;

  /// As figures to be minimised; nothing for what the first populations say.
  std::vector<std::optional<double>> reference_;
  std::size_t most_verified_;
};

}  // namespace nlcwfs
