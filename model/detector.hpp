// Light becomes a plane's image: pixels, window, photons and noise.
#pragma once

#include "model/array.hpp"
#include "model/random_stream.hpp"

namespace nlcwfs {

/// The detector of one measurement plane: square pixels of D / pupil_pixels on a square window
/// centred on the beam.
struct Detector {
  int pupil_pixels = 64;    ///< pixels across the pupil diameter, even
  double window = 4.0;      ///< width in pupil diameters, at least 1
  double photons = 0.0;     ///< photons per frame in all planes together; 0 = no photon noise
  double read_noise = 0.0;  ///< electrons RMS per pixel; needs light
  /// Photons per second in all planes together, in place of `photons`; needs an exposure. 0 = none.
  double photon_rate = 0.0;
  double exposure = 0.0;  ///< s; 0 = not known

  /// Photons in all planes together; 0 = no photon noise.
  double photons_per_frame() const;
  /// Pixels along each side of the detector: window x pupil_pixels.
  int width() const;

  /// @throws InputError where a value is not allowed
  void validate() const;
};

/// Integrates the light on the detector's pixels: the mean intensity over each.
/// @param field              the field over the window, width x samples_per_pixel samples a side
/// @param samples_per_pixel  samples per pixel and axis
/// @return width x width, in units of the intensity of the field
Image<double> integrate_pixels(const Eigen::Ref<const Field<double>>& field, int samples_per_pixel);

/// Adds photon and read noise to an image, in place.
/// Each pixel becomes (Poisson(photons) + read_noise x Normal(0, 1)) back in the image's units.
/// @param photons_per_unit  expected photons in a pixel of intensity 1; above 0
/// @param read_noise        electrons RMS per pixel
void add_noise(Image<double>& image, double photons_per_unit, double read_noise,
               RandomStream& stream);

}  // namespace nlcwfs
