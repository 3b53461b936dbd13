// How far a command is, and how long it will take.
#pragma once

#include "model/simulation.hpp"
#include "studies/run/stopwatch.hpp"
#include "studies/run/time_left.hpp"

#include <limits>
#include <mutex>

namespace nlcwfs {

/// How far a stage of a command is: the line of progress (see start_log) while it lives, "sweep:
/// 14 of 576 designs, about 3 min left"; then a line of the log with the time it took. Its methods
/// may be called from several threads, often: it writes ten times a second at most.
class Progress {
 public:
  /// @param stage  "verification"
  /// @param total  how much there is to do, in `unit`s: "screens"
  /// @param then   what comes after it, for people: "then the verification"; may be empty, and is
  ///               left out where there is a whole
  /// @param whole  stands before it in the line, where it is a part of more; outlives it
  Progress(std::string stage, double total, std::string unit, std::string then = {},
           const Progress* whole = nullptr);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What was done before, which says nothing of the time that the rest takes. Call it first.
  void starts_at(double done);
  /// The stage ends after so long even if not all is done, s.
  void must_end_by(double seconds);
  /// More is done.
  void advance(double by = 1.0);
  /// So much is done in all.
  /// @param begun  how much the piece is that is begun now
  void at(double done, double begun = 0.0);
  /// Says so in place of "14 of 576 designs".
  void describe(std::string text);

 private:
  std::string text() const;
  void show();

  const std::string stage_;
  const std::string unit_;
  const std::string then_;
  const Progress* const whole_;
  const Stopwatch stopwatch_;
  mutable std::mutex lock_;
  const double total_;
  double done_ = 0.0;
  double limit_ = std::numeric_limits<double>::infinity();  // s
  TimeLeft left_;
  std::string description_;
  double next_show_ = 0.0;  // s of the stopwatch
};

/// A watch that advances the progress by each screen, and ends at an interrupt, but not before two
/// screens, so that their mean has an error.
ScreenWatch interruptible(Progress& progress);

/// The same, which an interrupt does not end.
ScreenWatch counted(Progress& progress);

}  // namespace nlcwfs
