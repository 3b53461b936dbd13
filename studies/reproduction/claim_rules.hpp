// How a claim is checked, and what the figures' rules share.
#pragma once

#include "studies/reproduction/claim.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

/// A claim with how it is checked. Rules were written down before the numbers were known, except
/// where a definition had to be mended because noise decided it.
struct ClaimRule {
  std::string_view sentence;  ///< in our words
  std::string_view papers;    ///< its number
  std::string_view rule;      ///< what counts as reproduced, and what as its trend
  ClaimFinding (*find)(const SetupRuns& runs) = nullptr;  ///< checks it in one set-up
  std::string_view why;                                   ///< what decides the outcome
  std::string_view extended_why = why;                    ///< the same with the extended truth
};

/// The Talbot distance of r0 at the paper's telescope, m.
double talbot_distance_of_seeing(double d_over_r0);

/// What two findings of a rule come to.
ClaimVerdict verdict_of(bool reproduced, bool in_trend);

/// Two standard errors above zero.
bool is_clearly_positive(const MeanAndError& difference);

/// The designs that the paper recommends: Z_near within a factor 1.5 of the Talbot distance of r0,
/// Z_far from 150 km on.
PlaneMap::Condition recommended(double d_over_r0);

/// A metric of the designs of four planes that the paper recommends, at D/r0 = 4.
std::vector<double> of_four_planes(const SetupRuns& runs, const char* metric);
/// @param name  "without-p3" or "without-p1"
std::vector<double> of_three_planes(const SetupRuns& runs, const char* name, const char* metric);

/// "4.8 (4.4 to 5.4)": median, and what eight tenths of the values are within; "none" of no values.
std::string median_text(const std::vector<double>& values);

/// What is found at each of several D/r0, a tuple of numbers and texts.
template <class Found>
class FoundAtRatios {
 public:
  /// Looks at each of them.
  FoundAtRatios(std::span<const int> ratios, const std::function<Found(int ratio)>& find) {
    for (const int ratio : ratios) all_.emplace_back(ratio, find(ratio));
  }

  /// "D/r0 = 4: ...; 6: ...".
  /// @param format  of what is found at one of them
  std::string text(std::string_view format) const {
    std::vector<std::string> texts;
    for (const auto& [ratio, found] : all_) {
      const auto fill = [&](const auto&... one) {
        return fmt::format(fmt::runtime(format), one...);
      };
      texts.push_back(fmt::format("{}: {}", ratio, std::apply(fill, found)));
    }
    return fmt::format("D/r0 = {}", fmt::join(texts, "; "));
  }

  /// Whether a condition on what is found holds at all of them.
  template <class Condition>
  bool fulfil(const Condition& condition) const {
    return std::ranges::all_of(all_,
                               [&](const auto& one) { return std::apply(condition, one.second); });
  }

 private:
  std::vector<std::pair<int, Found>> all_;
};
/// What was found is of the type that finding it returns.
template <class Ratios, class Find>
FoundAtRatios(const Ratios&, const Find&) -> FoundAtRatios<std::invoke_result_t<Find, int>>;

}  // namespace nlcwfs
