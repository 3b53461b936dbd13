#pragma once

#include "objectives/trial_runner.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <tbb/concurrent_queue.h>

namespace nlcwfs {

/// Cuts what trials ask for into pieces, which wait in one queue for whoever is free: threads of
/// this process, and whatever else takes them.
class TrialQueue : public TrialRunner {
  struct Block;

 public:
  /// Some screens of a design. It is given back, done or failed, once.
  class Piece {
   public:
    const DesignTrial& trial() const;    ///< to simulate
    const SensorDesign& design() const;  ///< that is tried
    int first() const;                   ///< the first of the screens, counted from 0
    int count() const;                   ///< how many screens
    /// With the performance of each screen, per condition.
    void done(std::vector<Performance> performances) const;
    /// With what DesignTrial::run is to throw.
    void failed(std::exception_ptr why) const;

   private:
    friend class TrialQueue;
    std::shared_ptr<Block> block_;  // null: there will be no more pieces
    std::size_t number_ = 0;
  };

  /// @param here       threads of this process
  /// @param elsewhere  threads that others have, who take pieces
  TrialQueue(int here, int elsewhere);
  ~TrialQueue() override;
  TrialQueue(const TrialQueue&) = delete;
  TrialQueue& operator=(const TrialQueue&) = delete;

  std::vector<Performance> run(const DesignTrial& trial, const SensorDesign& design, int first,
                               int count, const ScreenWatch& watch) override;
  int threads() const override { return threads_; }

  /// The next piece; nothing where none waits.
  std::optional<Piece> take();

  /// About how many pieces wait.
  int waiting() const { return static_cast<int>(pieces_.size()); }

 private:
  void simulate_pieces();

  int threads_;
  std::atomic<int> blocks_ = 0;  // that are being run
  tbb::concurrent_bounded_queue<Piece> pieces_;
  std::vector<std::jthread> here_;
};

}  // namespace nlcwfs
