#pragma once

#include <filesystem>

namespace nlcwfs {

/// Makes report.html of a run's folder, from the files that are there: a page for a browser that
/// needs nothing else. One that is there already is replaced.
/// @throws InputError naming DIR where the folder is of no run that is done; std::runtime_error
///         where the page cannot be written
void write_page(const std::filesystem::path& folder);

}  // namespace nlcwfs
