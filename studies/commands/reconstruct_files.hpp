// What reconstruct writes: phases, frames, predictions, pictures.
#pragma once

#include "results/archive/output_folder.hpp"
#include "studies/commands/frame_sets.hpp"

namespace nlcwfs {

/// What write_frame_files() writes.
std::vector<RunFile> frame_files();

/// Writes the phases, the calibrated frames, what the phases predict for them, how well they agree,
/// and pictures of the first set.
/// @return a line for each reason why there are no pictures
std::vector<std::string> write_frame_files(const FrameRun& run, const OutputFolder& folder);

}  // namespace nlcwfs
