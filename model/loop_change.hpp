// How much the wavefront changes from loop to loop, and when that is little enough.
#pragma once

#include "model/array.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/pupil.hpp"
#include "model/sensor_design.hpp"

#include <vector>

namespace nlcwfs {

/// Measures how much the wavefront changes from loop to loop, by one of the stopping rules.
class LoopChange {
 public:
  /// @param first  the pupil field that the loop starts from
  LoopChange(StoppingRule rule, const PupilMask& mask, const PhaseUnwrapper& unwrapper,
             Field<double> first);

  /// The change in rad from the field before to this one, which the next is compared with.
  double update(Field<double> field);

 private:
  double unwrapped_rms(const Field<double>& field) const;

  StoppingRule rule_;
  const PupilMask& mask_;
  const PhaseUnwrapper& unwrapper_;
  Field<double> before_;
  double rms_before_ = 0.0;
};

/// The loop count at which a change that falls from loop to loop crosses the tolerance,
/// interpolated linearly in log(change) between the last two loops; 1 where the first loop is
/// already below.
/// @pre the last change is below the tolerance, the one before it is not
double fractional_loop_count(const std::vector<double>& changes, double tolerance);

}  // namespace nlcwfs
