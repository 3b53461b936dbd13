#include "results/archive.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <sqlite3.h>

namespace nlcwfs {
namespace {

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

}  // namespace

void Archive::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Archive::Archive(const std::filesystem::path& path) : path_(path) {
  sqlite3* database = nullptr;
  const int status =
      sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(database);
  if (status != SQLITE_OK) fail("open");
  execute(
      "CREATE TABLE evaluations ("
      "id INTEGER PRIMARY KEY, stage TEXT NOT NULL, design TEXT NOT NULL, cost REAL, "
      "failure TEXT, seconds REAL NOT NULL, performance TEXT)");
}

void Archive::add(const ArchivedEvaluation& evaluation) {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database_.get(),
                         "INSERT INTO evaluations "
                         "(stage, design, cost, failure, seconds, performance) "
                         "VALUES (?, ?, ?, ?, ?, ?)",
                         -1, &prepared, nullptr) != SQLITE_OK) {
    fail("write to");
  }
  const std::unique_ptr<sqlite3_stmt, Finalize> statement(prepared);
  // SQLite stores an unbound parameter, and a NaN, as NULL.
  const auto bind_text = [&](int parameter, const std::string& text) {
    if (text.empty()) return;
    sqlite3_bind_text(prepared, parameter, text.data(), static_cast<int>(text.size()),
                      SQLITE_STATIC);
  };
  bind_text(1, evaluation.stage);
  bind_text(2, evaluation.design);
  sqlite3_bind_double(prepared, 3, evaluation.cost);
  bind_text(4, evaluation.failure);
  sqlite3_bind_double(prepared, 5, evaluation.seconds);
  bind_text(6, evaluation.performance);
  if (sqlite3_step(prepared) != SQLITE_DONE) fail("write to");
}

void Archive::fail(std::string_view action) const {
  throw std::runtime_error(fmt::format("cannot {} the archive {}: {}", action, path_.string(),
                                       sqlite3_errmsg(database_.get())));
}

void Archive::execute(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail("write to");
}

}  // namespace nlcwfs
