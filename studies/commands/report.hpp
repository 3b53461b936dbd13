// report: The page of an earlier run, again.
#pragma once

#include "studies/run/command.hpp"

namespace nlcwfs {

/// The command of an earlier run, which its summary.json names.
/// @throws InputError naming DIR where there is no summary, or it is of no command that leaves one
const Command& command_of_run(const std::filesystem::path& folder);

}  // namespace nlcwfs
