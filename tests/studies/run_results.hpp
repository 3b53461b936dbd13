// What tests of several commands ask of a run's results.
#pragma once

#include "tests/studies/program.hpp"

#include <cmath>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

namespace nlcwfs {

/// Of an object.
inline std::vector<std::string> keys_of(const nlohmann::json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

/// The rows of a table, its header first; cells in quotes come as "quoted".
inline std::vector<std::vector<std::string>> read_table(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(contents(path));
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::istringstream cells(std::regex_replace(line, std::regex(R"("[^"]*")"), "quoted"));
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// The one number that a query of an archive gives.
inline double archived(const std::string& folder, const std::string& sql) {
  sqlite3* opened = nullptr;
  EXPECT_EQ(sqlite3_open((folder + "/archive.sqlite").c_str(), &opened), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, sqlite3_close);
  sqlite3_stmt* prepared = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(opened, sql.c_str(), -1, &prepared, nullptr), SQLITE_OK);
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(prepared,
                                                                             sqlite3_finalize);
  EXPECT_EQ(sqlite3_step(prepared), SQLITE_ROW) << sqlite3_errmsg(opened);
  return sqlite3_column_double(prepared, 0);
}

/// What every design of a summary has, with its performance.
inline void expect_design_of_the_contract(const nlohmann::json& design) {
  EXPECT_THAT(keys_of(design),
              testing::IsSupersetOf({"planes_m", "planes_talbot", "fresnel_numbers", "pupil_pixels",
                                     "detector_window", "photons", "cost", "performance"}));
  EXPECT_THAT(
      keys_of(design.at("performance")),
      testing::IsSupersetOf({"residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl",
                             "loops", "fractional_loops", "seconds", "fft_count", "captured_energy",
                             "converged_fraction", "screens"}));
  EXPECT_EQ(design["performance"]["captured_energy"].size(), design["planes_m"].size());
}

inline void expect_same_performance(const nlohmann::json& actual, const nlohmann::json& expected,
                                    double tolerance) {
  for (const char* metric : {"residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl",
                             "fractional_loops", "loops", "fft_count"}) {
    for (const char* part : {"mean", "standard_error"}) {
      const double value = expected.at(metric).at(part);
      EXPECT_NEAR(actual.at(metric).at(part), value, tolerance * std::abs(value))
          << metric << ' ' << part;
    }
  }
  EXPECT_EQ(actual.at("screens"), expected.at("screens"));
  EXPECT_EQ(actual.at("converged_fraction"), expected.at("converged_fraction"));
}

}  // namespace nlcwfs
