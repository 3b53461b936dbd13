// Evaluations are archived, and logged.
#pragma once

#include "results/archive/archive.hpp"

namespace nlcwfs {

/// Archives an evaluation, and logs it: its stage, cost or failure, and how long it took.
void archive_and_log(Archive& archive, const ArchivedEvaluation& evaluation);

}  // namespace nlcwfs
