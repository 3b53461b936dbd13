// A program that was built without MPI.
#include "studies/ranks.hpp"

#include <tbb/task_arena.h>

namespace nlcwfs {

Ranks::Ranks() : cores_{tbb::this_task_arena::max_concurrency()} {}

Ranks::~Ranks() = default;

void Ranks::serve() {}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): with MPI it is none
std::shared_ptr<TrialRunner> Ranks::runner(int /*threads*/) const { return nullptr; }

}  // namespace nlcwfs
