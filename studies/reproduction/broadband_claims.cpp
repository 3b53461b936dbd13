#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"
#include "studies/reproduction/claim_rules.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/statistics/bivariate_statistics.hpp>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

const Json& residuals_of(const SetupRuns& runs, std::string_view band) {
  return runs.summary("figure-8", std::string(band)).at("residual_after_loops_nm");
}

/// The residual after the last loop, nm, of each wavefront.
std::vector<double> floors(const SetupRuns& runs, std::string_view band) {
  return numbers_from_json(residuals_of(runs, band).at("screens").back());
}

std::vector<double> loops(const SetupRuns& runs, std::string_view band) {
  return runs.screens("figure-8", std::string(band), "loops");
}

ClaimFinding reaches_a_floor(const SetupRuns& runs) {
  const std::vector<double> means = numbers_from_json(residuals_of(runs, "medium").at("mean"));
  const auto reached =
      std::ranges::find_if(means, [&](double value) { return value < 1.1 * means.back(); });
  const auto loops = static_cast<int>(reached - means.begin()) + 1;
  return {fmt::format("within a tenth of its last value after {} loops", loops),
          verdict_of(loops >= 5 && loops <= 9, loops >= 3 && loops <= 14)};
}

ClaimFinding each_reaches_a_floor(const SetupRuns& runs) {
  const Json& screens = residuals_of(runs, "medium").at("screens");
  const std::size_t half = (screens.size() + 1) / 2;
  const std::vector<double> middle = numbers_from_json(screens.at(half - 1));
  const std::vector<double> last = numbers_from_json(screens.back());
  std::size_t settled = 0;
  for (std::size_t screen = 0; screen < last.size(); ++screen) {
    if (std::abs(last[screen] / middle[screen] - 1.0) < 0.1) ++settled;
  }
  return {fmt::format("{} of {} change by less than a tenth from loop {} to loop {}", settled,
                      last.size(), half, screens.size()),
          verdict_of(settled == last.size(), 4 * settled >= 3 * last.size())};
}

ClaimFinding starts_with_strength(const SetupRuns& runs) {
  const Json& screens = residuals_of(runs, "medium").at("screens");
  const double correlation = boost::math::statistics::correlation_coefficient(
      numbers_from_json(runs.summary("figure-8", "medium").at("aberrations_nm")),
      numbers_from_json(screens.front()));
  return {fmt::format("correlation {:.2f} of the residual after one loop with the aberration's RMS",
                      correlation),
          verdict_of(correlation > 0.5, correlation > 0.0)};
}

using OfScreens = std::vector<double> (*)(const SetupRuns& runs, std::string_view band);

std::string bands_text(const SetupRuns& runs, OfScreens values, const char* unit) {
  std::vector<std::string> texts;
  for (const PaperBand& band : paper_bands) {
    texts.push_back(fmt::format("{} {}", band.name,
                                with_error(mean_and_standard_error(values(runs, band.name)))));
  }
  return fmt::format("{} {}", fmt::join(texts, ", "), unit);
}

/// By how much the second band is above the first, wavefront by wavefront.
MeanAndError rise(const SetupRuns& runs, OfScreens values, std::string_view from,
                  std::string_view to) {
  std::vector<double> differences = values(runs, to);
  const std::vector<double> others = values(runs, from);
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] -= others.at(i);
  return mean_and_standard_error(differences);
}

/// Whether every step to a wider band is clearly one up.
bool rises(const SetupRuns& runs, OfScreens values) {
  for (std::size_t i = 1; i < paper_bands.size(); ++i) {
    if (!is_clearly_positive(rise(runs, values, paper_bands[i - 1].name, paper_bands[i].name))) {
      return false;
    }
  }
  return true;
}

bool rises_in_all(const SetupRuns& runs, OfScreens values) {
  return is_clearly_positive(rise(runs, values, "monochromatic", "wide"));
}

ClaimFinding floor_grows(const SetupRuns& runs) {
  return {bands_text(runs, floors, "nm"),
          verdict_of(rises(runs, floors), rises_in_all(runs, floors))};
}

ClaimFinding converges_later(const SetupRuns& runs) {
  return {bands_text(runs, loops, "loops"),
          verdict_of(rises(runs, loops), rises_in_all(runs, loops))};
}

ClaimFinding floor_is_low(const SetupRuns& runs) {
  const MeanAndError floor = mean_and_standard_error(floors(runs, "wide"));
  return {fmt::format("{} nm", with_error(floor)),
          verdict_of(floor.mean < 50.0, floor.mean < 100.0)};
}

}  // namespace

std::vector<ClaimRule> broadband_claims() {
  constexpr std::string_view band_why =
      "a band's images are no single wavelength's: the loop cannot explain them beyond a floor";
  return {
      {"7", "In the medium band the residual reaches its floor.", "after 6 to 8 loops",
       "the mean is within a tenth of its last value after 5 to 9 loops; trend: 3 to 14",
       reaches_a_floor, band_why, band_why},
      {"7", "Every aberration reaches a floor that more loops do not lower.", "all 16",
       "all change by less than a tenth in the second half of the loops; trend: three quarters "
       "of them",
       each_reaches_a_floor, band_why, band_why},
      {"7", "The residual starts where the strength of the aberration puts it.", "depends on it",
       "a correlation above 0.5 of the residual after one loop with the RMS; trend: above 0",
       starts_with_strength, "a stronger aberration is further from the flat start",
       "a stronger aberration is further from the flat start"},
      {"8", "The floor rises with the bandwidth.", "rises",
       "by two standard errors from each band to the next, wavefront by wavefront; trend: from "
       "one wavelength to the widest band",
       floor_grows,
       "one wavelength on the reconstruction's own grid has no floor at all; bands have one",
       "the same path at every wavelength is another phase at each, and the more so in a wide "
       "band"},
      {"8", "Wider bands converge later.", "later", "as above", converges_later,
       "rms_change hardly sees the floor",
       "at the floor the phase still changes by more than 1 nm a loop, up to the last of 20"},
      {"8", "The floor of the widest band stays low.", "below 50 nm",
       "below 50 nm; trend: below 100 nm", floor_is_low,
       "the same phase at every wavelength is what makes it low",
       "the same path at every wavelength, as air gives it, costs several times as much"}};
}

}  // namespace nlcwfs
