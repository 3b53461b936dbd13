#include "model/true_light.hpp"

#include "model/detector.hpp"
#include "model/fresnel_propagator.hpp"
#include "model/grid_width.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cassert>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

class ExtendedLight final : public TrueLight {
 public:
  ExtendedLight(const Telescope& telescope, const SensorDesign& design, int pupil_samples)
      : samples_per_pixel_(pupil_samples / design.detector.pupil_pixels),
        propagator_(pupil_samples, grid_width(design.detector.window, pupil_samples),
                    telescope.diameter / pupil_samples, telescope.wavelength),
        transfer_functions_(design.planes.size()),
        buffers_([this] {
          return Buffers{propagator_.working_field(), propagator_.working_field()};
        }) {
    tbb::parallel_for(std::size_t{0}, design.planes.size(), [&](std::size_t plane) {
      transfer_functions_[plane] = propagator_.transfer_function(design.planes[plane]);
    });
  }

  std::vector<Image<double>> images(const Field<double>& pupil,
                                    std::span<const std::size_t> wanted) const override {
    auto& [spectrum, field] = buffers_.local();
    const int window = propagator_.window_samples();
    propagator_.transform(pupil, spectrum);
    std::vector<Image<double>> images;
    for (const std::size_t plane : wanted) {
      propagator_.propagate(spectrum, transfer_functions_[plane], field);
      images.push_back(integrate_pixels(field.topLeftCorner(window, window), samples_per_pixel_));
    }
    return images;
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

class MatchedLight final : public TrueLight {
 public:
  MatchedLight(const Telescope& telescope, const SensorDesign& design)
      : planes_(design.planes),
        propagator_(design.grid_width(), telescope.diameter / design.pupil_samples(),
                    telescope.wavelength),
        fields_(
            [samples = propagator_.samples()] { return padded_lines<double>(samples, samples); }) {}

  std::vector<Image<double>> images(const Field<double>& pupil,
                                    std::span<const std::size_t> wanted) const override {
    const int width = propagator_.samples();
    const RowRange pupil_rows = propagator_.middle_rows(pupil.rows());
    Field<double>& field = fields_.local();
    std::vector<Image<double>> images;
    for (const std::size_t plane : wanted) {
      field.setZero();
      field.block(pupil_rows.first, pupil_rows.first, pupil.rows(), pupil.cols()) = pupil;
      propagator_.propagate(field, planes_[plane]);
      images.push_back(integrate_pixels(field.leftCols(width), 1));
    }
    return images;
  }

 private:
  std::vector<double> planes_;
  FresnelPropagator<double> propagator_;
  mutable tbb::enumerable_thread_specific<Field<double>> fields_;
};

}  // namespace

std::unique_ptr<const TrueLight> make_true_light(TruthModel model, const Telescope& telescope,
                                                 const SensorDesign& design, int pupil_samples) {
  if (model == TruthModel::extended) {
    return std::make_unique<ExtendedLight>(telescope, design, pupil_samples);
  }
  assert(pupil_samples == design.pupil_samples());
  return std::make_unique<MatchedLight>(telescope, design);
}

}  // namespace nlcwfs
