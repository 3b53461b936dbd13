// A program that was built without MPI.
#include "studies/ranks/launched_processes.hpp"
#include "studies/ranks/ranks.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace nlcwfs {

Ranks::Ranks() : cores_{tbb::this_task_arena::max_concurrency()} {
  // Each would run the whole command, and all into one archive.
  if (const int processes = launched_processes(); processes > 1) {
    throw std::runtime_error(
        fmt::format("{} processes were started together, but the program was built without MPI: "
                    "install one and build again, or start one process",
                    processes));
  }
}

Ranks::~Ranks() = default;

void Ranks::serve() {}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): with MPI it is none
std::shared_ptr<TrialRunner> Ranks::runner(int /*threads*/) const { return nullptr; }

}  // namespace nlcwfs
