// The files of a run become the data of its page.
#pragma once

#include "studies/run/command.hpp"

namespace nlcwfs {

/// summary.json of a run.
/// @throws InputError naming DIR where there is none, or it cannot be read
nlohmann::ordered_json summary_of_run(const std::filesystem::path& folder);

/// What the page of a run shows, from the files of its folder alone:
///
/// - command, version, written (when, UTC), telescope and verdict (a line each), notes (lines on
///   what is not there or cannot be read)
/// - summary                   summary.json without its configuration
/// - configuration             config.cfg as it is
/// - design_configuration      {file, text} of the design that the run ends in
/// - diameter_m, talbot_m      of the telescope, of the Fried parameter
/// - best_place                where a sweep's best stands on each axis of its grid, null where
///                             nowhere
/// - front_configurations      of each design of a trade's front, without comments
/// - tables                    by file: columns by their names, numbers where all cells are
/// - images                    by file: unit, samples along each side, count, and the first slices,
///                             see page_image()
/// - pictures                  by file: SVG
///
/// @param command  of the run
/// @throws InputError as above
nlohmann::ordered_json page_data(const std::filesystem::path& folder, const Command& command);

/// Makes report.html of a run's folder, from the files that are there: a page for a browser that
/// needs nothing else. One that is there already is replaced.
/// @throws InputError as above; std::runtime_error where the page cannot be written
void write_page(const std::filesystem::path& folder, const Command& command);

}  // namespace nlcwfs
