#pragma once

#include <string>
#include <string_view>

namespace nlcwfs {

/// A line on the terminal that is written over and over; nothing of it in a pipe or a file, or
/// where the user wants quiet. Goes to standard error.
class ProgressLine {
 public:
  /// A quiet one shows nothing.
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Replaces the line.
  void show(std::string_view text);
  /// Removes it, before other text is printed.
  void clear();

 private:
  bool enabled_;
  bool shown_ = false;
};

/// "1 h 05 min", "2 min 10 s", "45 s".
std::string duration_text(double seconds);

}  // namespace nlcwfs
