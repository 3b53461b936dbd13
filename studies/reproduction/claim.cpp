// A claim of the paper and what it has come to.
#include "studies/reproduction/claim.hpp"

#include "results/tables/csv_table.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string count_text(const std::vector<Claim>& claims, StudySetup setup) {
  std::vector<std::string> texts;
  for (const ClaimVerdict verdict : {ClaimVerdict::reproduced, ClaimVerdict::in_trend,
                                     ClaimVerdict::not_reproduced, ClaimVerdict::open}) {
    const auto count = std::ranges::count_if(
        claims, [&](const Claim& claim) { return claim.findings.at(setup).verdict == verdict; });
    if (count > 0) texts.push_back(fmt::format("{} {}", count, to_string(verdict)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string claims_table(const std::vector<Claim>& claims) {
  CsvTable table({"figure", "claim", "papers_number", "paper_verdict", "paper_number", "paper_why",
                  "extended_verdict", "extended_number", "extended_why", "rule"});
  for (const Claim& claim : claims) {
    table.row().add(claim.figure).add(claim.sentence).add(claim.papers);
    for (const StudySetup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      table.add(to_string(finding.verdict)).add(finding.number).add(finding.why);
    }
    table.add(claim.rule);
  }
  return table.text();
}

}  // namespace nlcwfs
