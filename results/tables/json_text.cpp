// JSON is read that may come from anywhere.
#include "results/tables/json_text.hpp"

namespace nlcwfs {

using Json = nlohmann::ordered_json;

Json json_of(std::string_view text) {
  constexpr int most_levels = 64;
  constexpr bool allow_exceptions = false;
  bool is_too_deep = false;
  const auto keep = [&](int depth, Json::parse_event_t, const Json&) {
    is_too_deep = is_too_deep || depth > most_levels;
    return !is_too_deep;
  };
  Json json = Json::parse(text, keep, allow_exceptions);
  return is_too_deep ? Json(Json::value_t::discarded) : json;
}

}  // namespace nlcwfs
