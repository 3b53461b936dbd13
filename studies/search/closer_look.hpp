// A design is shown on its typical and on its worst wavefront.
#pragma once

#include "objectives/design_trial.hpp"
#include "results/archive/output_folder.hpp"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// What a closer look left beside its files.
struct CloserLook {
  nlohmann::ordered_json summary;  ///< the object `closer_look` of a run's summary
  std::vector<std::string> notes;  ///< where there are no pictures
};

/// The files of a closer look.
/// @param is_certain  whether every run has one
std::vector<RunFile> closer_look_files(bool is_certain = true);

/// Shows a design on its typical screen (of the median residual WFE, the lower of the two middle
/// ones) and on its worst: what the detectors saw, what was made of it and how the loops got there.
/// Both are simulated again. Writes
///   - {typical,worst}-images.fits: detector images, one per plane in visiting order, in units of
///     the unaberrated pupil's intensity, noise included;
///   - {typical,worst}-phases.fits: true, reconstructed and residual phase on the reconstruction's
///     samples, rad, piston removed, NaN outside the pupil;
///   - loops.csv: the residual WFE after each loop;
///   - pictures: design, {typical,worst}-images, {typical,worst}-phases, loops.
/// Of several conditions, the screens are chosen among those of all.
/// @param tried  in the trial, on all of its screens
/// @throws std::runtime_error with path and cause where a file cannot be written
CloserLook look_closer(const DesignTrial& trial, const TriedDesign& tried,
                       const OutputFolder& folder);

}  // namespace nlcwfs
