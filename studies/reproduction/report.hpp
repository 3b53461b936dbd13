// What a reproduction leaves beside its runs.
#pragma once

#include "results/archive/output_folder.hpp"
#include "studies/reproduction/claim.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <string>
#include <vector>

namespace nlcwfs {

/// Writes what a reproduction leaves beside its runs, so that the folder without them is a whole:
/// report.md, claims.csv, and the figures as pictures, CSV and FITS.
/// @param figures  names of those that were run
/// @param screens  of the reproduction
/// @return a line for each picture that there is not, with the reason
/// @throws std::runtime_error with path and cause
std::vector<std::string> write_reproduction_report(const OutputFolder& folder,
                                                   const ReproducedRuns& runs,
                                                   const std::vector<Claim>& claims,
                                                   const std::vector<std::string>& figures,
                                                   int screens);

}  // namespace nlcwfs
