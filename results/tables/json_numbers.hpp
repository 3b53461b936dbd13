// Numbers are read from JSON, where null is none.
#pragma once

#include "model/statistics.hpp"

#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

// Numbers as summaries have them. JSON has none for what is not finite: there it has null, which is
// read as NaN. All throw std::exception, of nlohmann::json or not, for other values.

/// Of a number, or null.
double number_from_json(const nlohmann::ordered_json& json);

/// Of a whole number that is an int.
int integer_from_json(const nlohmann::ordered_json& json);

/// Of {"mean": ..., "standard_error": ...}.
MeanAndError mean_from_json(const nlohmann::ordered_json& json);

/// The numbers of nested arrays, the last index running fastest.
std::vector<double> numbers_from_json(const nlohmann::ordered_json& matrix);

}  // namespace nlcwfs
