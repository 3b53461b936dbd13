// Ctrl-C is noted, so that work can come to a clean end.
#include "studies/run/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <spdlog/spdlog.h>
#include <string_view>
#include <unistd.h>

namespace nlcwfs {
namespace {

// A signal handler has nothing else to tell of a signal with.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<bool> is_watched = false;
std::atomic<bool> noted = false;
std::atomic<bool> is_terminal = false;
std::atomic<bool> is_told = false;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler may not touch it");

/// What a signal handler may do to write; the line of progress that stands there is erased.
void write_line(std::string_view text) {
  constexpr std::string_view erase_line = "\r\x1b[K";
  // Nothing can be done where it fails.
  [[maybe_unused]] ssize_t written = 0;
  if (is_terminal) written = ::write(STDERR_FILENO, erase_line.data(), erase_line.size());
  written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void note_interrupt(int signal) {
  if (!noted.exchange(true)) {
    if (is_told) {
      write_line("nlcwfs: ending with what is done so far; interrupt again to end at once\n");
    }
    return;
  }
  if (is_terminal) write_line({});
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

InterruptWatch::InterruptWatch() : is_outermost_(!is_watched.exchange(true)) {
  if (!is_outermost_) return;
  is_terminal = isatty(STDERR_FILENO) == 1;
  is_told = spdlog::default_logger()->should_log(spdlog::level::warn);
  previous_interrupt_ = std::signal(SIGINT, note_interrupt);
  previous_terminate_ = std::signal(SIGTERM, note_interrupt);
}

InterruptWatch::~InterruptWatch() {
  if (!is_outermost_) return;
  std::signal(SIGINT, previous_interrupt_);
  std::signal(SIGTERM, previous_terminate_);
  noted = false;
  is_watched = false;
}

bool InterruptWatch::interrupted() { return noted; }

}  // namespace nlcwfs
