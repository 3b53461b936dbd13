#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// What a run has come to, in a sentence or two for the head of its page; empty for a command that
/// is not known.
/// @param summary  summary.json of the run
/// @throws nlohmann::json::exception where a member is missing or of another type
std::string verdict_sentence(const nlohmann::ordered_json& summary);

}  // namespace nlcwfs
