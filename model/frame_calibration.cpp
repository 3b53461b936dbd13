// Measured frames become images: background, bad pixels, saturation, brightness.
#include "model/frame_calibration.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace nlcwfs {

Eigen::Index calibrated_width(Eigen::Index rows, Eigen::Index columns) {
  const Eigen::Index longer = std::max(rows, columns);
  return longer + longer % 2;
}

Image<double> calibrated_frame(const Image<double>& frame, const Image<double>& background,
                               const PixelMask& bad, double saturation) {
  assert(background.rows() == frame.rows() && background.cols() == frame.cols());
  assert(bad.rows() == frame.rows() && bad.cols() == frame.cols());
  constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Index width = calibrated_width(frame.rows(), frame.cols());
  Image<double> calibrated = Image<double>::Constant(width, width, unmeasured);
  calibrated.topLeftCorner(frame.rows(), frame.cols()) =
      (!bad && frame.isFinite() && background.isFinite() && frame < saturation)
          .select(frame - background, unmeasured);
  return calibrated;
}

}  // namespace nlcwfs
