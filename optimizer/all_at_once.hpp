// Bodies are run in parallel, all of them even where one fails.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace nlcwfs {

/// body(0), ..., body(count - 1) in parallel, begun in this order. Where the program is allowed
/// more threads than there are cores, as many at once: what waits for other machines needs none.
/// @throws what a body throws first; no other is begun then, and those that were are finished
template <class Body>
void all_at_once(std::size_t count, const Body& body) {
  const auto allowed = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  tbb::task_arena arena(allowed > tbb::info::default_concurrency()
                            ? allowed
                            : tbb::this_task_arena::max_concurrency());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> has_failed = false;
  std::exception_ptr why;
  // Through an exception oneTBB would leave out the parallel loops inside the other bodies, whose
  // results would lack what those were to fill.
  const auto try_next = [&](std::size_t) {
    if (has_failed) return;
    try {
      body(next++);
    } catch (...) {
      if (!has_failed.exchange(true)) why = std::current_exception();
    }
  };
  arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, count, try_next, tbb::simple_partitioner()); });
  if (why) std::rethrow_exception(why);
}

}  // namespace nlcwfs
