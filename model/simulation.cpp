#include "model/simulation.hpp"

#include "model/fresnel_propagator.hpp"
#include "model/gerchberg_saxton.hpp"
#include "model/grid_width.hpp"
#include "model/input_error.hpp"
#include "model/random_stream.hpp"
#include "model/wrap_free_propagator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

/// The true light in the detector's window of each plane, at the truth's samples.
class TrueLight {
 public:
  virtual ~TrueLight() = default;
  /// The fields of all planes, in visiting order, of a pupil field.
  virtual std::vector<Field<double>> at_planes(const Field<double>& pupil) const = 0;
};

class ExtendedLight final : public TrueLight {
 public:
  ExtendedLight(const Telescope& telescope, const SensorDesign& design, int pupil_samples)
      : propagator_(pupil_samples, grid_width(design.detector.window, pupil_samples),
                    telescope.diameter / pupil_samples, telescope.wavelength) {
    for (const double plane : design.planes) {
      transfer_functions_.push_back(propagator_.transfer_function(plane));
    }
  }

  std::vector<Field<double>> at_planes(const Field<double>& pupil) const override {
    const Field<double> spectrum = propagator_.spectrum(pupil);
    std::vector<Field<double>> fields;
    for (const Eigen::ArrayXcd& transfer : transfer_functions_) {
      fields.push_back(propagator_.field(spectrum, transfer));
    }
    return fields;
  }

 private:
  WrapFreePropagator propagator_;
  std::vector<Eigen::ArrayXcd> transfer_functions_;
};

class MatchedLight final : public TrueLight {
 public:
  MatchedLight(const Telescope& telescope, const SensorDesign& design)
      : planes_(design.planes),
        propagator_(design.grid_width(), telescope.diameter / design.pupil_samples(),
                    telescope.wavelength) {}

  std::vector<Field<double>> at_planes(const Field<double>& pupil) const override {
    const Eigen::Index width = propagator_.samples();
    const Eigen::Index border = (width - pupil.rows()) / 2;
    Field<double> padded = Field<double>::Zero(width, width);
    padded.block(border, border, pupil.rows(), pupil.cols()) = pupil;
    std::vector<Field<double>> fields(planes_.size(), padded);
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
      propagator_.propagate(fields[plane], planes_[plane]);
    }
    return fields;
  }

 private:
  std::vector<double> planes_;
  FresnelPropagator<double> propagator_;
};

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
class Experiment {
 public:
  Experiment(const Telescope& telescope, const SensorDesign& design,
             const SimulationOptions& options, const PupilMask& truth_mask)
      : telescope_(telescope),
        detector_(design.detector),
        options_(options),
        truth_mask_(truth_mask),
        samples_per_pixel_(static_cast<int>(truth_mask.rows()) / design.detector.pupil_pixels),
        noise_keys_(ranks_by_distance(design.planes)),
        reconstructor_(telescope, design),
        unwrapper_(reconstructor_.mask(), design.reconstruction.unwrapping) {
    if (options.truth == TruthModel::matched) {
      light_ = std::make_unique<MatchedLight>(telescope, design);
    } else {
      light_ =
          std::make_unique<ExtendedLight>(telescope, design, static_cast<int>(truth_mask.rows()));
    }
  }

  ScreenPerformance run(const PhaseScreen& truth, std::size_t screen) const {
    ScreenPerformance result;
    const Field<double> pupil = pupil_field(truth, truth_mask_);
    const double pupil_energy =
        double(truth_mask_.count()) / (samples_per_pixel_ * samples_per_pixel_);

    std::vector<Image<double>> images;
    for (const Field<double>& field : light_->at_planes(pupil)) {
      images.push_back(integrate_pixels(field, samples_per_pixel_));
      result.captured_energy.push_back(images.back().sum() / pupil_energy);
    }
    if (detector_.photons > 0.0) {
      const double photons_per_unit = detector_.photons / double(images.size()) / pupil_energy;
      for (std::size_t plane = 0; plane < images.size(); ++plane) {
        RandomStream stream = random_stream({options_.noise_seed, screen, noise_keys_[plane]});
        add_noise(images[plane], photons_per_unit, detector_.read_noise, stream);
      }
    }

    const auto start = std::chrono::steady_clock::now();
    const Reconstruction reconstruction = reconstructor_.reconstruct(images);
    const Image<double> phase = unwrapper_.unwrap(reconstruction.pupil_field);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    result.wavefront = measure_wavefront(reconstruction.pupil_field, phase, reconstructor_.mask(),
                                         truth, truth_mask_, telescope_.wavelength);
    result.converged = reconstruction.converged;
    result.loops = reconstruction.loops;
    result.fractional_loops = reconstruction.fractional_loops;
    result.fft_count = reconstruction.fft_count;
    return result;
  }

 private:
  const Telescope& telescope_;
  Detector detector_;
  SimulationOptions options_;
  const PupilMask& truth_mask_;
  int samples_per_pixel_;
  std::vector<std::size_t> noise_keys_;
  std::unique_ptr<const TrueLight> light_;
  GerchbergSaxton<Real> reconstructor_;
  PhaseUnwrapper unwrapper_;
};

template <class Real>
Performance run_all(const Telescope& telescope, const SensorDesign& design,
                    const SimulationOptions& options, const PupilMask& truth_mask,
                    const std::vector<PhaseScreen>& screens) {
  const Experiment<Real> experiment(telescope, design, options, truth_mask);
  Performance performance;
  performance.screens.resize(screens.size());
  tbb::parallel_for(std::size_t{0}, screens.size(), [&](std::size_t screen) {
    performance.screens[screen] = experiment.run(screens[screen], screen);
  });
  return performance;
}

}  // namespace

Simulation::Simulation(const Telescope& telescope, std::vector<PhaseScreen> screens,
                       const SimulationOptions& options)
    : telescope_(telescope), screens_(std::move(screens)), options_(options) {
  telescope_.validate();
  if (screens_.empty()) throw InputError("screens.count", 0, "at least 1");
  mask_ = pupil_mask(static_cast<int>(screens_.front().rows()), telescope_.central_obscuration);
}

SensorDesign Simulation::checked(SensorDesign design) const {
  const auto samples = static_cast<int>(screens_.front().rows());
  const int pixels = design.detector.pupil_pixels;
  if (options_.truth == TruthModel::matched) {
    design.detector.window = design.reconstruction.window;
    design.validate(telescope_);
    if (samples != pixels) {
      throw InputError("simulation.pupil_samples", samples,
                       fmt::format("a matched truth has the detector's {} samples", pixels));
    }
    if (design.reconstruction.oversampling != 1) {
      throw InputError("reconstruction.oversampling", design.reconstruction.oversampling,
                       "1 with a matched truth, whose grid is the reconstruction's");
    }
    return design;
  }
  design.validate(telescope_);
  if (samples % pixels != 0) {
    throw InputError("simulation.pupil_samples", samples,
                     fmt::format("a multiple of detector.pupil_pixels, which is {}", pixels));
  }
  if (samples % design.pupil_samples() != 0 && design.pupil_samples() % samples != 0) {
    throw InputError("reconstruction.oversampling", design.reconstruction.oversampling,
                     fmt::format("detector.pupil_pixels x reconstruction.oversampling, which is "
                                 "{}, must be a multiple or a divisor of "
                                 "simulation.pupil_samples, which is {}",
                                 design.pupil_samples(), samples));
  }
  validate_grid_window("detector.window", design.detector.window, "simulation.pupil_samples",
                       samples);
  return design;
}

Performance Simulation::evaluate(const SensorDesign& design) const {
  const SensorDesign valid = checked(design);
  Performance performance = options_.precision == Precision::double_precision
                                ? run_all<double>(telescope_, valid, options_, mask_, screens_)
                                : run_all<float>(telescope_, valid, options_, mask_, screens_);
  for (const ScreenPerformance& screen : performance.screens) {
    if (!std::isfinite(screen.wavefront.residual_wfe) ||
        !std::isfinite(screen.wavefront.total_wfe)) {
      throw std::runtime_error("the reconstruction ended in a wavefront that is not a number");
    }
  }
  return performance;
}

}  // namespace nlcwfs
