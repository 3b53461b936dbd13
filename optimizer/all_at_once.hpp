#pragma once

#include <atomic>
#include <cstddef>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace nlcwfs {

/// body(0), ..., body(count - 1) in parallel, begun in this order. Where the program is allowed
/// more threads than there are cores, as many at once: what waits for other machines needs none.
template <class Body>
void all_at_once(std::size_t count, const Body& body) {
  const auto allowed = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  tbb::task_arena arena(allowed > tbb::info::default_concurrency()
                            ? allowed
                            : tbb::this_task_arena::max_concurrency());
  std::atomic<std::size_t> next = 0;
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t) { body(next++); }, tbb::simple_partitioner());
  });
}

}  // namespace nlcwfs
