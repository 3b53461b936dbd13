// Single spatial frequencies are put before a sensor, beside what theory lets expect.
#include "model/frequency_response.hpp"

#include "model/random_stream.hpp"
#include "model/sample_positions.hpp"

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <boost/random/uniform_real_distribution.hpp>

namespace nlcwfs {
namespace {

using std::numbers::pi;

/// The share of a disc's area that another of the same size covers.
/// @param distance  of their centres, diameters
double shared_area(double distance) {
  if (distance >= 1.0) return 0.0;
  return 2.0 / pi * (std::acos(distance) - distance * std::sqrt(1.0 - distance * distance));
}

}  // namespace

PhaseScreen sinusoid_screen(const PhaseSinusoid& sinusoid, int samples) {
  const double wave_number = 2.0 * pi * sinusoid.frequency / samples;
  const Eigen::ArrayXd position = wave_number * sample_positions(samples);
  PhaseScreen screen(samples, samples);
  screen.rowwise() = std::cos(sinusoid.orientation) * position.transpose() + sinusoid.phase;
  screen.colwise() += std::sin(sinusoid.orientation) * position;
  return sinusoid.amplitude * screen.sin();
}

std::vector<PhaseScreen> sinusoid_screens(double frequency, double amplitude, int samples,
                                          int count, std::uint64_t seed) {
  boost::random::uniform_real_distribution<double> angle(0.0, 2.0 * pi);
  std::vector<PhaseScreen> screens;
  for (int screen = 0; screen < count; ++screen) {
    RandomStream stream = random_stream({seed, static_cast<std::uint64_t>(screen)});
    const double orientation = angle(stream);
    const double phase = angle(stream);
    screens.push_back(sinusoid_screen({frequency, amplitude, orientation, phase}, samples));
  }
  return screens;
}

std::vector<SinusoidContrast> sinusoid_contrasts(const Telescope& telescope,
                                                 const std::vector<double>& planes,
                                                 double frequency, const LightSource& source) {
  std::vector<SinusoidContrast> contrasts;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const double fresnel = fresnel_number(telescope, planes[plane]);
    const double centre = source.band(plane, planes.size(), telescope.wavelength).centre();
    // A beam's amplitude and how far it falls behind the pupil's light: it began a quarter ahead.
    std::complex<double> beam = 0.0;
    for (const SpectralLine& line : source.lines(plane, planes.size(), telescope.wavelength)) {
      const double phase_factor = source.aberration == ChromaticAberration::path
                                      ? telescope.wavelength / line.wavelength
                                      : 1.0;
      const double lag = pi * frequency * frequency / fresnel * (line.wavelength / centre);
      beam += std::polar(line.weight * phase_factor, lag);
    }
    const double meeting = shared_area(2.0 * frequency / std::abs(fresnel));
    const double in_phase = beam.real() * beam.real();
    const double in_quadrature = beam.imag() * beam.imag();
    contrasts.push_back({.talbot = 2.0 * beam.imag(),
                         .effective = std::sqrt(2.0 * ((1.0 - meeting) * in_phase +
                                                       (1.0 + meeting) * in_quadrature))});
  }
  return contrasts;
}

double rms_contrast(const std::vector<SinusoidContrast>& contrasts,
                    double SinusoidContrast::*contrast) {
  assert(!contrasts.empty());
  double squares = 0.0;
  for (const SinusoidContrast& plane : contrasts) squares += plane.*contrast * (plane.*contrast);
  return std::sqrt(squares / double(contrasts.size()));
}

double photon_limited_amplitude_error(double photons, double rms_contrast) {
  return std::sqrt(2.0 / photons) / rms_contrast;
}

}  // namespace nlcwfs
