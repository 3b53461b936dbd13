// Tests: the words of the physics' choices, as configurations and summaries have them.
#include "model/words.hpp"

#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

template <class Enum>
class Words : public testing::Test {};

using Enums = testing::Types<StoppingRule, InitialGuess, OutsideDetector, UnwrappingMethod,
                             TruthModel, Precision, ChromaticAberration>;
TYPED_TEST_SUITE(Words, Enums);

TYPED_TEST(Words, AreOneForEachValue) {
  std::set<std::string_view> words;
  for (const auto& [word, value] : word_table<TypeParam>) {
    EXPECT_EQ(word_of(value), word);
    EXPECT_EQ(value_of_word<TypeParam>(word), value);
    words.insert(word);
  }
  EXPECT_EQ(words.size(), word_table<TypeParam>.size());
  EXPECT_THAT(word_list<TypeParam>(), testing::UnorderedElementsAreArray(words));
  EXPECT_EQ(value_of_word<TypeParam>("nonsense"), std::nullopt);
  EXPECT_EQ(value_of_word<TypeParam>(""), std::nullopt);
}

TEST(WordsOfThePhysics, AreThoseOfTheContract) {
  EXPECT_EQ(word_of(StoppingRule::rms_change), "rms_change");
  EXPECT_EQ(word_of(Precision::single_precision), "single");
  EXPECT_EQ(word_of(TruthModel::periodic), "periodic");
}

}  // namespace
}  // namespace nlcwfs
