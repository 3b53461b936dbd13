// Costs under several conditions become one.
#pragma once

#include "model/words.hpp"

#include <vector>

namespace nlcwfs {

/// What counts of a design's costs under several conditions.
enum class AggregateKind {
  mean,      ///< of all conditions
  worst,     ///< the condition whose mean is the highest
  quantile,  ///< of the costs of all screens and conditions, at the level
  cvar       ///< conditional value at risk: the mean of the costs beyond that quantile
};

/// Those of AggregateKind.
template <>
inline constexpr auto word_table<AggregateKind> =
    std::to_array<Word<AggregateKind>>({{"mean", AggregateKind::mean},
                                        {"worst", AggregateKind::worst},
                                        {"quantile", AggregateKind::quantile},
                                        {"cvar", AggregateKind::cvar}});

/// Makes one cost per screen of the costs under several conditions.
struct CostAggregate {
  AggregateKind kind = AggregateKind::mean;  ///< how several conditions make one cost
  double level = 0.9;                        ///< of quantile and cvar, 0 < level < 1

  /// One value per screen, whose mean is the aggregated cost and whose standard error is, to first
  /// order, that of the aggregated cost: the screens are the independent sample, and each value is
  /// the aggregated cost plus the screen's influence on it. So designs can be compared screen by
  /// screen, whatever the aggregate. With c_ik the cost of screen i under condition k, q the sample
  /// quantile at level a (the inverse of the distribution function of all c_ik):
  ///
  /// - mean      mean_k c_ik
  /// - worst     c_ik of the condition k with the highest mean
  /// - cvar      q + mean_k (c_ik - q)+ / (1 - a), whose mean is the minimum over q
  ///             (Rockafellar & Uryasev 2000, J. Risk 2(3), 21)
  /// - quantile  q + (mean_k 1[c_ik > q] - p) / f (Bahadur 1966, Ann. Math. Stat. 37, 577), p the
  ///             share of all costs above q: 1 - a up to 1 over the number of costs, and p makes
  ///             the mean exactly q. The density f at q is from the spacing of order statistics
  ///             around it (Siddiqui 1960, J. Res. NBS 64B, 145) over the bandwidth of Hall &
  ///             Sheather 1988 (J. R. Stat. Soc. B 50, 381).
  ///
  /// @param costs  of each condition, of each of its screens
  /// @pre there is a condition, and all have as many screens, at least one
  std::vector<double> per_screen(const std::vector<std::vector<double>>& costs) const;
};

}  // namespace nlcwfs
