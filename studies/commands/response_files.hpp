// What response writes: a table and pictures.
#pragma once

#include "results/archive/output_folder.hpp"
#include "studies/commands/frequency_responses.hpp"

namespace nlcwfs {

/// What write_response_files() writes.
std::vector<RunFile> response_files();

/// Writes a table of all responses, and pictures: a line of the design's, maps of the pairs'.
/// @return notes where there is no picture
std::vector<std::string> write_response_files(const ResponseTask& task, const Responses& responses,
                                              const OutputFolder& folder);

}  // namespace nlcwfs
