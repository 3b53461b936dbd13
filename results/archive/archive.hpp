// Every evaluation and every trial of a run, in SQLite.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;

namespace nlcwfs {

/// One evaluation of a design, as it is archived.
struct ArchivedEvaluation {
  std::string stage;             ///< "evaluate", "search", "sweep", "verify"
  std::string design;            ///< JSON, see design_summary.hpp
  double cost = 0.0;             ///< NaN where there is none
  std::string failure = {};      ///< why there is no cost; empty where there is one
  double seconds = 0.0;          ///< how long it took, s
  std::string performance = {};  ///< JSON; empty where the evaluation failed
  std::string key = {};          ///< what identifies the design among the run's; may be empty
};

/// What is known of a design in a trial, as it is archived: see TrialMemory.
struct ArchivedTrial {
  std::vector<std::uint8_t> performances;  ///< performance_record(); empty where it failed
  std::string failure = {};                ///< why it did; empty where it did not

  bool operator==(const ArchivedTrial&) const = default;  ///< to the last bit
};

/// What a run has found out, in an SQLite file: the table `trials` of every screen that was
/// simulated, from which the run can go on, and the table `evaluations` of what it reports, which
/// it can make again from the trials. One archive may be used by many threads.
class Archive {
 public:
  /// Makes it.
  /// @param path     a file that does not exist
  /// @param command  whose run it is
  /// @throws std::runtime_error with path and cause; so do the other functions
  Archive(const std::filesystem::path& path, std::string_view command);

  /// Opens that of an earlier run, which may be a run of an older version.
  /// @throws std::runtime_error also where there is none, its tables are not those of an archive,
  ///         or a newer version has made it
  static Archive reopened(const std::filesystem::path& path);

  /// Not while it is in use.
  Archive(Archive&& other) noexcept;
  Archive& operator=(Archive&&) = delete;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive();

  /// Its file.
  const std::filesystem::path& path() const { return path_; }

  /// Whose run it is.
  std::string command() const;

  /// Whether a run can go on from it: not from that of an older version.
  bool has_trials() const;

  /// Appends an evaluation. It is on disk with the next trial that is kept, or after commit(), or
  /// when the archive is gone.
  void add(const ArchivedEvaluation& evaluation);

  /// Puts all evaluations on disk.
  void commit();

  /// Everything that was added, in that order.
  std::vector<ArchivedEvaluation> evaluations() const;

  /// How long earlier runs in this archive had worked when they last kept something, s.
  double seconds_before() const { return seconds_before_; }

  /// How many designs are known in a trial.
  std::size_t known_designs(const std::string& trial) const;

  /// Forgets the evaluations, for a run that goes on: it adds those that it finds in the trials
  /// again.
  void clear_evaluations();

  /// Keeps that the run writes a file of its folder, from now on. It is on disk when the function
  /// returns.
  void note_file(const std::string& name);

  /// Every file that was noted; nothing where an older version, which noted none, has made the
  /// archive.
  std::optional<std::set<std::string>> noted_files() const;

  /// Keeps what is known of a design in a trial, in place of what was known before. It is on disk
  /// when the function returns. What many threads keep at once goes there together: a disk takes
  /// about as long for all as for one.
  void keep(const std::string& trial, const std::string& design, const ArchivedTrial& known);

  /// Nothing where the design is not known.
  std::optional<ArchivedTrial> find(const std::string& trial, const std::string& design) const;

 private:
  Archive(const std::filesystem::path& path, int flags);

  class Statement;
  [[noreturn]] void fail(std::string_view action) const;
  void execute(const char* sql);
  /// What `write` writes is on disk when it returns, or none of it is.
  /// @pre lock_ is held
  void in_transaction(const std::function<void()>& write);
  /// @pre lock_ is held
  void commit_added();
  /// @pre lock_ is held, and a transaction is open
  void write_added();
  int layout() const;

  /// What a thread keeps.
  struct Keeping;
  /// What threads wait for.
  struct Queue {
    std::mutex lock;
    std::condition_variable has_changed;
    std::vector<Keeping*> waiting;
    bool is_busy = false;  // a thread writes what all before have given it
  };
  void write(const std::vector<Keeping*>& all);

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> database_;
  std::vector<ArchivedEvaluation> added_;  // that are not on disk
  double seconds_before_ = 0.0;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  // Movable.
  std::unique_ptr<std::mutex> lock_ = std::make_unique<std::mutex>();
  std::unique_ptr<Queue> queue_ = std::make_unique<Queue>();
};

}  // namespace nlcwfs
