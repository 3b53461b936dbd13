// Time is measured.
#pragma once

#include <chrono>

namespace nlcwfs {

/// Runs from when it is made.
class Stopwatch {
 public:
  /// How long ago it was made, s.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace nlcwfs
