#include "studies/trial_queue.hpp"

#include "objectives/design_trial.hpp"

#include <algorithm>
#include <condition_variable>
#include <iterator>
#include <mutex>
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

  /// Whether a part may be begun. The first always is, so that there is a screen.
  bool begin(std::size_t part) {
    const std::lock_guard guard(lock);
    if (!is_ended || part == 0) return true;
    finish_part();
    return false;
  }

  /// Asks the watch, once for each screen under each condition.
  void count(int screens) {
    if (!watch) return;
    for (int i = 0; i < screens; ++i) {
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
  block_->count(count() * static_cast<int>(performances.size()));
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

TrialQueue::TrialQueue(int here, int elsewhere) : threads_(here + elsewhere) {
  for (int i = 0; i < here; ++i) here_.emplace_back([this] { simulate_pieces(); });
}

TrialQueue::~TrialQueue() {
  for (std::size_t i = 0; i < here_.size(); ++i) pieces_.push({});
}

void TrialQueue::simulate_pieces() {
  // Each on its thread alone: there are pieces enough for all.
  tbb::task_arena(1).execute([this] {
    for (Piece piece; pieces_.pop(piece), piece.block_;) {
      if (!piece.block_->begin(piece.number_)) continue;
      try {
        piece.done(piece.trial().simulate(piece.design(), piece.first(), piece.count()));
      } catch (...) {
        piece.failed(std::current_exception());
      }
    }
  });
}

std::optional<TrialQueue::Piece> TrialQueue::take() {
  for (Piece piece; pieces_.try_pop(piece);) {
    if (piece.block_->begin(piece.number_)) return piece;
  }
  return std::nullopt;
}

std::vector<Performance> TrialQueue::run(const DesignTrial& trial, const SensorDesign& design,
                                         int first, int count, const ScreenWatch& watch) {
  // Few designs are cut finely, so that there is work for all; many need not be.
  const int blocks = ++blocks_;
  const int parts = std::clamp((2 * threads_ + blocks - 1) / blocks, 1, count);
  const auto block = std::make_shared<Block>(trial, design, watch);
  for (int i = 0; i < parts; ++i) {
    const int begin = count * i / parts;
    block->parts.push_back({first + begin, count * (i + 1) / parts - begin});
  }
  block->left = block->parts.size();
  for (std::size_t i = 0; i < block->parts.size(); ++i) {
    Piece piece;
    piece.block_ = block;
    piece.number_ = i;
    pieces_.push(piece);
  }
  {
    std::unique_lock guard(block->lock);
    block->is_finished.wait(guard, [&] { return block->left == 0; });
  }
  --blocks_;
  if (block->failure) std::rethrow_exception(block->failure);
  std::vector<Performance> performances(trial.conditions().size());
  for (Block::Part& part : block->parts) {
    if (part.performances.empty()) break;
    for (std::size_t k = 0; k < part.performances.size(); ++k) {
      std::ranges::move(part.performances[k].screens, std::back_inserter(performances[k].screens));
    }
  }
  return performances;
}

}  // namespace nlcwfs
