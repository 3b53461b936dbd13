// JSON is read that may come from anywhere.
#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// Reads JSON that may come from anywhere.
/// @returns what is_discarded() where the text is no JSON, or nested deeper than any file of the
///          program: what copies, writes or destroys JSON calls itself for each level, and the
///          stack is not without end
nlohmann::ordered_json json_of(std::string_view text);

}  // namespace nlcwfs
