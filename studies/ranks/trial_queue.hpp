// Trials are cut into pieces, which wait for whoever is free.
#pragma once

#include "objectives/trial_runner.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace nlcwfs {

/// Cuts what trials ask for into pieces, which wait in one queue for whoever is free: threads of
/// this process, and other processes. Each process is given the same screens of every design where
/// it can: it keeps their images, which designs that share planes share.
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
    std::shared_ptr<Block> block_;
    std::size_t number_ = 0;
  };

  /// @param here       threads of this process, which is number 0
  /// @param elsewhere  threads of other processes, who take pieces, by their numbers from 1
  TrialQueue(int here, const std::vector<int>& elsewhere);
  ~TrialQueue() override;
  TrialQueue(const TrialQueue&) = delete;
  TrialQueue& operator=(const TrialQueue&) = delete;

  std::vector<Performance> run(const DesignTrial& trial, const SensorDesign& design, int first,
                               int count, const ScreenWatch& watch) override;
  int threads() const override { return threads_; }

  /// The next piece for a process; nothing where none waits.
  std::optional<Piece> take(std::size_t process);

  /// How many pieces wait.
  int waiting() const;

 private:
  void simulate_pieces();
  /// @pre lock_ is held
  std::optional<Piece> next_piece(std::size_t process);
  /// Lets the threads of this process end.
  void end();

  int threads_;
  std::size_t processes_;
  mutable std::mutex lock_;  // of all below
  std::condition_variable has_more_;
  std::deque<Piece> pieces_;
  int blocks_ = 0;  // that are being run
  bool is_over_ = false;
  std::vector<std::jthread> here_;
};

}  // namespace nlcwfs
