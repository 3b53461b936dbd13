// Light becomes a plane's image: pixels, window, photons and noise.
#include "model/detector.hpp"

#include "model/grid_width.hpp"
#include "model/input_error.hpp"

#include <cmath>

#include <boost/random/normal_distribution.hpp>
#include <boost/random/poisson_distribution.hpp>

namespace nlcwfs {
namespace {

/// Counts beyond this would not be exact in a double.
constexpr double max_photons = 1e15;

}  // namespace

int Detector::width() const { return grid_width(window, pupil_pixels); }

double Detector::photons_per_frame() const {
  return photon_rate > 0.0 ? photon_rate * exposure : photons;
}

void Detector::validate() const {
  require(pupil_pixels >= 4 && pupil_pixels <= max_grid_width && pupil_pixels % 2 == 0,
          "detector.pupil_pixels", pupil_pixels,
          fmt::format("an even number from 4 to {}", max_grid_width));
  validate_grid_window("detector.window", window, "detector.pupil_pixels", pupil_pixels);
  require(photons >= 0.0 && photons <= max_photons, "detector.photons", photons,
          fmt::format("from 0 (= no photon noise) to {:g}", max_photons));
  require(photon_rate >= 0.0 && std::isfinite(photon_rate), "detector.photon_rate", photon_rate,
          "at least 0 photons per second");
  require(exposure >= 0.0 && std::isfinite(exposure), "detector.exposure", exposure,
          "a time of at least 0, such as 1ms");
  require(photon_rate == 0.0 || photons == 0.0, "detector.photon_rate", photon_rate,
          fmt::format("set only one of it and detector.photons, which is {}", photons));
  require(photon_rate == 0.0 || exposure > 0.0, "detector.photon_rate", photon_rate,
          "needs detector.exposure above 0, such as 1ms");
  require(photons_per_frame() <= max_photons, "detector.photon_rate", photon_rate,
          fmt::format("at most {:g} photons in detector.exposure, which is {} s", max_photons,
                      exposure));
  require(read_noise >= 0.0 && std::isfinite(read_noise), "detector.read_noise", read_noise,
          "at least 0 electrons");
  require(read_noise == 0.0 || photons_per_frame() > 0.0, "detector.read_noise", read_noise,
          "needs detector.photons or detector.photon_rate above 0, which say how many "
          "electrons the light is");
}

Image<double> integrate_pixels(const Eigen::Ref<const Field<double>>& field,
                               int samples_per_pixel) {
  const Eigen::Index pixels = field.cols() / samples_per_pixel;
  Image<double> image = Image<double>::Zero(field.rows() / samples_per_pixel, pixels);
  for (Eigen::Index row = 0; row < field.rows(); ++row) {
    const std::complex<double>* sample = field.data() + row * field.outerStride();
    double* const intensity = &image(row / samples_per_pixel, 0);
    for (Eigen::Index pixel = 0; pixel < pixels; ++pixel) {
      for (int i = 0; i < samples_per_pixel; ++i) intensity[pixel] += std::norm(*sample++);
    }
  }
  return image / (samples_per_pixel * samples_per_pixel);
}

void add_noise(Image<double>& image, double photons_per_unit, double read_noise,
               RandomStream& stream) {
  boost::random::normal_distribution<double> normal(0.0, 1.0);
  for (double& intensity : image.reshaped<Eigen::RowMajor>()) {
    const double expected = intensity * photons_per_unit;
    double electrons = 0.0;
    if (expected > 0.0) {
      electrons = double(boost::random::poisson_distribution<long, double>(expected)(stream));
    }
    if (read_noise > 0.0) electrons += read_noise * normal(stream);
    intensity = electrons / photons_per_unit;
  }
}

}  // namespace nlcwfs
