// Texts are trimmed, wrapped, shown in one line, and held against known words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// The text without the spaces, tabs and line ends around it.
std::string_view trimmed(std::string_view text);

/// Whether a byte is an ASCII control character, such as a tab or a line end.
bool is_control(char character);

/// The text on one line: control characters become '?'.
std::string without_controls(std::string_view text);

/// A value fit for one line of a message: without control characters, a long text is cut, an empty
/// one is "(nothing)".
std::string one_line(std::string_view text);

/// Lines of at most `width` characters, broken between words; a longer word is broken after a
/// comma, or where it must.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// The word that a user most likely meant: the one with the smallest edit distance to `word`; the
/// first among equals. A word without a dot is held against what stands behind the last dot
/// (`diameter` means `telescope.diameter`), and an abbreviation is near what it abbreviates. Empty
/// where more than a third of the longer word is different.
/// @pre words is not empty
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// "; did you mean <before><nearest word>?", or `otherwise` where no word is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& words,
                       std::string_view otherwise, std::string_view before = "");

}  // namespace nlcwfs
