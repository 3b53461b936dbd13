// The light that reaches the detectors: extended, periodic or the reconstruction's own.
#include "model/true_light.hpp"

#include "model/detector.hpp"
#include "model/fresnel_propagator.hpp"
#include "model/grid_width.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cassert>
#include <map>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

class ExtendedPath final : public LightPath {
 public:
  ExtendedPath(const Telescope& telescope, const SensorDesign& design, int pupil_samples,
               const std::vector<double>& distances)
      : samples_per_pixel_(pupil_samples / design.detector.pupil_pixels),
        propagator_(pupil_samples, grid_width(design.detector.window, pupil_samples),
                    telescope.diameter / pupil_samples, telescope.wavelength),
        transfer_functions_(distances.size()),
        buffers_([this] {
          return Buffers{propagator_.working_field(), propagator_.working_field()};
        }) {
    tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
      transfer_functions_[i] = propagator_.transfer_function(distances[i]);
    });
  }

  void make_images(
      const Field<double>& pupil, std::span<const std::size_t> wanted,
      const std::function<void(std::size_t, const Image<double>&)>& take) const override {
    auto& [spectrum, field] = buffers_.local();
    const int window = propagator_.window_samples();
    propagator_.transform(pupil, spectrum);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      propagator_.propagate(spectrum, transfer_functions_[wanted[i]], field);
      take(i, integrate_pixels(field.topLeftCorner(window, window), samples_per_pixel_));
    }
  }

 private:
  /// Of a thread; see GerchbergSaxton::Workspace.
  struct Buffers {
    Field<double> spectrum;
    Field<double> field;
  };

  int samples_per_pixel_;
  WrapFreePropagator propagator_;
  std::vector<LineFactors<double>> transfer_functions_;
  mutable tbb::enumerable_thread_specific<Buffers> buffers_;
};

class PeriodicPath final : public LightPath {
 public:
  PeriodicPath(const Telescope& telescope, const SensorDesign& design, int pupil_samples,
               std::vector<double> distances)
      : distances_(std::move(distances)),
        samples_per_pixel_(pupil_samples / design.detector.pupil_pixels),
        propagator_(design.detector.width() * samples_per_pixel_,
                    telescope.diameter / pupil_samples, telescope.wavelength),
        fields_(
            [samples = propagator_.samples()] { return padded_lines<double>(samples, samples); }) {}

  void make_images(
      const Field<double>& pupil, std::span<const std::size_t> wanted,
      const std::function<void(std::size_t, const Image<double>&)>& take) const override {
    const int width = propagator_.samples();
    const RowRange pupil_rows = propagator_.middle_rows(pupil.rows());
    Field<double>& field = fields_.local();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      field.setZero();
      field.block(pupil_rows.first, pupil_rows.first, pupil.rows(), pupil.cols()) = pupil;
      propagator_.propagate(field, distances_[wanted[i]]);
      take(i, integrate_pixels(field.leftCols(width), samples_per_pixel_));
    }
  }

 private:
  std::vector<double> distances_;
  int samples_per_pixel_;
  FresnelPropagator<double> propagator_;
  mutable tbb::enumerable_thread_specific<Field<double>> fields_;
};

}  // namespace

TrueLight::TrueLight(TruthModel model, const Telescope& telescope, const SensorDesign& design,
                     int pupil_samples, const LightSource& source)
    : mask_(pupil_mask(pupil_samples, telescope.central_obscuration)) {
  const std::size_t count = design.planes.size();
  std::vector<double> distances;
  for (std::size_t plane = 0; plane < count; ++plane) {
    const double centre = source.band(plane, count, telescope.wavelength).centre();
    planes_.emplace_back();
    for (const SpectralLine& line : source.lines(plane, count, telescope.wavelength)) {
      const double phase_factor = source.aberration == ChromaticAberration::path
                                      ? telescope.wavelength / line.wavelength
                                      : 1.0;
      planes_.back().push_back({distances.size(), phase_factor, line.weight});
      distances.push_back(design.planes[plane] * (line.wavelength / centre));
    }
  }
  if (model == TruthModel::extended) {
    path_ = std::make_unique<ExtendedPath>(telescope, design, pupil_samples, distances);
  } else {
    assert(model == TruthModel::periodic || pupil_samples == design.pupil_samples());
    path_ = std::make_unique<PeriodicPath>(telescope, design, pupil_samples, std::move(distances));
  }
}

std::vector<Image<double>> TrueLight::images(const PhaseScreen& phase,
                                             std::span<const std::size_t> wanted) const {
  std::vector<Image<double>> images(wanted.size());
  /// The lines of one field in the pupil, with the images that they are part of.
  struct Part {
    std::size_t image;
    double weight;
  };
  std::map<double, std::pair<std::vector<std::size_t>, std::vector<Part>>> of_factor;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (const Line& line : planes_[wanted[i]]) {
      auto& [distances, parts] = of_factor[line.phase_factor];
      distances.push_back(line.distance);
      parts.push_back({i, line.weight});
    }
  }
  for (const auto& [factor, lines] : of_factor) {
    const auto& [distances, parts] = lines;
    path_->make_images(pupil_field(phase * factor, mask_), distances,
                       [&images, &parts = parts](std::size_t i, const Image<double>& image) {
                         Image<double>& sum = images[parts[i].image];
                         if (sum.size() == 0) {
                           sum = parts[i].weight * image;
                         } else {
                           sum += parts[i].weight * image;
                         }
                       });
  }
  return images;
}

}  // namespace nlcwfs
