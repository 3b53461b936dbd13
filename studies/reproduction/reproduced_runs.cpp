// The finished runs of a reproduction, as its figures and claims ask for them.
#include "studies/reproduction/reproduced_runs.hpp"

#include "results/tables/csv_table.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {

using Json = nlohmann::ordered_json;

const Json& ReproducedRuns::summary(const std::string& run) const {
  const auto known = read_.find(run);
  if (known != read_.end()) return known->second;
  const std::filesystem::path path = folder_ / run / "summary.json";
  Json summary;
  try {
    summary = json_of(text_of_file(path));
    if (!summary.is_object()) throw std::runtime_error("it is no JSON object");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
  return read_.emplace(run, std::move(summary)).first->second;
}

std::vector<double> ReproducedRuns::screens(const std::string& run,
                                            const std::string& metric) const {
  const std::filesystem::path path = folder_ / run / "screens.csv";
  std::vector<double> values;
  for (const CsvRow& row : read_csv(path)) {
    const auto cell = row.find(metric);
    if (cell == row.end()) {
      throw std::runtime_error(fmt::format("{} has no column {}", path.string(), metric));
    }
    values.push_back(std::stod(cell->second));
  }
  return values;
}

MeanAndError mean_difference(std::vector<double> values, const std::vector<double>& others) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= others.at(i);
  return mean_and_standard_error(values);
}

PlaneMap SetupRuns::map(int ratio) const {
  return PlaneMap(summary("figure-3", fmt::format("{}", ratio)).at("grid"));
}

PlaneMap SetupRuns::three_plane_map(const std::string& name) const {
  return PlaneMap(summary("figure-4", name).at("grid"));
}

MeanAndError SetupRuns::design(const std::string& name, const char* metric) const {
  return mean_from_json(summary("designs", name).at("design").at("performance").at(metric));
}

MeanAndError SetupRuns::above_four_planes(const std::string& name, const char* metric) const {
  return mean_difference(screens("designs", name, metric),
                         screens("designs", "four-planes", metric));
}

}  // namespace nlcwfs
