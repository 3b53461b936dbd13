#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;

namespace nlcwfs {

/// One evaluation of a design, as it is archived.
struct ArchivedEvaluation {
  std::string stage;        ///< "evaluate", "search", "sweep", "verify"
  std::string design;       ///< JSON, see design_summary.hpp
  double cost;              ///< NaN where there is none
  std::string failure;      ///< why there is no cost; empty where there is one
  double seconds;           ///< how long it took, s
  std::string performance;  ///< JSON; empty where the evaluation failed
  std::string key = {};     ///< what identifies the design among the run's; may be empty
};

/// Every evaluation of a run, in an SQLite file with one table, `evaluations`. An evaluation is on
/// disk when add() returns.
class Archive {
 public:
  /// @param path  a file that does not exist
  /// @throws std::runtime_error with path and cause; so do the other functions
  explicit Archive(const std::filesystem::path& path);

  /// Opens that of an earlier run.
  /// @throws std::runtime_error also where there is none, or its table has other columns
  static Archive reopened(const std::filesystem::path& path);

  /// Appends an evaluation; it is on disk when this returns.
  void add(const ArchivedEvaluation& evaluation);

  /// Everything in it, in the order in which it was added.
  std::vector<ArchivedEvaluation> evaluations() const;

 private:
  Archive(const std::filesystem::path& path, int flags);

  [[noreturn]] void fail(std::string_view action) const;
  void execute(const char* sql);

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace nlcwfs
