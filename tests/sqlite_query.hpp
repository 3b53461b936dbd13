// Archives are queried in tests.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

namespace nlcwfs {

/// NULLs have no value.
using Row = std::vector<std::optional<std::string>>;

/// The rows that a query of another program gets, every value as text.
inline std::vector<Row> query(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> close(database, sqlite3_close);
  sqlite3_busy_timeout(database, 60'000);
  std::vector<Row> rows;
  const auto add_row = [](void* to, int count, char** values, char**) {
    Row row;
    for (int i = 0; i < count; ++i) {
      row.push_back(values[i] == nullptr ? std::nullopt : std::optional<std::string>(values[i]));
    }
    static_cast<std::vector<Row>*>(to)->push_back(std::move(row));
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), add_row, &rows, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  return rows;
}

}  // namespace nlcwfs
