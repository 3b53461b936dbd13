// What the verdicts of several commands say alike.
#include "studies/run/verdict_text.hpp"

#include <fmt/format.h>

namespace nlcwfs {

std::string figure_text(const Json& object, const char* name) {
  const MeanAndError value = mean_from_json(object.at(name));
  return value.standard_error == 0.0 ? fmt::format("{:.4g}", value.mean) : with_error(value);
}

std::string reached_text(const Json& design, std::string_view screens) {
  const Json& performance = design.at("performance");
  const Json futility = design.value("futility", Json());
  return fmt::format("residual WFE {} nm after {} loops on {} {}{}",
                     figure_text(performance, "residual_wfe_nm"), figure_text(performance, "loops"),
                     integer_from_json(performance.at("screens")), screens,
                     futility.is_null() ? "" : ". " + futility.get<std::string>());
}

}  // namespace nlcwfs
