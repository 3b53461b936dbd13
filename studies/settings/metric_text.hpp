// Lists of metrics with weights and bounds are read.
#pragma once

#include "objectives/design_cost.hpp"

#include <string_view>
#include <vector>

namespace nlcwfs {

// Lists of design_metrics() with their numbers, separated by commas; an empty text is an empty
// list. All throw InputError naming the key, and where a name is no metric, the nearest one and all
// there are.

/// METRIC:WEIGHT
std::vector<CostTerm> parse_terms(std::string_view key, std::string_view text);

/// METRIC>BOUND:WEIGHT or METRIC<BOUND:WEIGHT: the side that is penalised; weights are at least 0.
std::vector<Penalty> parse_penalties(std::string_view key, std::string_view text);

/// METRIC<BOUND or METRIC>BOUND: what must hold.
/// @return the sides on which it does not
std::vector<MetricBound> parse_limits(std::string_view key, std::string_view text);

/// METRIC: each one once.
std::vector<DesignMetric> parse_metrics(std::string_view key, std::string_view text);

}  // namespace nlcwfs
