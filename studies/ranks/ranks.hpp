// The processes that simulate for one run.
#pragma once

#include "objectives/trial_runner.hpp"

#include <memory>
#include <vector>

namespace nlcwfs {

/// The processes that mpirun or srun has started together. Rank 0 alone runs the command; the
/// others simulate screens for it. There is one rank where the program was started without them or
/// built without MPI.
class Ranks {
 public:
  /// Of a program, once, before all else. Ranks other than 0 leave it to rank 0 to heed Ctrl-C
  /// (SIGINT) and SIGTERM.
  Ranks();
  /// Lets the other ranks end.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// The number of this process, from 0.
  int rank() const { return rank_; }
  /// How many there are.
  int count() const { return static_cast<int>(cores_.size()); }
  /// A rank's share of the cores of its machine.
  int cores() const { return cores_[static_cast<std::size_t>(rank_)]; }

  /// Simulates for rank 0 until that lets it end. Where it cannot, it ends all ranks.
  /// @pre rank() > 0
  void serve();

  /// Simulates on all ranks; null where there is one. It must end before the ranks.
  /// @param threads  of each rank; 0 = its cores
  /// @pre rank() == 0
  std::shared_ptr<TrialRunner> runner(int threads) const;

 private:
  int rank_ = 0;
  std::vector<int> cores_;  // of each rank
};

}  // namespace nlcwfs
