// Tests: Texts are trimmed, wrapped, shown in one line, and held against known words.
#include "studies/settings/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(Text, TrimmedTakesSpacesFromBothEndsOnly) {
  EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Text, OneLineIsOneLineWhateverComes) {
  EXPECT_EQ(one_line("a\nb\r\x1b[0m\x7f"), "a?b??[0m?");
  EXPECT_EQ(one_line("\xC3\xA9"), "\xC3\xA9");
  EXPECT_EQ(one_line(""), "(nothing)");
  EXPECT_EQ(one_line(std::string(200, 'x')), std::string(200, 'x'));
  EXPECT_EQ(one_line(std::string(100000, 'x')), std::string(200, 'x') + "...");
}

TEST(Text, WithoutControlsKeepsTheWholeMessage) {
  EXPECT_EQ(without_controls("a\tb\n" + std::string(100000, 'x')),
            "a?b?" + std::string(100000, 'x'));
}

TEST(Text, NearestWordFindsTheFewestWrongLetters) {
  const std::vector<std::string> commands{"evaluate", "screens", "scale", "optimize"};
  EXPECT_EQ(nearest_word("evalute", commands), "evaluate");
  EXPECT_EQ(nearest_word("optimise", commands), "optimize");
  EXPECT_EQ(nearest_word("scren", commands), "screens");
  for (const std::string& command : commands) EXPECT_EQ(nearest_word(command, commands), command);
}

TEST(Text, NoWordIsNearestWhereMoreThanAThirdIsWrong) {
  const std::vector<std::string> words{"response", "sweep", "loops", "source.bands"};
  for (const char* word : {"design", "bogus", "foo"}) EXPECT_EQ(nearest_word(word, words), "");
  EXPECT_EQ(suggestion("foo", words, "; ask"), "; ask");
  EXPECT_EQ(suggestion("bans", words, "; ask", "--"), "; did you mean --source.bands?");
}

TEST(Text, NearestWordKnowsSectionsAndAbbreviations) {
  const std::vector<std::string> keys{"help",          "telescope.diameter", "seeing.d_over_r0",
                                      "seeing.fwhm",   "screens.seed",       "search.seed",
                                      "sensor.planes", "scale.diameter",     "search.z1"};
  EXPECT_EQ(nearest_word("diameter", keys), "telescope.diameter");
  EXPECT_EQ(nearest_word("diametr", keys), "telescope.diameter");
  EXPECT_EQ(nearest_word("scale.diametr", keys), "scale.diameter");
  EXPECT_EQ(nearest_word("search.sed", keys), "search.seed");
  EXPECT_EQ(nearest_word("telescope.seed", keys), "screens.seed");
  EXPECT_EQ(nearest_word("telescope.diam", keys), "telescope.diameter");
  EXPECT_EQ(nearest_word("telescopes.fwhm", keys), "seeing.fwhm");
  EXPECT_EQ(nearest_word("r0", keys), "seeing.d_over_r0");
  EXPECT_EQ(nearest_word("h", keys), "help");
  EXPECT_EQ(nearest_word("plane", keys), "sensor.planes");
}

TEST(Text, WrappedBreaksBetweenWordsAndLongWordsWhereItMust) {
  using testing::ElementsAre;
  EXPECT_THAT(wrapped("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("one two three", 8), ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("abcdefgh ij", 5), ElementsAre("abcde", "fgh", "ij"));
  EXPECT_THAT(wrapped("one,two,three", 9), ElementsAre("one,two,", "three"));
  EXPECT_THAT(wrapped("", 5), ElementsAre(""));
}

}  // namespace
}  // namespace nlcwfs
