// Every evaluation and every trial of a run, in SQLite.
#include "results/archive/archive.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

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

/// Of the tables, as the file's user_version: 0 had no trials.
constexpr int current_layout = 1;

/// After a commit the journal's end is on disk too: a power cut takes back nothing that was told.
constexpr const char* write_through = "PRAGMA synchronous = EXTRA";

/// Of the table `evaluations` in every layout.
constexpr std::string_view columns = "id,stage,key,design,cost,failure,seconds,performance";

/// Whether a journal lies beside the file that names a journal of several databases, which SQLite
/// would delete; that of one archive, whose run was killed, has none. The name's end is this mark.
/// Source: SQLite's Database File Format, section 3 (The Rollback Journal).
bool has_journal_of_several(const std::filesystem::path& path) {
  constexpr std::array<unsigned char, 8> mark{0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
  std::error_code ignored;
  std::filesystem::path journal = std::filesystem::weakly_canonical(path, ignored);
  journal += "-journal";
  std::ifstream file(journal, std::ios::binary);
  std::array<char, mark.size()> end{};
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!file.read(end.data(), end.size())) return false;
  return std::ranges::equal(end, mark, [](char one, unsigned char other) {
    return static_cast<unsigned char>(one) == other;
  });
}

void bind_text(sqlite3_stmt* statement, int parameter, const std::string& text) {
  // SQLite stores an unbound parameter as NULL.
  if (text.empty()) return;
  sqlite3_bind_text(statement, parameter, text.data(), static_cast<int>(text.size()),
                    SQLITE_STATIC);
}

}  // namespace

void Archive::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Archive::Archive(Archive&&) noexcept = default;

Archive::~Archive() {
  try {
    if (database_) commit();
  } catch (const std::exception&) {
    // A run that ends well has called it before, and a run that goes on makes them again.
  }
}

Archive::Archive(const std::filesystem::path& path, int flags) : path_(path) {
  sqlite3* database = nullptr;
  // Absolute, as SQLite may take another name for that of a place elsewhere, "file:...".
  const int status =
      sqlite3_open_v2(std::filesystem::absolute(path).c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (status != SQLITE_OK) fail("open");
  // Another program may read it meanwhile, or write to it.
  constexpr int patience_ms = 60'000;
  sqlite3_busy_timeout(database, patience_ms);
}

Archive::Archive(const std::filesystem::path& path, std::string_view command)
    : Archive(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) {
  execute(write_through);
  execute(
      "BEGIN;"
      "CREATE TABLE run (command TEXT NOT NULL, seconds REAL NOT NULL);"
      "CREATE TABLE evaluations ("
      "id INTEGER PRIMARY KEY, stage TEXT NOT NULL, key TEXT, design TEXT NOT NULL, cost REAL, "
      "failure TEXT, seconds REAL NOT NULL, performance TEXT);"
      "CREATE TABLE trials (trial TEXT NOT NULL, design TEXT NOT NULL, performances BLOB, "
      "failure TEXT, PRIMARY KEY (trial, design)) WITHOUT ROWID");
  const Statement statement =
      prepared(database_.get(), "INSERT INTO run (command, seconds) VALUES (?, 0)");
  if (!statement) fail("write to");
  const std::string name(command);
  bind_text(statement.get(), 1, name);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) fail("write to");
  execute(fmt::format("PRAGMA user_version = {}; COMMIT", current_layout).c_str());
}

Archive Archive::reopened(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view what) {
    throw std::runtime_error(fmt::format("{} is {}", path.string(), what));
  };
  constexpr std::string_view no_archive = "no archive of a run of nlcwfs";
  if (has_journal_of_several(path)) refuse(no_archive);
  Archive archive(path, SQLITE_OPEN_READWRITE);
  // What the file's own expressions may do.
  sqlite3_db_config(archive.database_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(archive.database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  // A view may have rows without end.
  const Statement others = prepared(
      archive.database_.get(),
      "SELECT 1 FROM sqlite_master WHERE type NOT IN ('table', 'index') OR sql LIKE '%virtual%'");
  if (!others) archive.fail("read");
  const int status = sqlite3_step(others.get());
  if (status == SQLITE_ROW) refuse(no_archive);
  if (status != SQLITE_DONE) archive.fail("read");
  const Statement table = prepared(
      archive.database_.get(), "SELECT group_concat(name) FROM pragma_table_info('evaluations')");
  if (!table || sqlite3_step(table.get()) != SQLITE_ROW) archive.fail("read");
  const int layout = archive.layout();
  if (layout > current_layout) refuse("the archive of a newer version of nlcwfs");
  if (text_at(table.get(), 0) != columns) refuse(no_archive);
  archive.execute(write_through);
  if (layout > 0) {
    const Statement run = prepared(archive.database_.get(), "SELECT seconds FROM run");
    if (!run || sqlite3_step(run.get()) != SQLITE_ROW) archive.fail("read");
    archive.seconds_before_ = sqlite3_column_double(run.get(), 0);
  }
  return archive;
}

int Archive::layout() const {
  const Statement statement = prepared(database_.get(), "PRAGMA user_version");
  if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) fail("read");
  return sqlite3_column_int(statement.get(), 0);
}

bool Archive::has_trials() const { return layout() > 0; }

std::string Archive::command() const {
  const Statement statement = prepared(database_.get(), "SELECT command FROM run");
  if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) fail("read");
  return text_at(statement.get(), 0);
}

void Archive::add(const ArchivedEvaluation& evaluation) {
  constexpr std::size_t most_in_memory = 1000;  // that a run may add that finds its trials known
  const std::scoped_lock lock(*lock_);
  added_.push_back(evaluation);
  if (added_.size() >= most_in_memory) commit_added();
}

void Archive::commit() {
  const std::scoped_lock lock(*lock_);
  commit_added();
}

void Archive::commit_added() {
  if (added_.empty()) return;
  in_transaction([&] { write_added(); });
  added_.clear();
}

void Archive::in_transaction(const std::function<void()>& write) {
  execute("BEGIN");
  try {
    write();
    execute("COMMIT");
  } catch (...) {
    // Without what its own failure would say, which is none where SQLite has done it.
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

void Archive::write_added() {
  for (const ArchivedEvaluation& evaluation : added_) {
    const Statement statement = prepared(
        database_.get(),
        "INSERT INTO evaluations (stage, key, design, cost, failure, seconds, performance) "
        "VALUES (?, ?, ?, ?, ?, ?, ?)");
    if (!statement) fail("write to");
    bind_text(statement.get(), 1, evaluation.stage);
    bind_text(statement.get(), 2, evaluation.key);
    bind_text(statement.get(), 3, evaluation.design);
    sqlite3_bind_double(statement.get(), 4, evaluation.cost);  // a NaN becomes NULL
    bind_text(statement.get(), 5, evaluation.failure);
    sqlite3_bind_double(statement.get(), 6, evaluation.seconds);
    bind_text(statement.get(), 7, evaluation.performance);
    if (sqlite3_step(statement.get()) != SQLITE_DONE) fail("write to");
  }
}

void Archive::clear_evaluations() {
  const std::scoped_lock lock(*lock_);
  added_.clear();
  execute("DELETE FROM evaluations");
}

struct Archive::Keeping {
  const std::string& trial;
  const std::string& design;
  const ArchivedTrial& known;
  bool is_done = false;
  std::exception_ptr failure = nullptr;
};

void Archive::keep(const std::string& trial, const std::string& design,
                   const ArchivedTrial& known) {
  Keeping mine{trial, design, known};
  std::unique_lock guard(queue_->lock);
  queue_->waiting.push_back(&mine);
  queue_->has_changed.wait(guard, [&] { return mine.is_done || !queue_->is_busy; });
  if (!mine.is_done) {
    queue_->is_busy = true;
    const std::vector<Keeping*> all = std::exchange(queue_->waiting, {});
    guard.unlock();
    std::exception_ptr failure;
    try {
      write(all);
    } catch (...) {
      failure = std::current_exception();
    }
    guard.lock();
    for (Keeping* one : all) {
      one->failure = failure;
      one->is_done = true;
    }
    queue_->is_busy = false;
    queue_->has_changed.notify_all();
  }
  if (mine.failure) std::rethrow_exception(mine.failure);
}

void Archive::write(const std::vector<Keeping*>& all) {
  const std::scoped_lock lock(*lock_);
  in_transaction([&] {
    write_added();
    for (const Keeping* one : all) write_trial(*one);
    const Statement clock = prepared(database_.get(), "UPDATE run SET seconds = ?");
    if (!clock) fail("write to");
    const std::chrono::duration<double> open = std::chrono::steady_clock::now() - opened_;
    sqlite3_bind_double(clock.get(), 1, seconds_before_ + open.count());
    if (sqlite3_step(clock.get()) != SQLITE_DONE) fail("write to");
  });
  added_.clear();
}

void Archive::write_trial(const Keeping& one) {
  const Statement statement = prepared(
      database_.get(),
      "INSERT OR REPLACE INTO trials (trial, design, performances, failure) VALUES (?, ?, ?, ?)");
  if (!statement) fail("write to");
  bind_text(statement.get(), 1, one.trial);
  bind_text(statement.get(), 2, one.design);
  const ArchivedTrial& known = one.known;
  if (known.failure.empty()) {
    sqlite3_bind_blob(statement.get(), 3, known.performances.data(),
                      static_cast<int>(known.performances.size()), SQLITE_STATIC);
  }
  bind_text(statement.get(), 4, known.failure);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) fail("write to");
}

std::size_t Archive::known_designs(const std::string& trial) const {
  const std::scoped_lock lock(*lock_);
  const Statement statement =
      prepared(database_.get(), "SELECT count(*) FROM trials WHERE trial = ?");
  if (!statement) fail("read");
  bind_text(statement.get(), 1, trial);
  if (sqlite3_step(statement.get()) != SQLITE_ROW) fail("read");
  return static_cast<std::size_t>(sqlite3_column_int64(statement.get(), 0));
}

std::optional<ArchivedTrial> Archive::find(const std::string& trial,
                                           const std::string& design) const {
  const std::scoped_lock lock(*lock_);
  const Statement statement = prepared(
      database_.get(), "SELECT performances, failure FROM trials WHERE trial = ? AND design = ?");
  if (!statement) fail("read");
  bind_text(statement.get(), 1, trial);
  bind_text(statement.get(), 2, design);
  const int status = sqlite3_step(statement.get());
  if (status == SQLITE_DONE) return std::nullopt;
  if (status != SQLITE_ROW) fail("read");
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement.get(), 0));
  return ArchivedTrial{{bytes, bytes + sqlite3_column_bytes(statement.get(), 0)},
                       text_at(statement.get(), 1)};
}

std::vector<ArchivedEvaluation> Archive::evaluations() const {
  const std::scoped_lock lock(*lock_);
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
  all.insert(all.end(), added_.begin(), added_.end());
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
