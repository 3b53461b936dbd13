// One design on one set of wavefronts, from the pupil to its performance.
#include "model/simulation.hpp"

#include "model/bound_text.hpp"
#include "model/gerchberg_saxton.hpp"
#include "model/grid_width.hpp"
#include "model/input_error.hpp"
#include "model/random_stream.hpp"
#include "model/wrap_free_propagator.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/nil_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

namespace nlcwfs {
namespace {

/// The most that kept images may take, bytes: 32 planes of the default design and 16 screens.
constexpr std::size_t kept_image_memory = std::size_t{256} * 1024 * 1024;

/// For each plane its rank by distance, so that the noise belongs to the plane and not to the order
/// in which the planes are visited.
std::vector<std::size_t> ranks_by_distance(const std::vector<double>& planes) {
  std::vector<std::size_t> ranks;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const auto nearer = std::ranges::count_if(planes, [&](double z) { return z < planes[plane]; });
    const auto equal_before = std::count(planes.begin(), planes.begin() + plane, planes[plane]);
    ranks.push_back(static_cast<std::size_t>(nearer + equal_before));
  }
  return ranks;
}

/// Everything of a design's simulation that does not depend on the screen.
template <class Real>
struct Experiment {
  const Telescope& telescope;
  const SensorDesign& design;
  const SimulationOptions& options;
  const PupilMask& truth_mask;
  ImageCache& cache;
  int samples_per_pixel = static_cast<int>(truth_mask.rows()) / design.detector.pupil_pixels;
  std::vector<std::size_t> noise_keys = ranks_by_distance(design.planes);
  TrueLight true_light{options.truth, telescope, design, static_cast<int>(truth_mask.rows()),
                       options.source};
  GerchbergSaxton<Real> reconstructor{telescope, design};

  /// @param record  gets all but the performance, where there is one
  ScreenPerformance run(const PhaseScreen& truth, std::size_t screen, bool follows_loops,
                        ScreenRecord* record = nullptr) const {
    using Clock = std::chrono::steady_clock;
    const auto data_start = Clock::now();
    const std::vector<ImageCache::SharedImage> light = noise_free_images(truth, screen);
    std::vector<Image<double>> images = detector_images(light, screen);

    const auto start = Clock::now();
    ScreenPerformance result;
    const auto after_loop = [&](const Field<double>& pupil) {
      const std::chrono::duration<double> so_far = Clock::now() - data_start;
      if (so_far.count() > options.time_limit) {
        throw std::runtime_error(fmt::format(
            "a wavefront took longer than simulation.time_limit, {:g} s", options.time_limit));
      }
      if (!follows_loops) return;
      result.residual_after_loops.push_back(
          measured(pupil, reconstructor.unwrapper().unwrap(pupil), truth).residual_wfe);
    };
    const Reconstruction reconstruction = reconstructor.reconstruct(images, after_loop);
    const Image<double> phase = reconstructor.unwrapper().unwrap(reconstruction.pupil_field);
    const std::chrono::duration<double> elapsed = Clock::now() - start;

    result.wavefront = measured(reconstruction.pupil_field, phase, truth);
    result.converged = reconstruction.converged;
    result.loops = reconstruction.loops;
    result.fractional_loops = reconstruction.fractional_loops;
    result.fft_count = reconstruction.fft_count;
    result.seconds = elapsed.count();
    result.data_seconds = std::chrono::duration<double>(start - data_start).count();
    for (const ImageCache::SharedImage& image : light) {
      result.captured_energy.push_back(image->sum() / pupil_energy());
    }
    if (record != nullptr) {
      record->images = std::move(images);
      record->true_phase = over_pupil(truth_on_samples(truth, phase.rows()));
      record->reconstructed_phase = over_pupil(phase);
      record->residual_phase = over_pupil(record->reconstructed_phase - record->true_phase);
    }
    return result;
  }

  /// Without piston, and with gaps outside the pupil.
  Image<double> over_pupil(const Image<double>& phase) const {
    const PupilMask& mask = reconstructor.mask();
    return mask.select(phase - piston(phase, mask), std::numeric_limits<double>::quiet_NaN());
  }

  WavefrontMetrics measured(const Field<double>& pupil, const Image<double>& phase,
                            const PhaseScreen& truth) const {
    return measure_wavefront(pupil, phase, reconstructor.mask(), truth, truth_mask,
                             telescope.wavelength);
  }

  /// The light of a unit-amplitude pupil, in units of intensity times detector pixels.
  double pupil_energy() const {
    return double(truth_mask.count()) / (samples_per_pixel * samples_per_pixel);
  }

  std::vector<ImageCache::SharedImage> noise_free_images(const PhaseScreen& truth,
                                                         std::size_t screen) const {
    const auto key = [&](std::size_t plane) {
      return ImageCache::Key{
          screen, design.planes[plane], design.detector.width(), design.detector.pupil_pixels,
          options.source.band(plane, design.planes.size(), telescope.wavelength)};
    };
    std::vector<ImageCache::SharedImage> images(design.planes.size());
    std::vector<std::size_t> missing;
    for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
      images[plane] = cache.find(key(plane));
      if (!images[plane]) missing.push_back(plane);
    }
    if (missing.empty()) return images;
    std::vector<Image<double>> made = true_light.images(truth, missing);
    for (std::size_t i = 0; i < missing.size(); ++i) {
      images[missing[i]] = std::make_shared<const Image<double>>(std::move(made[i]));
      cache.add(key(missing[i]), images[missing[i]]);
    }
    return images;
  }

  /// The light with the detector's noise; each plane gets an equal share of the photons.
  std::vector<Image<double>> detector_images(const std::vector<ImageCache::SharedImage>& light,
                                             std::size_t screen) const {
    std::vector<Image<double>> images;
    images.reserve(light.size());
    for (const ImageCache::SharedImage& image : light) images.push_back(*image);
    const double photons = design.detector.photons_per_frame();
    if (photons == 0.0) return images;
    const double photons_per_unit = photons / double(images.size()) / pupil_energy();
    for (std::size_t plane = 0; plane < images.size(); ++plane) {
      RandomStream stream = random_stream({options.noise_seed, screen, noise_keys[plane]});
      add_noise(images[plane], photons_per_unit, design.detector.read_noise, stream);
    }
    return images;
  }
};

/// Calls `action` with the experiment, in the precision that the options ask for.
template <class Action>
void with_experiment(const Telescope& telescope, const SensorDesign& design,
                     const SimulationOptions& options, const PupilMask& truth_mask,
                     ImageCache& images, const Action& action) {
  if (options.precision == Precision::double_precision) {
    action(Experiment<double>{telescope, design, options, truth_mask, images});
  } else {
    action(Experiment<float>{telescope, design, options, truth_mask, images});
  }
}

/// @throws std::runtime_error where its wavefront errors are none
void require_numbers(const ScreenPerformance& screen) {
  if (!std::isfinite(screen.wavefront.residual_wfe) || !std::isfinite(screen.wavefront.total_wfe)) {
    throw std::runtime_error("the reconstruction ended in a wavefront that is not a number");
  }
}

}  // namespace

SensorDesign simulated_design(SensorDesign design, const Telescope& telescope,
                              const SimulationOptions& options, int truth_samples) {
  telescope.validate();
  options.source.validate(design.planes.size());
  for (const int samples : {design.detector.pupil_pixels, truth_samples}) {
    require(pupil_mask(samples, telescope.central_obscuration).any(),
            "telescope.central_obscuration", telescope.central_obscuration,
            fmt::format("leaves none of {} x {} samples of the pupil lit", samples, samples));
  }
  const int pixels = design.detector.pupil_pixels;
  if (options.truth != TruthModel::extended) {
    // The detector's own window is not used; one that always fits leaves errors to the other's key.
    design.detector.window = 1.0;
    design.validate(telescope);
    design.detector.window = design.reconstruction.window;
  }
  if (options.truth == TruthModel::matched) {
    require(truth_samples == pixels, "simulation.pupil_samples", truth_samples,
            fmt::format("a matched truth has the detector's {} samples", pixels));
    require(design.reconstruction.oversampling == 1, "reconstruction.oversampling",
            design.reconstruction.oversampling,
            "1 with a matched truth, whose grid is the reconstruction's");
    return design;
  }
  design.validate(telescope);
  require(truth_samples % pixels == 0, "simulation.pupil_samples", truth_samples,
          fmt::format("a multiple of detector.pupil_pixels, which is {}", pixels));
  require(
      truth_samples % design.pupil_samples() == 0 || design.pupil_samples() % truth_samples == 0,
      "reconstruction.oversampling", design.reconstruction.oversampling,
      fmt::format("detector.pupil_pixels x reconstruction.oversampling, which is "
                  "{}, must be a multiple or a divisor of "
                  "simulation.pupil_samples, which is {}",
                  design.pupil_samples(), truth_samples));
  if (options.truth == TruthModel::periodic) {
    validate_grid_window("reconstruction.window", design.reconstruction.window,
                         "simulation.pupil_samples", truth_samples);
    return design;
  }
  validate_grid_window("detector.window", design.detector.window, "simulation.pupil_samples",
                       truth_samples);
  const double farthest =
      WrapFreePropagator(truth_samples, grid_width(design.detector.window, truth_samples),
                         telescope.diameter / truth_samples, telescope.wavelength)
          .farthest_distance();
  const std::size_t planes = design.planes.size();
  for (std::size_t plane = 0; plane < planes; ++plane) {
    // Long waves spread like those of the band's middle would farther away.
    const Band band = options.source.band(plane, planes, telescope.wavelength);
    const double reach = farthest * band.centre() / band.longest;
    if (std::abs(design.planes[plane]) <= reach) continue;
    throw InputError("sensor.planes", design.planes[plane],
                     fmt::format("distances within +-{} with simulation.pupil_samples = {}",
                                 bound_text(reach), truth_samples),
                     "fewer samples reach farther");
  }
  return design;
}

Simulation::Simulation(const Telescope& telescope, std::vector<PhaseScreen> screens,
                       SimulationOptions options)
    : telescope_(telescope),
      screens_(std::move(screens)),
      options_(std::move(options)),
      images_(kept_image_memory) {
  telescope_.validate();
  if (screens_.empty()) throw InputError("screens.count", 0, "at least 1");
  mask_ = pupil_mask(static_cast<int>(screens_.front().rows()), telescope_.central_obscuration);
}

SensorDesign Simulation::checked(SensorDesign design) const {
  return simulated_design(std::move(design), telescope_, options_, truth_samples());
}

Performance Simulation::evaluate(const SensorDesign& design, const ScreenWatch& watch) const {
  return evaluate(design, 0, screen_count(), watch);
}

Performance Simulation::evaluate(const SensorDesign& design, int first, int count,
                                 const ScreenWatch& watch) const {
  assert(first >= 0 && count >= 1 && first + count <= screen_count());
  return run(design, static_cast<std::size_t>(first), static_cast<std::size_t>(count), false,
             watch);
}

Performance Simulation::follow(SensorDesign design, const ScreenWatch& watch) const {
  design.reconstruction.tolerance = 0.0;
  return run(design, 0, screens_.size(), true, watch);
}

ScreenRecord Simulation::record(const SensorDesign& design, int screen) const {
  assert(screen >= 0 && screen < screen_count());
  const auto index = static_cast<std::size_t>(screen);
  ScreenRecord record;
  const auto run_one = [&](const auto& experiment) {
    record.performance = experiment.run(screens_[index], index, true, &record);
  };
  with_experiment(telescope_, checked(design), options_, mask_, images_, run_one);
  require_numbers(record.performance);
  return record;
}

std::string Simulation::identity() const {
  const LightSource& source = options_.source;
  std::string text = fmt::format(
      "{} {} {} {} {} {} {} {} {} {}", model_version, telescope_.diameter, telescope_.wavelength,
      telescope_.central_obscuration, static_cast<int>(options_.truth),
      static_cast<int>(options_.precision), options_.noise_seed, source.is_split,
      source.wavelengths, static_cast<int>(source.aberration));
  for (const Band& band : source.bands) {
    text += fmt::format(" {}:{}", band.shortest, band.longest);
  }
  for (const double weight : source.weights) text += fmt::format(" {}", weight);
  // Names of names: each depends on all that came before.
  boost::uuids::uuid name = boost::uuids::name_generator_sha1(boost::uuids::nil_uuid())(text);
  for (const PhaseScreen& screen : screens_) {
    name = boost::uuids::name_generator_sha1(name)(
        screen.data(), static_cast<std::size_t>(screen.size()) * sizeof(double));
  }
  return to_string(name);
}

std::vector<double> Simulation::aberrations() const {
  std::vector<double> aberrations;
  for (const PhaseScreen& screen : screens_) {
    aberrations.push_back(piston_free_rms(screen, mask_) * telescope_.wavelength /
                          (2.0 * std::numbers::pi));
  }
  return aberrations;
}

Performance Simulation::run(const SensorDesign& design, std::size_t first, std::size_t count,
                            bool follows_loops, const ScreenWatch& watch) const {
  Performance performance;
  performance.screens.resize(count);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> is_ended = false;
  const auto run_all = [&](const auto& experiment) {
    // One screen at a time: they take different numbers of loops. Whoever is free takes the next.
    tbb::parallel_for(
        std::size_t{0}, count,
        [&](std::size_t) {
          if (is_ended) return;
          const std::size_t i = next++;
          performance.screens[i] = experiment.run(screens_[first + i], first + i, follows_loops);
          if (watch && !watch()) is_ended = true;
        },
        tbb::simple_partitioner());
  };
  with_experiment(telescope_, checked(design), options_, mask_, images_, run_all);
  performance.screens.resize(next);
  for (const ScreenPerformance& screen : performance.screens) require_numbers(screen);
  return performance;
}

}  // namespace nlcwfs
