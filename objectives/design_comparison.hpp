// Two designs are told apart, screen by screen.
#pragma once

#include "model/statistics.hpp"
#include "model/words.hpp"
#include "objectives/design_trial.hpp"

#include <cstddef>
#include <span>

namespace nlcwfs {

/// What a comparison of two designs says.
enum class Verdict { better, indistinguishable, worse };

/// Those of Verdict.
template <>
inline constexpr auto word_table<Verdict> =
    std::to_array<Word<Verdict>>({{"better", Verdict::better},
                                  {"indistinguishable", Verdict::indistinguishable},
                                  {"worse", Verdict::worse}});

/// How much cheaper one design is than another on the same screens.
struct Improvement {
  MeanAndError cost = {};  ///< reference - candidate, paired by screen: above 0 is better
  Verdict verdict = Verdict::indistinguishable;  ///< by Student's t test at 5 %, two-sided
};

/// What a mean difference of costs over so many screens says; of one screen, nothing.
/// @param cost  as Improvement has it
Improvement improvement(const MeanAndError& cost, std::size_t screens);

/// Compares figures, of which lower is better, of two designs on the same screens.
Improvement improvement(std::span<const double> candidate, std::span<const double> reference);

/// Compares the costs of two designs that were tried on the same screens.
Improvement improvement(const TriedDesign& candidate, const TriedDesign& reference);

}  // namespace nlcwfs
