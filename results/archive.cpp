#include "results/archive.hpp"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <sqlite3.h>

namespace nlcwfs {
namespace {

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

/// Null where SQLite refuses.
Statement prepared(sqlite3* database, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
  return Statement(statement);
}

/// Empty for NULL.
std::string text_at(sqlite3_stmt* statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  return text == nullptr
             ? std::string()
             : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement, column)));
}

constexpr std::string_view columns = "id,stage,key,design,cost,failure,seconds,performance";

}  // namespace

void Archive::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Archive::Archive(const std::filesystem::path& path, int flags) : path_(path) {
  sqlite3* database = nullptr;
  const int status = sqlite3_open_v2(path.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (status != SQLITE_OK) fail("open");
}

Archive::Archive(const std::filesystem::path& path)
    : Archive(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) {
  execute(
      "CREATE TABLE evaluations ("
      "id INTEGER PRIMARY KEY, stage TEXT NOT NULL, key TEXT, design TEXT NOT NULL, cost REAL, "
      "failure TEXT, seconds REAL NOT NULL, performance TEXT)");
}

Archive Archive::reopened(const std::filesystem::path& path) {
  Archive archive(path, SQLITE_OPEN_READWRITE);
  const Statement layout = prepared(
      archive.database_.get(), "SELECT group_concat(name) FROM pragma_table_info('evaluations')");
  if (!layout || sqlite3_step(layout.get()) != SQLITE_ROW) archive.fail("read");
  if (const std::string found = text_at(layout.get(), 0); found != columns) {
    throw std::runtime_error(
        fmt::format("cannot go on with the archive {}: its table has the columns '{}', this "
                    "version's '{}'",
                    path.string(), found, columns));
  }
  return archive;
}

void Archive::add(const ArchivedEvaluation& evaluation) {
  const Statement statement =
      prepared(database_.get(),
               "INSERT INTO evaluations (stage, key, design, cost, failure, seconds, performance) "
               "VALUES (?, ?, ?, ?, ?, ?, ?)");
  if (!statement) fail("write to");
  // SQLite stores an unbound parameter, and a NaN, as NULL.
  const auto bind_text = [&](int parameter, const std::string& text) {
    if (text.empty()) return;
    sqlite3_bind_text(statement.get(), parameter, text.data(), static_cast<int>(text.size()),
                      SQLITE_STATIC);
  };
  bind_text(1, evaluation.stage);
  bind_text(2, evaluation.key);
  bind_text(3, evaluation.design);
  sqlite3_bind_double(statement.get(), 4, evaluation.cost);
  bind_text(5, evaluation.failure);
  sqlite3_bind_double(statement.get(), 6, evaluation.seconds);
  bind_text(7, evaluation.performance);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) fail("write to");
}

std::vector<ArchivedEvaluation> Archive::evaluations() const {
  const Statement statement =
      prepared(database_.get(),
               "SELECT stage, key, design, cost, failure, seconds, performance FROM evaluations "
               "ORDER BY id");
  if (!statement) fail("read");
  std::vector<ArchivedEvaluation> all;
  int status = SQLITE_OK;
  while ((status = sqlite3_step(statement.get())) == SQLITE_ROW) {
    sqlite3_stmt* row = statement.get();
    all.push_back({.stage = text_at(row, 0),
                   .design = text_at(row, 2),
                   .cost = sqlite3_column_type(row, 3) == SQLITE_NULL
                               ? std::numeric_limits<double>::quiet_NaN()
                               : sqlite3_column_double(row, 3),
                   .failure = text_at(row, 4),
                   .seconds = sqlite3_column_double(row, 5),
                   .performance = text_at(row, 6),
                   .key = text_at(row, 1)});
  }
  if (status != SQLITE_DONE) fail("read");
  return all;
}

void Archive::fail(std::string_view action) const {
  throw std::runtime_error(fmt::format("cannot {} the archive {}: {}", action, path_.string(),
                                       sqlite3_errmsg(database_.get())));
}

void Archive::execute(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail("write to");
}

}  // namespace nlcwfs
