// How much the wavefront changes from loop to loop, and when that is little enough.
#include "model/loop_change.hpp"

#include "model/wavefront_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nlcwfs {

LoopChange::LoopChange(StoppingRule rule, const PupilMask& mask, const PhaseUnwrapper& unwrapper,
                       Field<double> first)
    : rule_(rule), mask_(mask), unwrapper_(unwrapper), before_(std::move(first)) {
  if (rule_ == StoppingRule::rms_change) rms_before_ = unwrapped_rms(before_);
}

double LoopChange::update(Field<double> field) {
  if (rule_ == StoppingRule::rms_change) {
    const double rms = unwrapped_rms(field);
    return std::abs(rms - std::exchange(rms_before_, rms));
  }
  const double change = wrapped_phase_rms(field, before_, mask_);
  before_ = std::move(field);
  return change;
}

double LoopChange::unwrapped_rms(const Field<double>& field) const {
  return piston_free_rms(unwrapper_.unwrap(field), mask_);
}

double fractional_loop_count(const std::vector<double>& changes, double tolerance) {
  const std::size_t loops = changes.size();
  if (loops == 1) return 1.0;
  // A change of exactly 0 has no logarithm; far below the tolerance it is the same.
  const double last = std::max(changes[loops - 1], 1e-9 * tolerance);
  const double before = changes[loops - 2];
  return double(loops - 1) + std::log(before / tolerance) / std::log(before / last);
}

}  // namespace nlcwfs
