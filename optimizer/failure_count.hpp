// When so many evaluations fail that a study is given up.
#pragma once

namespace nlcwfs {

/// Whether so many evaluations fail that a study is given up: `allowed_in_a_row` with no success in
/// between, where they are at least half of all. (A local search beside a region of failures may
/// meet as many late in a search that is going well.)
class FailureCount {
 public:
  static constexpr int allowed_in_a_row = 20;  ///< and no more

  /// Counts an evaluation.
  void add(bool is_failure) {
    ++all_;
    failures_ += is_failure ? 1 : 0;
    in_a_row_ = is_failure ? in_a_row_ + 1 : 0;
  }

  int failures() const { return failures_; }  ///< of all evaluations
  int in_a_row() const { return in_a_row_; }  ///< the last ones
  /// Whether to give up.
  bool is_too_high() const { return in_a_row_ >= allowed_in_a_row && 2 * in_a_row_ >= all_; }

 private:
  int all_ = 0;
  int failures_ = 0;
  int in_a_row_ = 0;
};

}  // namespace nlcwfs
