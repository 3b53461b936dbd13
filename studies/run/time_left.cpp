// How long work will take, from how long it has taken.
#include "studies/run/time_left.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Marks are this share of the work apart, at least.
constexpr double mark_spacing = 0.005;
/// Threads finish pieces in bursts, so that a few pieces say nothing of the pace.
constexpr std::size_t least_marks = 16;

}  // namespace

TimeLeft::TimeLeft(double total, double done)
    : total_(total), start_(done), last_{done, 0.0}, marks_{last_} {}

void TimeLeft::at(double done, double seconds, double begun) {
  begun_ = begun;
  last_ = {done, seconds};
  if (done - marks_.back().done >= mark_spacing * total_) marks_.push_back(last_);
  const double half = 0.5 * (start_ + done);
  while (marks_.size() > least_marks && marks_[1].done <= half) marks_.pop_front();
}

std::optional<double> TimeLeft::seconds_left(double seconds) const {
  const Mark& from = marks_.front();
  if (!(last_.done > from.done)) return std::nullopt;
  const double pace = (last_.seconds - from.seconds) / (last_.done - from.done);
  const double since = std::clamp(seconds - last_.seconds, 0.0, pace * begun_);
  return std::max(0.0, pace * (total_ - last_.done) - since);
}

std::string time_left_text(double seconds) {
  const auto multiple = [&](double unit) { return std::max(1L, std::lround(seconds / unit)); };
  if (seconds < 57.5) return fmt::format("about {} s", 5 * multiple(5.0));
  if (seconds < 3570.0) return fmt::format("about {} min", multiple(60.0));
  const long minutes = 10 * multiple(600.0);
  return fmt::format("about {} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace nlcwfs
