// The words of the physics' choices, as configurations and summaries have them.
#pragma once

#include "model/light_source.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/sensor_design.hpp"
#include "model/simulation.hpp"
#include "model/true_light.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nlcwfs {

/// A value with its word.
template <class Enum>
using Word = std::pair<std::string_view, Enum>;

/// The words of an enum, in the order in which the user is told of them; specialised for each.
template <class Enum>
inline constexpr std::array<Word<Enum>, 0> word_table{};

/// Those of StoppingRule.
template <>
inline constexpr auto word_table<StoppingRule> = std::to_array<Word<StoppingRule>>(
    {{"difference", StoppingRule::difference}, {"rms_change", StoppingRule::rms_change}});
/// Those of InitialGuess.
template <>
inline constexpr auto word_table<InitialGuess> = std::to_array<Word<InitialGuess>>(
    {{"flat", InitialGuess::flat}, {"centroid", InitialGuess::centroid}});
/// Those of OutsideDetector.
template <>
inline constexpr auto word_table<OutsideDetector> = std::to_array<Word<OutsideDetector>>(
    {{"free", OutsideDetector::free}, {"zero", OutsideDetector::zero}});
/// Those of UnwrappingMethod.
template <>
inline constexpr auto word_table<UnwrappingMethod> =
    std::to_array<Word<UnwrappingMethod>>({{"quality_guided", UnwrappingMethod::quality_guided},
                                           {"least_squares", UnwrappingMethod::least_squares}});
/// Those of TruthModel.
template <>
inline constexpr auto word_table<TruthModel> =
    std::to_array<Word<TruthModel>>({{"extended", TruthModel::extended},
                                     {"matched", TruthModel::matched},
                                     {"periodic", TruthModel::periodic}});
/// Those of Precision.
template <>
inline constexpr auto word_table<Precision> = std::to_array<Word<Precision>>(
    {{"double", Precision::double_precision}, {"single", Precision::single_precision}});
/// Those of ChromaticAberration.
template <>
inline constexpr auto word_table<ChromaticAberration> = std::to_array<Word<ChromaticAberration>>(
    {{"path", ChromaticAberration::path}, {"phase", ChromaticAberration::phase}});

/// @pre the enum has a word for the value
template <class Enum>
constexpr std::string_view word_of(Enum value) {
  return std::ranges::find(word_table<Enum>, value, &Word<Enum>::second)->first;
}

/// Nothing where it is none of the enum's words.
template <class Enum>
constexpr std::optional<Enum> value_of_word(std::string_view word) {
  const auto found = std::ranges::find(word_table<Enum>, word, &Word<Enum>::first);
  if (found == word_table<Enum>.end()) return std::nullopt;
  return found->second;
}

/// The words alone.
template <class Enum>
std::vector<std::string> word_list() {
  std::vector<std::string> list;
  for (const auto& [word, value] : word_table<Enum>) list.emplace_back(word);
  return list;
}

}  // namespace nlcwfs
