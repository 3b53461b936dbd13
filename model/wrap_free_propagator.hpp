// Light is propagated to a window on an infinite plane, where nothing wraps round.
#pragma once

#include "model/array.hpp"
#include "model/fourier_transform.hpp"

namespace nlcwfs {

/// Fresnel propagation of the light in the pupil to a window around the axis, on an infinite plane:
/// nothing wraps round. This makes the sensor's data, so that a periodic reconstructor does not
/// meet its own errors again (the inverse crime).
///
/// The pupil's samples stand for the field that is band-limited to their Nyquist frequency. Its
/// propagation is a convolution with the band-limited Fresnel kernel
///   p(x) = integral over |f| < 1/(2 pitch) of exp(-i pi lambda z f^2) exp(2 pi i f x) df  * pitch,
/// separable in x and y, which holds at every distance, z = 0 included. The kernel is evaluated by
/// one long line transform, the trapezoidal rule for that integral, with the first two corrections
/// of Euler and Maclaurin; the convolution of pupil and window then needs only pupil + window
/// samples per axis to be exact.
class WrapFreePropagator {
 public:
  /// @param pupil_samples   samples across the pupil's square
  /// @param window_samples  samples across the window, of the same parity as pupil_samples, so that
  ///                        both grids share their sample positions
  /// @param pitch           sample spacing of both, m
  /// @param wavelength      m
  /// @param period_margin   least period of the kernel, over lambda |z| / (2 pitch) + the widths of
  ///                        pupil and window; less, but at least 4, where the period would exceed
  ///                        2^24 samples
  WrapFreePropagator(int pupil_samples, int window_samples, double pitch, double wavelength,
                     double period_margin = 16.0);

  /// How many samples the window has along a side.
  int window_samples() const { return window_samples_; }

  /// The farthest plane, m: beyond it the kernel's period would have to be longer than 2^24 samples
  /// (1 GiB of work space) to leave the light room for four times its reach.
  double farthest_distance() const;

  /// The kernel's discrete transform along one axis for a plane at `distance` (m, signed).
  /// @pre |distance| <= farthest_distance()
  LineFactors<double> transfer_function(double distance) const;

  /// Room for a spectrum or a field.
  Field<double> working_field() const;

  /// The transform of a pupil field (pupil_samples x pupil_samples), shared by all planes.
  /// @param spectrum  a working_field()
  void transform(const Field<double>& pupil, Field<double>& spectrum) const;

  /// The field in the window of one plane.
  /// @param field  a working_field(), whose first window_samples x window_samples become the
  ///               window; the others are undefined
  void propagate(const Field<double>& spectrum, const LineFactors<double>& transfer,
                 Field<double>& field) const;

 private:
  int pupil_samples_;
  int window_samples_;
  double pitch_;
  double wavelength_;
  double period_margin_;
  LineTransform<double> transform_;
};

}  // namespace nlcwfs
