// Which samples lie in the pupil, and the light that enters there.
#include "model/pupil.hpp"

#include <cassert>

namespace nlcwfs {

PupilMask pupil_mask(int samples, double central_obscuration) {
  PupilMask mask(samples, samples);
  const double outer_radius = 0.5 * samples;
  const double inner_radius = central_obscuration * outer_radius;
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const double y = row - 0.5 * (samples - 1);
      const double x = column - 0.5 * (samples - 1);
      const double radius_squared = x * x + y * y;
      mask(row, column) = radius_squared <= outer_radius * outer_radius &&
                          radius_squared >= inner_radius * inner_radius;
    }
  }
  return mask;
}

Field<double> pupil_field(const PhaseScreen& phase, const PupilMask& mask) {
  assert(phase.rows() == mask.rows() && phase.cols() == mask.cols());
  const Field<double> beam = phase.unaryExpr([](double angle) { return std::polar(1.0, angle); });
  return mask.select(beam, std::complex<double>(0.0));
}

Image<double> block_average(const Image<double>& image, Eigen::Index factor) {
  assert(image.rows() % factor == 0 && image.cols() % factor == 0);
  if (factor == 1) return image;
  Image<double> average = Image<double>::Zero(image.rows() / factor, image.cols() / factor);
  for (Eigen::Index row = 0; row < average.rows(); ++row) {
    for (Eigen::Index column = 0; column < average.cols(); ++column) {
      average(row, column) = image.block(row * factor, column * factor, factor, factor).mean();
    }
  }
  return average;
}

}  // namespace nlcwfs
