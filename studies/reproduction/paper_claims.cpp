#include "studies/reproduction/paper_claims.hpp"

#include "studies/reproduction/claim_rules.hpp"

#include <algorithm>

namespace nlcwfs {

std::string_view to_string(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::reproduced:
      return "reproduced";
    case ClaimVerdict::in_trend:
      return "reproduced in trend";
    case ClaimVerdict::not_reproduced:
      return "not reproduced";
    case ClaimVerdict::open:
      break;
  }
  return "cannot be told";
}

PlaneMap::Condition recommended(double d_over_r0) {
  const double talbot = talbot_distance_of_seeing(d_over_r0);
  return [talbot](double near, double far) {
    return near > talbot / 1.5 && near < talbot * 1.5 && far >= 150 * km;
  };
}

std::string median_text(const std::vector<double>& values) {
  if (values.empty()) return "none";
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", quantile(values, 0.5), quantile(values, 0.1),
                     quantile(values, 0.9));
}

std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures) {
  std::vector<Claim> claims;
  for (const auto rules :
       {distance_claims, plane_count_claims, sampling_claims, broadband_claims}) {
    for (const ClaimRule& rule : rules()) {
      if (std::ranges::count(figures, rule.figure) == 0) continue;
      Claim claim{.figure = std::string(rule.figure),
                  .sentence = std::string(rule.sentence),
                  .papers = std::string(rule.papers),
                  .rule = std::string(rule.rule),
                  .findings = {}};
      for (const StudySetup setup : setups) {
        ClaimFinding finding = rule.find(SetupRuns(runs, setup));
        finding.why = setup == StudySetup::paper ? rule.papers_why : rule.extended_why;
        claim.findings.emplace(setup, std::move(finding));
      }
      claims.push_back(std::move(claim));
    }
  }
  return claims;
}

}  // namespace nlcwfs
