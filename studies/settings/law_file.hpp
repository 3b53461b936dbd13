// Scaling laws are read from files, and written.
#pragma once

#include "objectives/scaling_law.hpp"
#include "studies/settings/configuration.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A scaling law with the designs behind it, as files have it:
/// {"conditions": {"section.key": "value", ...},
///  "data": [{"d_over_r0": .., "z_near_talbot": {"mean": .., "standard_error": ..}, ...}, ...],
///  "law": {"order": [3, 4, 1, 2], "least_d_over_r0": .., "greatest_d_over_r0": ..,
///          "z_near_talbot": {"intercept": .., "slope": .., "covariance": [[.., ..], [.., ..]],
///                            "scatter": ..}, ...}}
/// Where `law` has the order alone, its lines are fitted to the data. Configuration keys that are
/// not among the conditions are at their defaults.
struct LawFile {
  Configuration conditions;        ///< that the designs were found under, apart from their D/r0
  std::vector<ScalingDatum> data;  ///< that the law is fitted to
  ScalingLaw law;                  ///< the fit
};

/// The member `law` above.
nlohmann::ordered_json to_json(const ScalingLaw& law);

/// The whole file as JSON; `conditions` has the keys that it was read with.
nlohmann::ordered_json to_json(const LawFile& file);

/// Reads the text of a law file.
/// @param name  of the file, for messages
/// @throws InputError naming advise.law, the file and the field that is not as above
LawFile parse_law_file(std::string_view text, const std::string& name);

/// @throws InputError as above, and where the file cannot be read
LawFile read_law_file(const std::filesystem::path& path);

/// The conditions of a law's designs, to be named in its file: all of a configuration's values but
/// D/r0 and what plays no part in a search.
Configuration law_conditions(const Configuration& configuration);

/// The law file that the program was built with, results/reference/scaling_law.json.
std::string_view built_in_law_text();

}  // namespace nlcwfs
