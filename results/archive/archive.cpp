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

}  // namespace

/// What is done with the database. All of it fails with the archive's path.
class Archive::Statement {
 public:
  /// @param action  "read" or "write to", for the message
  /// @param values  of the parameters, until they are written; texts that are empty, and NaN, are
  /// NULL
  template <class... Values>
  Statement(const Archive& archive, std::string_view action, const char* sql,
            const Values&... values)
      : archive_(archive), action_(action) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(archive.database_.get(), sql, -1, &statement, nullptr);
    statement_.reset(statement);
    if (!statement) archive.fail(action);
    [[maybe_unused]] int parameter = 0;
    (bind(++parameter, values), ...);
  }

  /// Goes on to the next row, or to the end; whether there is a row.
  bool next() {
    const int status = sqlite3_step(statement_.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) archive_.fail(action_);
    return status == SQLITE_ROW;
  }
  /// The same where there always is one.
  void require_row() {
    if (!next()) archive_.fail(action_);
  }

  /// Bytes or characters of the row; none for NULL.
  template <class Bytes>
  Bytes bytes(int column) const {
    const auto* begin = static_cast<const typename Bytes::value_type*>(
        sqlite3_column_blob(statement_.get(), column));
    return {begin, begin + sqlite3_column_bytes(statement_.get(), column)};
  }
  std::string text(int column) const { return bytes<std::string>(column); }
  /// NaN for NULL.
  double number(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL
               ? std::numeric_limits<double>::quiet_NaN()
               : sqlite3_column_double(statement_.get(), column);
  }

 private:
  void bind(int parameter, std::string_view text) {
    // SQLite stores an unbound parameter as NULL.
    if (text.empty()) return;
    sqlite3_bind_text(statement_.get(), parameter, text.data(), static_cast<int>(text.size()),
                      SQLITE_STATIC);
  }
  void bind(int parameter, double number) {
    sqlite3_bind_double(statement_.get(), parameter, number);
  }
  void bind(int parameter, const std::vector<std::uint8_t>& bytes) {
    sqlite3_bind_blob(statement_.get(), parameter, bytes.data(), static_cast<int>(bytes.size()),
                      SQLITE_STATIC);
  }

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  const Archive& archive_;
  std::string_view action_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

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
      "failure TEXT, PRIMARY KEY (trial, design)) WITHOUT ROWID;"
      "CREATE TABLE files (name TEXT PRIMARY KEY) WITHOUT ROWID");
  Statement(*this, "write to", "INSERT INTO run (command, seconds) VALUES (?, 0)", command).next();
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
  Statement others(
      archive, "read",
      "SELECT 1 FROM sqlite_master WHERE type NOT IN ('table', 'index') OR sql LIKE '%virtual%'");
  if (others.next()) refuse(no_archive);
  Statement table(archive, "read",
                  "SELECT group_concat(name) FROM pragma_table_info('evaluations')");
  table.require_row();
  const int layout = archive.layout();
  if (layout > current_layout) refuse("the archive of a newer version of nlcwfs");
  if (table.text(0) != columns) refuse(no_archive);
  archive.execute(write_through);
  if (layout > 0) {
    Statement run(archive, "read", "SELECT seconds FROM run");
    run.require_row();
    archive.seconds_before_ = run.number(0);
  }
  return archive;
}

int Archive::layout() const {
  Statement statement(*this, "read", "PRAGMA user_version");
  statement.require_row();
  return static_cast<int>(statement.number(0));
}

bool Archive::has_trials() const { return layout() > 0; }

std::string Archive::command() const {
  Statement statement(*this, "read", "SELECT command FROM run");
  statement.require_row();
  return statement.text(0);
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
    Statement(*this, "write to",
              "INSERT INTO evaluations (stage, key, design, cost, failure, seconds, performance) "
              "VALUES (?, ?, ?, ?, ?, ?, ?)",
              evaluation.stage, evaluation.key, evaluation.design, evaluation.cost,
              evaluation.failure, evaluation.seconds, evaluation.performance)
        .next();
  }
}

void Archive::clear_evaluations() {
  const std::scoped_lock lock(*lock_);
  added_.clear();
  execute("DELETE FROM evaluations");
}

void Archive::note_file(const std::string& name) {
  const std::scoped_lock lock(*lock_);
  execute("CREATE TABLE IF NOT EXISTS files (name TEXT PRIMARY KEY) WITHOUT ROWID");
  Statement(*this, "write to", "INSERT OR IGNORE INTO files (name) VALUES (?)", name).next();
}

std::optional<std::set<std::string>> Archive::noted_files() const {
  const std::scoped_lock lock(*lock_);
  Statement table(*this, "read", "SELECT 1 FROM sqlite_master WHERE name = 'files'");
  if (!table.next()) return std::nullopt;
  Statement row(*this, "read", "SELECT name FROM files");
  std::set<std::string> names;
  while (row.next()) names.insert(row.text(0));
  return names;
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
    for (const auto* one : all) {
      Statement(*this, "write to",
                "INSERT OR REPLACE INTO trials (trial, design, performances, failure) VALUES (?, "
                "?, ?, ?)",
                one->trial, one->design, one->known.performances, one->known.failure)
          .next();
    }
    const std::chrono::duration<double> open = std::chrono::steady_clock::now() - opened_;
    Statement(*this, "write to", "UPDATE run SET seconds = ?", seconds_before_ + open.count())
        .next();
  });
  added_.clear();
}

std::size_t Archive::known_designs(const std::string& trial) const {
  const std::scoped_lock lock(*lock_);
  Statement statement(*this, "read", "SELECT count(*) FROM trials WHERE trial = ?", trial);
  statement.require_row();
  return static_cast<std::size_t>(statement.number(0));
}

std::optional<ArchivedTrial> Archive::find(const std::string& trial,
                                           const std::string& design) const {
  const std::scoped_lock lock(*lock_);
  Statement statement(*this, "read",
                      "SELECT performances, failure FROM trials WHERE trial = ? AND design = ?",
                      trial, design);
  if (!statement.next()) return std::nullopt;
  return ArchivedTrial{statement.bytes<std::vector<std::uint8_t>>(0), statement.text(1)};
}

std::vector<ArchivedEvaluation> Archive::evaluations() const {
  const std::scoped_lock lock(*lock_);
  Statement row(*this, "read",
                "SELECT stage, key, design, cost, failure, seconds, performance FROM evaluations "
                "ORDER BY id");
  std::vector<ArchivedEvaluation> all;
  while (row.next()) {
    all.push_back({.stage = row.text(0),
                   .design = row.text(2),
                   .cost = row.number(3),
                   .failure = row.text(4),
                   .seconds = row.number(5),
                   .performance = row.text(6),
                   .key = row.text(1)});
  }
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
