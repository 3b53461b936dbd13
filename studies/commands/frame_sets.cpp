// Sets of measured frames are reconstructed.
#include "studies/commands/frame_sets.hpp"

#include "studies/run/interrupt.hpp"
#include "studies/run/progress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

namespace nlcwfs {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

/// The planes' shares of the light that reached the detectors.
double light_share(const FrameReconstruction& frames, std::size_t plane) {
  double sum = 0.0;
  for (const PlaneConsistency& other : frames.planes) sum += other.light;
  return frames.planes[plane].light / sum;
}

/// How much of a disagreement noise cannot explain. The reconstructed field has followed the noise
/// of its images too, so that they differ from their prediction by up to 1.4 times their noise
/// (measured on one frame of the default design with 1e5 to 1e7 photons); half as much again is
/// left to it.
double misfit_beyond(double relative_rms, double noise) {
  constexpr double allowance = 1.5;
  return std::sqrt(
      std::max(0.0, relative_rms * relative_rms - allowance * allowance * noise * noise));
}

SetResult reconstruct_set(const GerchbergSaxton<double>& reconstructor, const SensorDesign& design,
                          const Telescope& telescope, const MeasuredFrames& measured,
                          std::size_t set) {
  SetResult result;
  result.frames = reconstruct_frames(reconstructor, measured.sets[set], measured.throughputs);
  const Field<double>& pupil = result.frames.reconstruction.pupil_field;
  const PupilMask& mask = reconstructor.mask();
  const Image<double> phase = reconstructor.unwrapper().unwrap(pupil);
  const double piston = mask.select(phase, 0.0).sum() / double(mask.count());
  result.phase = mask.select(phase - piston, unmeasured);
  result.wavefront_rms =
      piston_free_rms(phase, mask) * telescope.wavelength / (2.0 * std::numbers::pi);
  const double photons = design.detector.photons_per_frame();
  for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
    const PlaneConsistency& consistency = result.frames.planes[plane];
    result.background.push_back(frame_background(
        measured.sets[set][plane], design.detector.pupil_pixels, measured.axes[plane]));
    const auto& background = result.background.back();
    double noise = 0.0;
    if (photons > 0.0) {
      // The noise of the light alone.
      const double level =
          background && background->is_significant()
              ? background->level * reconstructor.pupil_energy() / consistency.light
              : 0.0;
      const Image<double> predicted = result.frames.measured[plane].isNaN().select(
          unmeasured, (result.frames.predicted[plane] - level).max(0.0));
      noise = relative_noise(
          predicted, photons * light_share(result.frames, plane) / reconstructor.pupil_energy(),
          design.detector.read_noise);
      result.noise.push_back(noise);
    }
    result.misfit.push_back(misfit_beyond(consistency.relative_rms, noise));
  }
  return result;
}

void add_what_may_be_missing(PlaneMeans& means, const FrameRun& run, std::size_t plane) {
  const auto all_have = [&](const auto& has) { return std::ranges::all_of(run.sets, has); };
  for (const SetResult& set : run.sets) {
    means.measured_share = std::min(means.measured_share, set.frames.planes[plane].measured_share);
  }
  if (all_have(
          [&](const SetResult& set) { return set.frames.planes[plane].correlation.has_value(); })) {
    means.correlation = mean_over_sets(
        run, [&](const SetResult& set) { return *set.frames.planes[plane].correlation; });
  }
  if (!all_have([&](const SetResult& set) { return set.background[plane].has_value(); })) return;
  const auto mean_of = [&](double FrameBackground::*figure) {
    return mean_over_sets(run,
                          [&](const SetResult& set) { return (*set.background[plane]).*figure; })
        .mean;
  };
  means.background =
      FrameBackground{mean_of(&FrameBackground::level), mean_of(&FrameBackground::error)};
  const double light = mean_over_sets(run, [&](const SetResult& set) {
                         return set.frames.planes[plane].light;
                       }).mean;
  const double width = double(run.measured.width());
  means.background_share = means.background->level * width * width / light;
}

}  // namespace

std::vector<SetResult> reconstruct_sets(const GerchbergSaxton<double>& reconstructor,
                                        const SensorDesign& design, const Telescope& telescope,
                                        const MeasuredFrames& measured) {
  std::vector<std::optional<SetResult>> sets(measured.sets.size());
  Progress progress("reconstruct", double(sets.size()), "sets");
  // One set at a time: they take different numbers of loops.
  tbb::parallel_for(
      std::size_t{0}, sets.size(),
      [&](std::size_t set) {
        if (set > 0 && InterruptWatch::interrupted()) return;
        sets[set] = reconstruct_set(reconstructor, design, telescope, measured, set);
        progress.advance();
      },
      tbb::simple_partitioner());
  std::vector<SetResult> done;
  for (std::optional<SetResult>& set : sets) {
    if (!set) break;
    done.push_back(std::move(*set));
  }
  return done;
}

std::vector<PlaneMeans> plane_means(const FrameRun& run) {
  std::vector<PlaneMeans> planes;
  for (std::size_t plane = 0; plane < run.design.planes.size(); ++plane) {
    const auto mean_of = [&](const auto& metric) {
      return mean_over_sets(
          run, [&](const SetResult& set) { return std::invoke(metric, set.frames.planes[plane]); });
    };
    PlaneMeans means{
        .relative_rms = mean_of(&PlaneConsistency::relative_rms),
        .noise = {},
        .misfit = mean_over_sets(run, [&](const SetResult& set) { return set.misfit[plane]; }),
        .correlation = {},
        .light_share = mean_over_sets(
            run, [&](const SetResult& set) { return light_share(set.frames, plane); }),
        .captured_energy = mean_of(&PlaneConsistency::captured_energy),
        .x = mean_of([](const PlaneConsistency& of) { return of.displacement.x(); }),
        .y = mean_of([](const PlaneConsistency& of) { return of.displacement.y(); }),
        .measured_share = 1.0,
        .background = {}};
    if (!run.sets.front().noise.empty()) {
      means.noise = mean_over_sets(run, [&](const SetResult& set) { return set.noise[plane]; });
    }
    add_what_may_be_missing(means, run, plane);
    planes.push_back(means);
  }
  return planes;
}

}  // namespace nlcwfs
