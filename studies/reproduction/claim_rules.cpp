// How a claim is checked, and what the figures' rules share.
#include "studies/reproduction/claim_rules.hpp"

#include "model/telescope.hpp"

#include <cmath>

namespace nlcwfs {

double talbot_distance_of_seeing(double d_over_r0) {
  const Telescope papers;  // is the default
  return talbot_distance(papers.diameter / d_over_r0, papers.wavelength);
}

ClaimVerdict verdict_of(bool reproduced, bool in_trend) {
  if (reproduced) return ClaimVerdict::reproduced;
  return in_trend ? ClaimVerdict::in_trend : ClaimVerdict::not_reproduced;
}

bool is_clearly_positive(const MeanAndError& difference) {
  return difference.mean > 2.0 * difference.standard_error;
}

PlaneMap::Condition recommended(double d_over_r0) {
  const double talbot = talbot_distance_of_seeing(d_over_r0);
  return [talbot](double near, double far) {
    return near > talbot / 1.5 && near < talbot * 1.5 && far >= 150 * km;
  };
}

std::vector<double> of_four_planes(const SetupRuns& runs, const char* metric) {
  return runs.map(4).values_of(metric, recommended(4));
}

std::vector<double> of_three_planes(const SetupRuns& runs, const char* name, const char* metric) {
  return runs.three_plane_map(name).values_of(metric, recommended(4));
}

std::string median_text(const std::vector<double>& values) {
  if (values.empty()) return "none";
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", quantile(values, 0.5), quantile(values, 0.1),
                     quantile(values, 0.9));
}

}  // namespace nlcwfs
