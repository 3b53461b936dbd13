// What goes to standard error while a command runs.
#include "studies/run/log.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <mutex>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// The logger whose messages are the line of progress.
constexpr const char* progress_name = "progress";
/// Returns to the start of the line and erases it (ECMA-48).
constexpr std::string_view erase_line = "\r\x1b[K";

/// Of each LogLevel.
constexpr std::array spdlog_levels{spdlog::level::err, spdlog::level::warn, spdlog::level::info,
                                   spdlog::level::debug};

/// A terminal may have been made narrower since the last line.
std::size_t terminal_columns() {
  winsize size{};
  constexpr std::size_t usual = 80;
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

class StandardErrorSink final : public spdlog::sinks::base_sink<std::mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const bool is_progress =
        std::string_view(message.logger_name.data(), message.logger_name.size()) == progress_name;
    if (is_progress) {
      progress_.assign(message.payload.data(), message.payload.size());
      if (is_terminal_) return show_progress();
      if (progress_.empty() || Clock::now() < next_progress_) return;
      next_progress_ = Clock::now() + progress_interval;
    }
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    // One piece, or another's output may come between.
    fmt::print(stderr, "{}{}", is_terminal_ ? erase_line : "",
               std::string_view(line.data(), line.size()));
    if (is_terminal_) show_progress();
  }

  void flush_() override { std::fflush(stderr); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds progress_interval{60};

  void show_progress() const {
    // In the last column a terminal may already begin the next line.
    fmt::print(stderr, "{}{}", erase_line,
               std::string_view(progress_).substr(0, terminal_columns() - 1));
    std::fflush(stderr);
  }

  bool is_terminal_ = isatty(STDERR_FILENO) == 1;
  std::string progress_;
  Clock::time_point next_progress_ = Clock::now() + progress_interval;
};

}  // namespace

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest number that is free is its own; the wrong way, so that its use still fails.
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

void print_error(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void start_log(LogLevel level) {
  const auto sink = std::make_shared<StandardErrorSink>();
  sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %v");
  const auto progress = std::make_shared<spdlog::logger>(progress_name, sink);
  spdlog::register_logger(progress);
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("nlcwfs", sink));
  spdlog::set_level(spdlog_levels.at(static_cast<std::size_t>(level)));
}

void show_progress_line(std::string_view text) {
  // A part of the program that is tested by itself has no log.
  if (const auto progress = spdlog::get(progress_name)) progress->info(text);
}

}  // namespace nlcwfs
