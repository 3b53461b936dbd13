#pragma once

#include "model/telescope.hpp"
#include "studies/reproduction/paper_claims.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {

/// A claim with how it is checked. Rules were written down before the numbers were known, except
/// where a definition had to be mended because noise decided it.
struct ClaimRule {
  std::string_view figure;    ///< of reproduced_figures, whose runs it is checked on
  std::string_view sentence;  ///< in our words
  std::string_view papers;    ///< its number
  std::string_view rule;      ///< what counts as reproduced, and what as its trend
  ClaimFinding (*find)(const SetupRuns& runs);  ///< checks it in one set-up
  /// What decides the outcome, in either set-up.
  std::string_view papers_why;
  std::string_view extended_why;  ///< with the extended truth
};

// By the part of the paper.
std::vector<ClaimRule> distance_claims();     ///< figure 3 and the scaling
std::vector<ClaimRule> plane_count_claims();  ///< figures 4 and 5
std::vector<ClaimRule> sampling_claims();     ///< figure 6
std::vector<ClaimRule> broadband_claims();    ///< figures 7 and 8

/// A kilometre, m.
inline constexpr double km = 1e3;
/// That of the paper's simulations.
inline constexpr Telescope papers_telescope{.diameter = 0.5, .wavelength = 532e-9};

/// m
inline double talbot_distance_of_seeing(double d_over_r0) {
  return talbot_distance(papers_telescope.diameter / d_over_r0, papers_telescope.wavelength);
}

/// What two findings of a rule come to.
inline ClaimVerdict verdict_of(bool reproduced, bool in_trend) {
  if (reproduced) return ClaimVerdict::reproduced;
  return in_trend ? ClaimVerdict::in_trend : ClaimVerdict::not_reproduced;
}

/// Two standard errors above zero.
inline bool is_clearly_positive(const MeanAndError& difference) {
  return difference.mean > 2.0 * difference.standard_error;
}

/// The designs that the paper recommends: Z_near within a factor 1.5 of the Talbot distance of r0,
/// Z_far from 150 km on.
PlaneMap::Condition recommended(double d_over_r0);

/// "4.8 (4.4 to 5.4)": median, and what eight tenths of the values are within; "none" of no values.
std::string median_text(const std::vector<double>& values);

/// One text for each D/r0: "D/r0 = 4: ...; 6: ...".
template <class Ratios, class Text>
std::string for_each_ratio(const Ratios& ratios, const Text& text) {
  std::vector<std::string> texts;
  for (const int ratio : ratios) texts.push_back(fmt::format("{}: {}", ratio, text(ratio)));
  return fmt::format("D/r0 = {}", fmt::join(texts, "; "));
}

}  // namespace nlcwfs
