// Tried designs become JSON and tables.
#pragma once

#include "objectives/design_trial.hpp"
#include "results/tables/design_summary.hpp"

#include <string>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A tried design as every summary has it: the design (in Talbot distances of the first condition's
/// Fried parameter, and in its light), its cost, violation and performance, pooled over the
/// conditions; where there are several, `conditions` has each one's name, D/r0, photons and
/// performance. `futility` is futility_text(), null where it works.
nlohmann::ordered_json to_json(const TriedDesign& tried, const DesignTrial& trial);

/// For people: that a design does not work as a sensor under one of the conditions, why, and what
/// to try. It does not where its mean wrapped error is 0.8 or more of that of a random phase,
/// lambda / sqrt(12), its mean field-estimated Strehl ratio 0.2 or less, or its light below 100
/// photons a frame. Empty where it works.
std::string futility_text(const TriedDesign& tried, const DesignTrial& trial);

/// A line for each thing that is wrong with a design: futility_text(); that no wavefront converged;
/// planes whose window catches less than 90 % of the light. Empty where nothing is.
std::string design_warnings(const TriedDesign& tried, const DesignTrial& trial);

/// For people, where there are several conditions: which, and how the design did under each; empty
/// where there is one.
std::string conditions_table(const TriedDesign& tried, const DesignTrial& trial);

/// For people, a line for each limit that the design breaks under a condition; empty without any.
std::string limits_text(const TriedDesign& tried, const DesignTrial& trial);

/// One line for each screen, one column for each metric, as CSV.
std::string screens_table(const Performance& performance);

}  // namespace nlcwfs
