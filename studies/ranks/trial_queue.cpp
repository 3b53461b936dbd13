// Trials are cut into pieces, which wait for whoever is free.
#include "studies/ranks/trial_queue.hpp"

#include "objectives/design_trial.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include <tbb/task_arena.h>

namespace nlcwfs {

/// What one call of run() asks for.
struct TrialQueue::Block {
  struct Part {
    int first;
    int count;
    std::vector<Performance> performances = {};  // none where it was not begun
  };

  const DesignTrial& trial;
  const SensorDesign& design;
  const ScreenWatch& watch;
  std::vector<Part> parts;

  std::mutex lock;
  std::condition_variable is_finished;
  std::size_t left = 0;   // parts that are not given back
  bool is_ended = false;  // no part is begun any more; those that are begun are finished
  std::exception_ptr failure;

  Block(const DesignTrial& of_trial, const SensorDesign& of_design, const ScreenWatch& with_watch)
      : trial(of_trial), design(of_design), watch(with_watch) {}

  void finish_part() {
    if (--left == 0) is_finished.notify_all();
  }

  /// Whether a part may be begun. The first always is, so that there is a screen; after an end it
  /// is that screen alone.
  bool begin(std::size_t part) {
    const std::lock_guard guard(lock);
    if (part == 0) {
      if (watch && !watch()) is_ended = true;
      if (is_ended) parts.front().count = 1;
      return true;
    }
    if (!is_ended) return true;
    finish_part();
    return false;
  }

  /// Asks the watch, once for each screen under each condition. For the very first it was asked
  /// when that was begun: many designs may wait, of which none is to be simulated after an end.
  void count(std::size_t part, int screens) {
    if (!watch) return;
    for (int i = part == 0 ? 1 : 0; i < screens; ++i) {
      if (watch()) continue;
      const std::lock_guard guard(lock);
      is_ended = true;
    }
  }
};

const DesignTrial& TrialQueue::Piece::trial() const { return block_->trial; }
const SensorDesign& TrialQueue::Piece::design() const { return block_->design; }
int TrialQueue::Piece::first() const { return block_->parts[number_].first; }
int TrialQueue::Piece::count() const { return block_->parts[number_].count; }

void TrialQueue::Piece::done(std::vector<Performance> performances) const {
  block_->count(number_, count() * static_cast<int>(performances.size()));
  const std::lock_guard guard(block_->lock);
  block_->parts[number_].performances = std::move(performances);
  block_->finish_part();
}

void TrialQueue::Piece::failed(std::exception_ptr why) const {
  const std::lock_guard guard(block_->lock);
  block_->is_ended = true;
  block_->failure = std::move(why);
  block_->finish_part();
}

TrialQueue::TrialQueue(int here, const std::vector<int>& elsewhere)
    : threads_(std::accumulate(elsewhere.begin(), elsewhere.end(), here)),
      processes_(1 + elsewhere.size()) {
  try {
    for (int i = 0; i < here; ++i) here_.emplace_back([this] { simulate_pieces(); });
  } catch (...) {
    end();  // what has started would wait for ever
    throw;
  }
}

TrialQueue::~TrialQueue() { end(); }

void TrialQueue::end() {
  const std::lock_guard guard(lock_);
  is_over_ = true;
  has_more_.notify_all();
}

void TrialQueue::simulate_pieces() {
  const auto next = [this]() -> std::optional<Piece> {
    std::unique_lock guard(lock_);
    for (;;) {
      if (auto piece = next_piece(0)) return piece;
      if (is_over_) return std::nullopt;
      has_more_.wait(guard);
    }
  };
  // Each on its thread alone: there are pieces enough for all.
  tbb::task_arena(1).execute([&] {
    while (const auto piece = next()) {
      try {
        piece->done(piece->trial().simulate(piece->design(), piece->first(), piece->count()));
      } catch (...) {
        piece->failed(std::current_exception());
      }
    }
  });
}

std::optional<TrialQueue::Piece> TrialQueue::next_piece(std::size_t process) {
  while (!pieces_.empty()) {
    auto chosen = std::ranges::find_if(pieces_, [&](const Piece& piece) {
      const std::size_t parts = piece.block_->parts.size();
      return piece.number_ % processes_ == process % std::min(parts, processes_);
    });
    if (chosen == pieces_.end()) chosen = pieces_.begin();
    Piece piece = std::move(*chosen);
    pieces_.erase(chosen);
    if (piece.block_->begin(piece.number_)) return piece;
  }
  return std::nullopt;
}

std::optional<TrialQueue::Piece> TrialQueue::take(std::size_t process) {
  const std::lock_guard guard(lock_);
  return next_piece(process);
}

int TrialQueue::waiting() const {
  const std::lock_guard guard(lock_);
  return static_cast<int>(pieces_.size());
}

std::vector<Performance> TrialQueue::run(const DesignTrial& trial, const SensorDesign& design,
                                         int first, int count, const ScreenWatch& watch) {
  const auto block = std::make_shared<Block>(trial, design, watch);
  {
    const std::lock_guard guard(lock_);
    ++blocks_;
    // Few designs are cut finely, so that there is work for all; many need not be. But no process
    // should make all images, unless the layout of a design would be made for few screens each.
    constexpr int least_screens = 4;
    const int for_all = (2 * threads_ + blocks_ - 1) / blocks_;
    const int for_images = std::min(static_cast<int>(processes_), count / least_screens);
    const int parts = std::clamp(std::max(for_all, for_images), 1, count);
    for (int i = 0; i < parts; ++i) {
      const int begin = count * i / parts;
      block->parts.push_back({first + begin, count * (i + 1) / parts - begin});
    }
    block->left = block->parts.size();
    for (std::size_t i = 0; i < block->parts.size(); ++i) {
      Piece piece;
      piece.block_ = block;
      piece.number_ = i;
      pieces_.push_back(std::move(piece));
    }
  }
  has_more_.notify_all();
  {
    std::unique_lock guard(block->lock);
    block->is_finished.wait(guard, [&] { return block->left == 0; });
  }
  {
    const std::lock_guard guard(lock_);
    --blocks_;
  }
  if (block->failure) std::rethrow_exception(block->failure);
  std::vector<Performance> performances(trial.conditions().size());
  int next = first;
  for (Block::Part& part : block->parts) {
    // Not begun, or behind screens that were not.
    if (part.performances.empty() || part.first != next) break;
    next += part.count;
    for (std::size_t k = 0; k < part.performances.size(); ++k) {
      std::ranges::move(part.performances[k].screens, std::back_inserter(performances[k].screens));
    }
  }
  return performances;
}

}  // namespace nlcwfs
