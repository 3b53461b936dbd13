#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/claim_rules.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// S_F against the sampling at one D/r0, from fine to coarse.
struct Sampling {
  std::vector<double> pixels;  ///< across the pupil
  std::vector<double> strehl;
  std::vector<double> errors;
  std::vector<double> seconds;
  int ratio;

  Sampling(const SetupRuns& runs, int d_over_r0) : ratio(d_over_r0) {
    const Json& grid = runs.summary("figure-6", fmt::format("{}", ratio)).at("grid");
    for (const Json& axis : grid.at("axes")) {
      if (axis.at("name") == "pupil_pixels") pixels = numbers_from_json(axis.at("values"));
    }
    strehl = numbers_from_json(grid.at("field_strehl"));
    errors = numbers_from_json(grid.at("standard_error").at("field_strehl"));
    seconds = numbers_from_json(grid.at("seconds"));
  }

  /// The pixels per r0 below which S_F stays below 0.8, between the samplings in their logarithm;
  /// 0 where it never does, infinity where it always does.
  double threshold() const {
    const auto coarse = std::ranges::find_if(strehl, [](double value) { return value < 0.8; });
    if (coarse == strehl.end()) return 0.0;
    if (coarse == strehl.begin()) return HUGE_VAL;
    const auto i = static_cast<std::size_t>(coarse - strehl.begin());
    const double share = (strehl[i - 1] - 0.8) / (strehl[i - 1] - strehl[i]);
    return std::exp(std::lerp(std::log(pixels[i - 1]), std::log(pixels[i]), share)) / ratio;
  }

  /// S_F at so many pixels per r0, between the samplings in their logarithm.
  MeanAndError at(double pixels_per_r0) const {
    const double wanted = pixels_per_r0 * ratio;
    for (std::size_t i = 0; i + 1 < pixels.size(); ++i) {
      if (pixels[i] < wanted || pixels[i + 1] > wanted) continue;
      const double share = std::log(pixels[i] / wanted) / std::log(pixels[i] / pixels[i + 1]);
      return {std::lerp(strehl[i], strehl[i + 1], share),
              std::lerp(errors[i], errors[i + 1], share)};
    }
    return {std::nan(""), 0.0};
  }
};

bool all_ratios(const std::function<bool(int)>& condition) {
  return std::ranges::all_of(sampling_ratios, condition);
}

ClaimFinding threshold_of_sampling(const SetupRuns& runs) {
  const auto threshold = [&](int ratio) { return Sampling(runs, ratio).threshold(); };
  const auto within = [&](double least, double most) {
    return all_ratios(
        [&](int ratio) { return threshold(ratio) >= least && threshold(ratio) <= most; });
  };
  return {for_each_ratio(sampling_ratios,
                         [&](int ratio) {
                           const double found = threshold(ratio);
                           return found == 0.0 ? fmt::format("below {:.2g}", 8.0 / ratio)
                                               : fmt::format("{:.2g}", found);
                         }) +
              " pixels per r0",
          verdict_of(within(3.5, 5.5), within(2.0, 8.0))};
}

ClaimFinding sampling_suffices(const SetupRuns& runs) {
  const auto at_five = [&](int ratio) { return Sampling(runs, ratio).at(5.0); };
  return {for_each_ratio(sampling_ratios,
                         [&](int ratio) { return "S_F = " + with_error(at_five(ratio)); }),
          verdict_of(all_ratios([&](int ratio) {
                       const MeanAndError found = at_five(ratio);
                       return found.mean + 2.0 * found.standard_error >= 0.8 && found.mean >= 0.75;
                     }),
                     all_ratios([&](int ratio) { return at_five(ratio).mean >= 0.65; }))};
}

ClaimFinding more_pixels_take_longer(const SetupRuns& runs) {
  return {"8 to 128 pixels across the pupil, " +
              for_each_ratio(sampling_ratios,
                             [&](int ratio) {
                               const Sampling sampling(runs, ratio);
                               return fmt::format("{:.3g} to {:.3g} ms",
                                                  1e3 * sampling.seconds.back(),
                                                  1e3 * sampling.seconds.front());
                             }),
          verdict_of(all_ratios([&](int ratio) {
                       return std::ranges::is_sorted(Sampling(runs, ratio).seconds, std::greater());
                     }),
                     all_ratios([&](int ratio) {
                       const Sampling sampling(runs, ratio);
                       return sampling.seconds.front() > sampling.seconds.back();
                     }))};
}

}  // namespace

std::vector<ClaimRule> sampling_claims() {
  return {{"6", "Fewer than 4 to 5 pixels per r0 are too few.", "S_F = 0.8 at 4 to 5",
           "S_F falls below 0.8 between 3.5 and 5.5 pixels per r0 for each D/r0; trend: 2 to 8",
           threshold_of_sampling,
           "the threshold grows with D/r0: it is no number of pixels per r0 alone",
           "at D/r0 = 10 some wavefronts do not converge at any sampling"},
          {"6", "4 to 5 pixels per r0 are enough.", "S_F about 0.8",
           "S_F at 5 pixels per r0 is 0.8 within two standard errors, and above 0.75, for each "
           "D/r0; trend: above 0.65",
           sampling_suffices, "they are, up to D/r0 = 8 with room",
           "they are up to D/r0 = 8; at 10 some wavefronts do not converge at any sampling"},
          {"6", "More pixels take longer.", "longer",
           "at each doubling for each D/r0; trend: 128 longer than 8", more_pixels_take_longer,
           "a loop's time grows with the pixels; too few of them take more loops",
           "a loop's time grows with the pixels; too few of them take more loops"}};
}

}  // namespace nlcwfs
