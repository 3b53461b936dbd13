// What a design costs: wavefront error, loops, time, penalties and limits.
#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"
#include "model/words.hpp"
#include "objectives/cost_aggregate.hpp"
#include "objectives/design_metric.hpp"

#include <vector>

namespace nlcwfs {

/// Which wavefront error a cost counts; see WavefrontMetrics.
enum class WavefrontErrorKind { residual, wrapped, total };

/// What a cost starts from.
enum class CostKind {
  weighted,     ///< WFE / wfe_scale + loop_weight x fractional loops + time_weight x model time
  error_budget  ///< error_budget_nm
};

/// Those of WavefrontErrorKind.
template <>
inline constexpr auto word_table<WavefrontErrorKind> =
    std::to_array<Word<WavefrontErrorKind>>({{"residual", WavefrontErrorKind::residual},
                                             {"wrapped", WavefrontErrorKind::wrapped},
                                             {"total", WavefrontErrorKind::total}});
/// Those of CostKind.
template <>
inline constexpr auto word_table<CostKind> = std::to_array<Word<CostKind>>(
    {{"weighted", CostKind::weighted}, {"error_budget", CostKind::error_budget}});

/// A metric in a cost, times a weight.
struct CostTerm {
  DesignMetric metric;  ///< what is weighed
  double weight = 0.0;  ///< per unit of the metric
};

/// A side of a metric's value.
enum class Side { above, below };

/// Values of a metric on one side of a bound, which is in the metric's unit.
struct MetricBound {
  DesignMetric metric;      ///< what is bounded
  Side side = Side::above;  ///< which values exceed the bound
  double bound = 0.0;       ///< in the metric's unit

  /// How far a value lies on the side, in the metric's unit; 0 where it does not.
  double excess(double value) const;
};

/// Values that cost extra.
struct Penalty {
  MetricBound penalised;  ///< what is penalised, beyond its bound
  double weight = 0.0;    ///< per unit of the metric that it is beyond the bound
};

/// Makes one number of a design's performance: the kind's cost, and on top the terms and the
/// penalties.
/// Every part is a mean over the screens, so the cost of each screen is defined and designs can be
/// compared screen by screen.
struct DesignCost {
  CostKind kind = CostKind::weighted;                     ///< which formula, see above
  WavefrontErrorKind wfe = WavefrontErrorKind::residual;  ///< which wavefront error counts
  double wfe_scale = 10e-9;                               ///< m
  double loop_weight = 0.1;                               ///< per loop
  double time_weight = 0.0;                               ///< 1/s
  std::vector<CostTerm> terms = {};      ///< what is added to the cost, with weights
  std::vector<Penalty> penalties = {};   ///< what is added beyond bounds
  std::vector<MetricBound> limits = {};  ///< what a design's mean must not be; costs nothing
  Operation operation = {};              ///< what the metrics of the servo loop and of time assume
  CostAggregate aggregate = {};          ///< over conditions

  /// The cost of each screen under one condition.
  /// @param fried_parameter  of the seeing at the telescope's wavelength, m
  /// @throws InputError naming the key where a metric needs what is not set
  std::vector<double> per_screen(const Performance& performance, const SensorDesign& design,
                                 double fried_parameter) const;

  /// By how much the means over the screens break the limits: the sum of each one's excess relative
  /// to its bound; 0 where all are kept.
  double violation(const Performance& performance, const SensorDesign& design,
                   double fried_parameter) const;

  /// @throws InputError naming the key where a metric needs what is not set
  void validate() const;
};

}  // namespace nlcwfs
