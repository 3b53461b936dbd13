#include "model/true_light.hpp"

#include "model/fresnel_propagator.hpp"
#include "model/grid_width.hpp"
#include "model/wrap_free_propagator.hpp"

#include <cassert>

namespace nlcwfs {
namespace {

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
    fields.reserve(transfer_functions_.size());
    for (const LineFactors<double>& transfer : transfer_functions_) {
      fields.push_back(propagator_.field(spectrum, transfer));
    }
    return fields;
  }

 private:
  WrapFreePropagator propagator_;
  std::vector<LineFactors<double>> transfer_functions_;
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
