// A search is watched: archive, table and progress.
#pragma once

#include "optimizer/evaluator.hpp"
#include "results/pictures/search_pictures.hpp"
#include "results/tables/csv_table.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/settings/setup.hpp"

#include <stop_token>

namespace nlcwfs {

/// For people: "Tried 150 designs on 16 screens in single precision in 1 min, all that
/// search.budget allows".
/// @param designs    how many, and of which kind: "150 designs"
/// @param seconds    that the search took
/// @param budget     the key that limits it
/// @param converged  how a search ends that finds nothing better: "until nothing got better"
std::string tried_text(const std::string& designs, const DesignTrial& trial, Precision precision,
                       double seconds, Termination termination, std::string_view budget,
                       std::string_view converged);

/// Watches a search of a design space: archive, table and progress line.
class SearchLog {
 public:
  /// @param stage  for the archive and the progress line: "search"
  /// @param setup  whose telescope and seeing the designs are for
  /// @param options  of the search: the log becomes its observer, which stops it at an interrupt
  /// @param then, whole  see Progress
  /// @param objectives  of a search with several, for the table
  SearchLog(std::string stage, const DesignSpace& space, const Setup& setup,
            EvaluatorOptions& options, RunRecord& record, std::string then,
            const Progress* whole = nullptr, std::vector<DesignMetric> objectives = {});

  /// Ends a design at an interrupt, but not before the first one of the search is done, so that
  /// there is a result.
  ScreenWatch interruptible() const;

  /// Of the screens of all designs, those given up included.
  long reconstructions() const { return reconstructions_; }
  /// Designs that a race gave up.
  int given_up() const { return given_up_; }
  /// The designs in the order in which they were tried.
  std::string table() const { return table_.text(); }
  /// The same, as they are drawn.
  const std::vector<SearchStep>& steps() const { return steps_; }

 private:
  /// Archives an evaluation, and shows how far the search is.
  void add(const EvaluationRecord& evaluation);

  std::string stage_;
  const DesignSpace& space_;
  const Setup& setup_;
  std::vector<DesignMetric> objectives_;
  RunRecord& record_;
  std::stop_source stop_;
  Progress progress_;
  CsvTable table_;
  std::vector<SearchStep> steps_;
  long reconstructions_ = 0;
  int budget_;
  int evaluations_ = 0;
  int given_up_ = 0;
};

}  // namespace nlcwfs
