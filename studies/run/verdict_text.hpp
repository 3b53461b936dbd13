// What the verdicts of several commands say alike.
#pragma once

#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// Of summaries, whose members keep their order.
using Json = nlohmann::ordered_json;

// What the verdicts of several commands say of a run's summary. All throw nlohmann::json::exception
// where a member is missing or of another type.

/// A figure with its standard error, where it has one: one screen alone has none.
std::string figure_text(const Json& object, const char* name);

/// "residual WFE 2.64 +- 0.01 nm after 8.1 +- 0.2 loops on 64 fresh screens"
/// @param design   as a summary has it
/// @param screens  what they are: "fresh screens"
std::string reached_text(const Json& design, std::string_view screens);

}  // namespace nlcwfs
