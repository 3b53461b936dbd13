// What goes to standard error while a command runs.
#pragma once

#include <string_view>

namespace nlcwfs {

/// What goes to standard error while a command runs; each has what stands before it too.
enum class LogLevel {
  error,    ///< why the command ends without its result
  warning,  ///< that it was interrupted
  info,     ///< how far it is
  debug     ///< each stage and evaluation when it is done, with time, cost and duration
};

/// Holds the numbers of the standard streams that the program was begun without: a file that it
/// opens would get them, and what is printed would go into it.
void occupy_standard_streams();

/// Writes to standard error. Where that cannot be written to, nobody can be told.
void print_error(std::string_view text) noexcept;

/// Sends what is logged with spdlog to standard error, with the time, and there the line of
/// progress: on a terminal it is written over and over and moves out of the way of other lines;
/// elsewhere one a minute is written. Call it once, before anything is logged.
void start_log(LogLevel level);

/// Replaces the line of progress; an empty text removes it. May be called from several threads.
void show_progress_line(std::string_view text);

}  // namespace nlcwfs
