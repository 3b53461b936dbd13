// How far a command is, and how long it will take.
#include "studies/run/progress.hpp"

#include "studies/run/interrupt.hpp"
#include "studies/run/log.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <spdlog/spdlog.h>

#include <fmt/format.h>

namespace nlcwfs {

Progress::Progress(std::string stage, double total, std::string unit, std::string then,
                   const Progress* whole)
    : stage_(std::move(stage)),
      unit_(std::move(unit)),
      then_(std::move(then)),
      whole_(whole),
      total_(total),
      left_(total) {
  spdlog::debug("{}: begun, {:g} {}", stage_, total_, unit_);
  show();
}

Progress::~Progress() {
  show_progress_line("");
  spdlog::debug("{}: ended, {:g} of {:g} {} in {:.3g} s", stage_, done_, total_, unit_,
                stopwatch_.seconds());
}

void Progress::starts_at(double done) {
  const std::scoped_lock lock(lock_);
  done_ = done;
  left_ = TimeLeft(total_, done);
}

void Progress::advance(double by) {
  const std::scoped_lock lock(lock_);
  done_ += by;
  left_.at(done_, stopwatch_.seconds());
  show();
}

void Progress::at(double done, double begun) {
  const std::scoped_lock lock(lock_);
  done_ = done;
  left_.at(done_, stopwatch_.seconds(), begun);
  show();
}

void Progress::must_end_by(double seconds) { limit_ = seconds; }

void Progress::describe(std::string text) {
  const std::scoped_lock lock(lock_);
  description_ = std::move(text);
}

std::string Progress::text() const {
  std::string text =
      fmt::format("{}: {}", stage_,
                  description_.empty() ? fmt::format("{:.0f} of {:.0f} {}", done_, total_, unit_)
                                       : description_);
  const double now = stopwatch_.seconds();
  if (const auto seconds = left_.seconds_left(now); seconds && done_ < total_) {
    text += fmt::format(", {} left", time_left_text(std::min(*seconds, limit_ - now)));
  }
  if (whole_ == nullptr && !then_.empty()) text += fmt::format(", {}", then_);
  return text;
}

void Progress::show() {
  constexpr double interval = 0.1;  // s
  const double now = stopwatch_.seconds();
  if (now < next_show_) return;
  next_show_ = now + interval;
  if (whole_ == nullptr) return show_progress_line(text());
  const std::scoped_lock lock(whole_->lock_);
  show_progress_line(fmt::format("{}; {}", whole_->text(), text()));
}

ScreenWatch interruptible(Progress& progress) {
  constexpr int least_screens = 2;
  return [&progress, done = std::make_shared<std::atomic<int>>(0)] {
    progress.advance();
    return ++*done < least_screens || !InterruptWatch::interrupted();
  };
}

ScreenWatch counted(Progress& progress) {
  return [&progress] {
    progress.advance();
    return true;
  };
}

}  // namespace nlcwfs
