// Ctrl-C is noted, so that work can come to a clean end.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace nlcwfs {

/// While one lives, the first Ctrl-C (SIGINT) or SIGTERM is only noted, and said so on standard
/// error, so that work can come to a clean end; the second ends the program at once. Of several,
/// one inside the other, the outermost counts.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Whether the first was noted.
  static bool interrupted();

 private:
  bool is_outermost_;
  void (*previous_interrupt_)(int) = nullptr;
  void (*previous_terminate_)(int) = nullptr;
};

/// Ends a command that was interrupted, after it has written what it has.
class RunInterrupted : public std::exception {
 public:
  /// @param what  for people: how to go on; nothing where the results say it
  explicit RunInterrupted(std::string what = {}) : what_(std::move(what)) {}
  /// What it was made with.
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

}  // namespace nlcwfs
