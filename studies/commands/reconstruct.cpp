// reconstruct: The wavefronts of measured detector frames, and how well what they predict agrees
// with the frames.
#include "results/tables/design_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/commands/reconstruct_files.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/setup.hpp"

namespace nlcwfs {
namespace {

/// Bounds of the misfit. Frames of the program's own simulation leave 0.01 to 0.06 where all is
/// right (the reconstruction's own grid and pixels), 0.1 to 0.2 with all distances 5 % off, one of
/// them 10 %, or one near plane's centre two pixels, and 0.3 to 2 with planes out of order or a
/// pair's signs swapped.
constexpr double good_misfit = 0.1;
constexpr double poor_misfit = 0.3;

double rms_nm_of(const SetResult& set) { return 1e9 * set.wavefront_rms; }
double loops_of(const SetResult& set) { return double(set.frames.reconstruction.loops); }

std::ptrdiff_t unconverged_sets(const FrameRun& run) {
  return std::ranges::count_if(
      run.sets, [](const SetResult& set) { return !set.frames.reconstruction.converged; });
}

std::size_t worst_plane(const std::vector<PlaneMeans>& planes) {
  const auto worst = std::ranges::max_element(
      planes, {}, [](const PlaneMeans& plane) { return plane.misfit.mean; });
  return static_cast<std::size_t>(worst - planes.begin());
}

/// Whether measured and predicted images agree, and why.
struct Judgement {
  std::string_view verdict;
  std::string reason;
  std::string advice = {};  ///< lines on what to do
};

/// @pre a plane has the largest misfit
Judgement judgement_of_misfit(const FrameRun& run, const PlaneMeans& plane, std::size_t number) {
  const double misfit = plane.misfit.mean;
  Judgement judgement{
      misfit > poor_misfit ? "disagree" : "agree in part",
      fmt::format(
          "plane {} differs by {:.0f} %{}", number, 100.0 * plane.relative_rms.mean,
          plane.noise ? fmt::format(", noise alone by {:.0f} %", 100.0 * plane.noise->mean) : "")};
  if (plane.correlation && plane.correlation->mean > 0.99 && !run.measured.throughputs.empty()) {
    judgement.advice =
        "  Its pattern is right, its brightness is not: leave frames.flux away, then each "
        "plane's light is found.\n";
    return judgement;
  }
  judgement.advice =
      misfit > poor_misfit
          ? "  Check the signs and the order of sensor.planes against the frames, "
            "frames.background,\n  detector.pupil_pixels, telescope.diameter and "
            "telescope.wavelength.\n"
          : "  Check the distances in sensor.planes, frames.centre, frames.background and "
            "detector.pupil_pixels.\n";
  if (!plane.noise) {
    judgement.advice +=
        "  If little light is the reason, set detector.photons: then noise is allowed for.\n";
  }
  return judgement;
}

Judgement judgement_of(const FrameRun& run, const std::vector<PlaneMeans>& planes) {
  const auto number_of = [&](auto plane) { return plane - planes.begin() + 1; };
  const auto lifted = std::ranges::max_element(planes, {}, [](const PlaneMeans& plane) {
    return plane.has_background() ? std::abs(plane.background_share) : 0.0;
  });
  if (lifted->has_background()) {
    return {"disagree",
            fmt::format("plane {} has {} {}in each pixel where no light falls, {:.3g} % of its "
                        "light",
                        number_of(lifted),
                        with_error({lifted->background->level, lifted->background->error}),
                        run.measured.unit.empty() ? "" : run.measured.unit + ' ',
                        100.0 * lifted->background_share),
            "  The phase has explained it by aberrations of its own making: subtract it too, by "
            "frames.background.\n"};
  }
  const std::size_t worst = worst_plane(planes);
  if (planes[worst].misfit.mean > poor_misfit) {
    return judgement_of_misfit(run, planes[worst], worst + 1);
  }
  if (const auto mute = std::ranges::find_if(planes, &PlaneMeans::is_mute); mute != planes.end()) {
    return {"tell too little",
            fmt::format("plane {} was measured where {:.0f} % of its light falls{}",
                        number_of(mute), 100.0 * mute->measured_share,
                        mute->correlation ? "" : ", or is the same everywhere"),
            "  Check frames.bad_pixels, frames.saturation and the frames themselves.\n"};
  }
  if (planes[worst].misfit.mean > good_misfit) {
    return judgement_of_misfit(run, planes[worst], worst + 1);
  }
  const auto unconverged = unconverged_sets(run);
  if (unconverged > 0) {
    return {"agree in part",
            fmt::format("{} of {} had not converged", unconverged, run.sets.size()),
            "  Raise reconstruction.max_loops, or try reconstruction.relaxation.\n"};
  }
  return {"agree",
          fmt::format("plane {} differs most, by {:.1f} %{}", worst + 1,
                      100.0 * planes[worst].relative_rms.mean,
                      planes[worst].noise ? ", as its noise lets expect" : ""),
          "(They would if every sign of sensor.planes were wrong: then the phase has the wrong "
          "sign.)\n"};
}

Json summary_of(const FrameRun& run, double fried_parameter, const std::vector<PlaneMeans>& planes,
                const Judgement& judgement) {
  Json sets = Json::array();
  for (const SetResult& set : run.sets) {
    const Reconstruction& reconstruction = set.frames.reconstruction;
    sets.push_back({{"converged", reconstruction.converged},
                    {"loops", reconstruction.loops},
                    {"fractional_loops", reconstruction.fractional_loops},
                    {"passes", set.frames.passes},
                    {"wavefront_rms_nm", 1e9 * set.wavefront_rms}});
  }
  Json plane_objects = Json::array();
  for (const PlaneMeans& plane : planes) {
    plane_objects.push_back(
        {{"relative_rms", to_json(plane.relative_rms)},
         {"noise_relative_rms", plane.noise ? to_json(*plane.noise) : Json(nullptr)},
         {"misfit", to_json(plane.misfit)},
         {"correlation", plane.correlation ? to_json(*plane.correlation) : Json(nullptr)},
         {"background",
          plane.background ? to_json(MeanAndError{plane.background->level, plane.background->error})
                           : Json(nullptr)},
         {"background_share", plane.background ? Json(plane.background_share) : Json(nullptr)},
         {"measured_share", plane.measured_share},
         {"light_share", to_json(plane.light_share)},
         {"captured_energy", to_json(plane.captured_energy)},
         {"displacement_x_pixels", to_json(plane.x)},
         {"displacement_y_pixels", to_json(plane.y)}});
  }
  const std::size_t worst = worst_plane(planes);
  const auto converged = [](const SetResult& set) {
    return set.frames.reconstruction.converged ? 1.0 : 0.0;
  };
  return {{"design", to_json(run.design, run.telescope, fried_parameter)},
          {"frames",
           {{"sets", run.sets.size()},
            {"planes", run.design.planes.size()},
            {"width_pixels", run.measured.width()},
            {"unit", run.measured.unit}}},
          {"loops", to_json(mean_over_sets(run, loops_of))},
          {"converged_fraction", mean_over_sets(run, converged).mean},
          {"wavefront_rms_nm", to_json(mean_over_sets(run, rms_nm_of))},
          {"consistency",
           {{"verdict", judgement.verdict},
            {"reason", judgement.reason},
            {"worst_plane", worst + 1},
            {"misfit", planes[worst].misfit.mean},
            {"planes", plane_objects}}},
          {"sets", sets}};
}

std::string planes_text(const FrameRun& run, const std::vector<PlaneMeans>& planes) {
  std::string text = fmt::format("{:>8}  {:>11}  {:>13}  {:>11}  {:>11}  {:>9}  {:>9}  {:>14}\n",
                                 "visited", "distance", "meas. - pred.", "noise alone",
                                 "correlation", "its light", "captured", "stands off, px");
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneMeans& plane = planes[i];
    text +=
        fmt::format("{:>8}  {:>11}  {:>11.1f} %  {:>11}  {:>11}  {:>7.1f} %  {:>7.1f} %  {:>14}\n",
                    i + 1, format_length(run.design.planes[i]), 100.0 * plane.relative_rms.mean,
                    plane.noise ? fmt::format("{:.1f} %", 100.0 * plane.noise->mean) : "not known",
                    plane.correlation ? fmt::format("{:.4f}", plane.correlation->mean) : "none",
                    100.0 * plane.light_share.mean, 100.0 * plane.captured_energy.mean,
                    fmt::format("{:.2f}, {:.2f}", plane.x.mean, plane.y.mean));
  }
  return text;
}

std::string sets_text(const FrameRun& run) {
  std::string text;
  const auto unconverged = unconverged_sets(run);
  if (run.sets.size() == 1) {
    const SetResult& set = run.sets.front();
    text = fmt::format("wavefront RMS {:.4g} nm after {} loops\n", 1e9 * set.wavefront_rms,
                       set.frames.reconstruction.loops);
  } else {
    text = fmt::format("{} sets: wavefront RMS {} nm after {} loops\n", run.sets.size(),
                       with_error(mean_over_sets(run, rms_nm_of)),
                       with_error(mean_over_sets(run, loops_of)));
  }
  if (unconverged > 0) {
    text += fmt::format("{} of {} had not converged in reconstruction.max_loops = {} loops\n",
                        unconverged, run.sets.size(), run.design.reconstruction.max_loops);
  }
  return text;
}

void run_reconstruct(const Request& request) {
  Request completed = request;
  Configuration& configuration = completed.configuration;
  require_one_condition(configuration);
  const Telescope telescope = telescope_of(configuration);
  const Seeing seeing = seeing_of(configuration, telescope);
  const MeasuredFrames measured = measured_frames_of(configuration);
  set_detector_window(configuration, measured);
  const SensorDesign design = design_of(configuration);
  design.validate(telescope);
  const GerchbergSaxton<double> reconstructor(telescope, design, measured.axes);
  RunRecord record(completed);

  const std::vector<SetResult> sets = reconstruct_sets(reconstructor, design, telescope, measured);
  if (sets.size() < measured.sets.size()) {
    record.note_interrupted(
        fmt::format("the first {} of {} sets are done", sets.size(), measured.sets.size()));
  }

  const FrameRun run{telescope, design, measured, sets};
  const std::vector<PlaneMeans> planes = plane_means(run);
  const std::vector<std::string> notes = write_frame_files(run, record.folder());
  const Judgement judgement = judgement_of(run, planes);
  record.write_summary(summary_of(run, seeing.fried_parameter, planes, judgement));

  for (const std::string& note : notes) record.print("note: {}\n", note);
  // Frames are reconstructed without a seeing; it is only the unit of distances.
  record.print("{}\n\n", is_seeing_given(configuration)
                             ? telescope_line(telescope, seeing)
                             : fmt::format("{:g} m telescope at {}", telescope.diameter,
                                           format_length(telescope.wavelength)));
  record.print("{} of {} x {} pixels in {} planes, {}", configuration.text("frames.file"),
               measured.width(), measured.width(), design.planes.size(), sets_text(run));
  record.print("\n{}\nMeasured and predicted images {}: {}.\n{}", planes_text(run, planes),
               judgement.verdict, judgement.reason, judgement.advice);
  record.print("\n");
  record.close();
}

std::string of_reconstruct(const Json& summary) {
  const Json& consistency = summary.at("consistency");
  return fmt::format(
      "A wavefront of {} nm RMS after {} loops. Measured and predicted images {}: {}.",
      figure_text(summary, "wavefront_rms_nm"), figure_text(summary, "loops"),
      consistency.at("verdict").get<std::string>(), consistency.at("reason").get<std::string>());
}

}  // namespace

Command reconstruct_command() {
  return {.name = "reconstruct",
          .group = "One design",
          .description =
              "reconstruct the wavefronts of measured detector frames, and say whether they agree",
          .about =
              "Calibrates the frames of the section frames, runs the loop of the section "
              "reconstruction on them, and writes the phases as phase.fits, which can be the "
              "screens.file of the other commands. What the phases predict for each plane is "
              "held against what was measured there.",
          .keys = keys::joined({keys::site, {"frames", "sensor", "detector", "reconstruction"}}),
          .examples = {"nlcwfs reconstruct --frames frames.fits "
                       "--sensor.planes=-120km,120km,-30km,30km --frames.background dark.fits"},
          .run = run_reconstruct,
          .options = {{.name = "frames",
                       .value_name = "FILE",
                       .description = "read the measured frames of this FITS file, as frames.file",
                       .key = "frames.file"}},
          .files = frame_files(),
          .verdict = of_reconstruct,
          .is_of_one_seeing = false};
}

}  // namespace nlcwfs
