// How long work will take, from how long it has taken.
#pragma once

#include <deque>
#include <optional>
#include <string>

namespace nlcwfs {

/// Predicts how long work will take from how long it has taken: the more recent half of what is
/// done says how fast it goes, so that a slow start (plans, first images) is forgotten and a change
/// of pace is followed.
class TimeLeft {
 public:
  /// @param total  of all the work, in any unit; positive
  /// @param done   of it before the clock starts, such as in an earlier run
  explicit TimeLeft(double total, double done = 0.0);

  /// @param done     of the work in all; never less than before
  /// @param seconds  since the clock's start; never less than before
  /// @param begun    of the work in the piece that is begun then
  void at(double done, double seconds, double begun = 0.0);

  /// s; nothing before a first piece is done. The time that the piece that was begun has taken
  /// since is taken off, but no more than it was to take.
  /// @param seconds  since the clock's start, now
  std::optional<double> seconds_left(double seconds) const;

 private:
  struct Mark {
    double done;
    double seconds;
  };

  double total_;
  double start_;  ///< what was done before
  double begun_ = 0.0;
  Mark last_;
  std::deque<Mark> marks_;  ///< the first is where the recent half begins
};

/// For people, as exact as a prediction is: "about 5 s", "about 12 min", "about 2 h 10 min".
std::string time_left_text(double seconds);

}  // namespace nlcwfs
