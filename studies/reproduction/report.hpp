#pragma once

#include "results/archive/output_folder.hpp"
#include "studies/reproduction/paper_claims.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

/// "11 reproduced, 6 reproduced in trend, 4 not reproduced"
std::string count_text(const std::vector<Claim>& claims, StudySetup setup);

/// Writes what a reproduction leaves beside its runs, so that the folder without them is a whole:
/// report.md, claims.csv, and the figures as pictures, CSV and FITS.
/// @param figures  of reproduced_figures
/// @param screens  of the reproduction
/// @return a line for each picture that there is not, with the reason
/// @throws std::runtime_error with path and cause
std::vector<std::string> write_reproduction_report(const OutputFolder& folder,
                                                   const ReproducedRuns& runs,
                                                   const std::vector<Claim>& claims,
                                                   const std::vector<std::string>& figures,
                                                   int screens);

}  // namespace nlcwfs
