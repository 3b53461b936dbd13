// A search is watched: archive, table and progress.
#pragma once

#include "model/telescope.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/design_space.hpp"
#include "objectives/design_trial.hpp"
#include "optimizer/evaluator.hpp"
#include "results/archive/archive.hpp"
#include "results/pictures/search_pictures.hpp"
#include "results/tables/csv_table.hpp"
#include "studies/run/progress.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

/// Watches a search of a design space: archive, table and progress line.
class SearchLog {
 public:
  /// @param stage  for the archive and the progress line: "search"
  /// @param then, whole  see Progress
  /// @param objectives  of a search with several, for the table
  SearchLog(std::string stage, const DesignSpace& space, const Telescope& telescope,
            double fried_parameter, const EvaluatorOptions& limits, Archive& archive,
            std::string then, const Progress* whole = nullptr,
            std::vector<DesignMetric> objectives = {});

  /// Ends a design at an interrupt, but not before the first one of the search is done, so that
  /// there is a result.
  ScreenWatch interruptible() const;

  /// Archives an evaluation, and shows how far the search is.
  void add(const EvaluationRecord& evaluation);

  /// Of the screens of all designs, those given up included.
  long reconstructions() const { return reconstructions_; }
  /// Designs that a race gave up.
  int given_up() const { return given_up_; }
  /// The designs in the order in which they were tried.
  std::string table() const { return table_.text(); }
  /// The same, as they are drawn.
  const std::vector<SearchStep>& steps() const { return steps_; }

 private:
  void show_progress(const EvaluationRecord& evaluation);

  std::string stage_;
  const DesignSpace& space_;
  const Telescope& telescope_;
  double fried_parameter_;
  std::vector<DesignMetric> objectives_;
  Archive& archive_;
  Progress progress_;
  CsvTable table_;
  std::vector<SearchStep> steps_;
  long reconstructions_ = 0;
  int budget_;
  int evaluations_ = 0;
  int given_up_ = 0;
};

}  // namespace nlcwfs
