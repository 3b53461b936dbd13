#include "studies/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace nlcwfs {
namespace {

/// A signal handler has nothing else to tell of a signal with.
std::atomic<bool> noted = false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler may not touch it");

extern "C" void note_interrupt(int signal) {
  if (!noted.exchange(true)) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

InterruptWatch::InterruptWatch()
    : previous_interrupt_(std::signal(SIGINT, note_interrupt)),
      previous_terminate_(std::signal(SIGTERM, note_interrupt)) {}

InterruptWatch::~InterruptWatch() {
  std::signal(SIGINT, previous_interrupt_);
  std::signal(SIGTERM, previous_terminate_);
  noted = false;
}

bool InterruptWatch::interrupted() { return noted; }

}  // namespace nlcwfs
