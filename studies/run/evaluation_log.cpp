// Evaluations are archived, and logged.
#include "studies/run/evaluation_log.hpp"

#include "studies/settings/text.hpp"

#include <spdlog/spdlog.h>

namespace nlcwfs {

void archive_and_log(Archive& archive, const ArchivedEvaluation& evaluation) {
  archive.add(evaluation);
  if (evaluation.failure.empty()) {
    spdlog::debug("{}: a design, cost {:.6g}, {:.3g} s", evaluation.stage, evaluation.cost,
                  evaluation.seconds);
  } else {
    spdlog::debug("{}: a design failed, {:.3g} s: {}", evaluation.stage, evaluation.seconds,
                  without_controls(evaluation.failure));
  }
}

}  // namespace nlcwfs
