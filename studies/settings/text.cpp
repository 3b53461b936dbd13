// Texts are trimmed, wrapped, shown in one line, and held against known words.
#include "studies/settings/text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Levenshtein distance: the fewest insertions, deletions and replacements of characters.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// The edit distance, except that an abbreviation is near the word whose start or end it is.
std::size_t distance(std::string_view typed, std::string_view meant) {
  const std::size_t edits = edit_distance(typed, meant);
  const bool abbreviates = !typed.empty() && (meant.starts_with(typed) || meant.ends_with(typed));
  return abbreviates ? std::min(edits, std::size_t{1}) : edits;
}

std::string_view last_part(std::string_view word) { return word.substr(word.rfind('.') + 1); }

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view spaces = " \t\r\n";
  const auto first = text.find_first_not_of(spaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

bool is_control(char character) {
  const auto code = static_cast<unsigned char>(character);
  return code < 0x20 || code == 0x7f;
}

std::string without_controls(std::string_view text) {
  std::string line(text);
  std::ranges::replace_if(line, is_control, '?');
  return line;
}

std::string one_line(std::string_view text) {
  if (text.empty()) return "(nothing)";
  constexpr std::size_t longest = 200;
  const std::string line = without_controls(text.substr(0, longest));
  return text.size() > longest ? line + "..." : line;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  while (text.size() > width) {
    const auto space = text.rfind(' ', width);
    const auto comma = text.rfind(',', width - 1);
    const std::size_t within = comma == std::string_view::npos ? width : comma + 1;
    const std::size_t end = space == std::string_view::npos || space == 0 ? within : space;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
    if (text.starts_with(' ')) text.remove_prefix(1);
  }
  lines.emplace_back(text);
  return lines;
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  assert(!words.empty());
  const bool has_section = word.find('.') != std::string_view::npos;
  const auto compared = [&](std::string_view whole) {
    return has_section ? whole : last_part(whole);
  };
  const auto distance_to = [&](const std::string& candidate) {
    const std::size_t last = distance(last_part(word), last_part(candidate));
    // A section that does not fit counts like a few wrong letters, however long it is.
    constexpr std::size_t wrong_section = 3;
    return has_section ? std::min(distance(word, candidate), last + wrong_section) : last;
  };
  const std::string& nearest = *std::ranges::min_element(words, {}, distance_to);
  const std::size_t longer = std::max(word.size(), compared(nearest).size());
  return 3 * distance_to(nearest) <= longer ? nearest : "";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words,
                       std::string_view otherwise, std::string_view before) {
  const std::string nearest = nearest_word(word, words);
  return nearest.empty() ? std::string(otherwise)
                         : fmt::format("; did you mean {}{}?", before, nearest);
}

}  // namespace nlcwfs
