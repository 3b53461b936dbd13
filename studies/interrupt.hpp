#pragma once

namespace nlcwfs {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM is only noted, so that work can come to a
/// clean end; the second ends the program at once. One at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Whether the one that lives has noted the first.
  static bool interrupted();

 private:
  void (*previous_interrupt_)(int);
  void (*previous_terminate_)(int);
};

}  // namespace nlcwfs
