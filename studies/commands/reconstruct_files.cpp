// What reconstruct writes: phases, frames, predictions, pictures.
#include "studies/commands/reconstruct_files.hpp"

#include "results/fits/fits_cube.hpp"
#include "results/pictures/image_picture.hpp"
#include "results/pictures/picture_set.hpp"
#include "results/tables/csv_table.hpp"
#include "results/text/quantity_text.hpp"

#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::vector<FitsKeyword> keywords_of(const FrameRun& run, const std::vector<FitsAxis>& axes) {
  std::vector<FitsKeyword> keywords = axis_keywords(axes);
  keywords.push_back({"DIAMETER", run.telescope.diameter, "[m] pupil diameter"});
  keywords.push_back({"WAVELEN", run.telescope.wavelength, "[m] wavelength of the light"});
  return keywords;
}

void write_phases(const FrameRun& run, const OutputFolder& folder) {
  FitsCube cube{.unit = "rad", .slices = {}};
  for (const SetResult& set : run.sets) cube.slices.push_back(set.phase);
  const Eigen::Index samples = cube.slices.front().rows();
  const double pitch = run.telescope.diameter / double(samples);
  write_fits_cube(
      folder.file("phase.fits"), cube,
      keywords_of(run, {centred_axis("X", samples, pitch),
                        centred_axis("Y", samples, pitch),
                        {.name = "SET", .reference_value = 1.0, .description = "of frames"}}));
}

/// @param images  of a set: one per plane
void write_images(const std::string& name, const FrameRun& run, const OutputFolder& folder,
                  std::vector<Image<double>> FrameReconstruction::*images) {
  FitsCube cube{.unit = "1", .slices = {}, .sets = run.sets.size()};
  for (const SetResult& set : run.sets) {
    const std::vector<Image<double>>& planes = set.frames.*images;
    cube.slices.insert(cube.slices.end(), planes.begin(), planes.end());
  }
  const double pitch = run.telescope.diameter / run.design.detector.pupil_pixels;
  const std::string axis_comment = "[m] the optical axis in this plane's frame";
  std::vector<FitsAxis> axes{
      centred_axis("X", run.measured.width(), pitch),
      centred_axis("Y", run.measured.width(), pitch),
      {.name = "PLANE", .reference_value = 1.0, .description = "in visiting order"}};
  if (cube.sets > 1) {
    axes.push_back({.name = "SET", .reference_value = 1.0, .description = "of frames"});
  }
  std::vector<FitsKeyword> keywords = keywords_of(run, axes);
  for (std::size_t plane = 0; plane < run.design.planes.size(); ++plane) {
    keywords.push_back({fmt::format("PLANE{}", plane + 1), run.design.planes[plane],
                        "[m] distance from the pupil"});
    const auto& axis = run.measured.axes[plane];
    keywords.push_back({fmt::format("AXISX{}", plane + 1), axis.x() * pitch, axis_comment});
    keywords.push_back({fmt::format("AXISY{}", plane + 1), axis.y() * pitch, axis_comment});
  }
  keywords.push_back({"INTUNIT", std::string("unaberrated pupil"), "what has the intensity 1"});
  write_fits_cube(folder.file(name), cube, keywords);
}

std::string consistency_table(const FrameRun& run) {
  CsvTable table({"set", "plane", "distance_m", "relative_rms", "noise_relative_rms", "misfit",
                  "correlation", "flux", "captured_energy", "displacement_x_pixels",
                  "displacement_y_pixels", "centre_x_pixels", "centre_y_pixels", "bad_pixels",
                  "background", "background_error"});
  for (std::size_t set = 0; set < run.sets.size(); ++set) {
    const SetResult& result = run.sets[set];
    for (std::size_t plane = 0; plane < run.design.planes.size(); ++plane) {
      const PlaneConsistency& consistency = result.frames.planes[plane];
      const auto& background = result.background[plane];
      const double middle = 0.5 * double(run.measured.width() + 1);
      table.row()
          .add(double(set + 1))
          .add(double(plane + 1))
          .add(run.design.planes[plane])
          .add(consistency.relative_rms)
          .add(result.noise.empty() ? std::nullopt : std::optional(result.noise[plane]))
          .add(result.misfit[plane])
          .add(consistency.correlation)
          .add(consistency.light)
          .add(consistency.captured_energy)
          .add(consistency.displacement.x())
          .add(consistency.displacement.y())
          .add(run.measured.axes[plane].x() + middle)
          .add(run.measured.axes[plane].y() + middle)
          .add(double(run.measured.width() * run.measured.width() - consistency.measured_pixels))
          .add(background ? std::optional(background->level) : std::nullopt)
          .add(background ? std::optional(background->error) : std::nullopt);
    }
  }
  return table.text();
}

/// "Set 1 of 3: 0.5 m telescope at 532 nm"; the first set stands for all.
std::string title_of(const FrameRun& run) {
  const std::string telescope = fmt::format("{:g} m telescope at {}", run.telescope.diameter,
                                            format_length(run.telescope.wavelength));
  return run.sets.size() == 1 ? telescope
                              : fmt::format("Set 1 of {}: {}", run.sets.size(), telescope);
}

ImagePicture phase_picture(const FrameRun& run) {
  const SetResult& set = run.sets.front();
  return {.title = title_of(run),
          .axis_unit = "m",
          .panels = {
              {.title = fmt::format("reconstructed phase, RMS {:.4g} nm", 1e9 * set.wavefront_rms),
               .value_label = "phase, rad",
               .values = set.phase,
               .pitch = run.telescope.diameter / double(set.phase.rows()),
               .is_signed = true}}};
}

/// Measured, predicted and their difference, a row for each plane.
ImagePicture images_picture(const FrameRun& run) {
  const FrameReconstruction& frames = run.sets.front().frames;
  ImagePicture picture{.title = title_of(run), .axis_unit = "m", .panels = {}};
  const double pitch = run.telescope.diameter / run.design.detector.pupil_pixels;
  for (std::size_t plane = 0; plane < run.design.planes.size(); ++plane) {
    const std::string name =
        fmt::format("plane {}, {}", plane + 1, format_length(run.design.planes[plane]));
    const Image<double>& measured = frames.measured[plane];
    const Image<double>& predicted = frames.predicted[plane];
    const double brightest =
        std::max(measured.maxCoeff<Eigen::PropagateNumbers>(), predicted.maxCoeff());
    const auto add = [&](const std::string& title, const Image<double>& values, bool is_signed) {
      picture.panels.push_back({title, "over the pupil's", values, pitch, is_signed, {}});
      if (!is_signed) picture.panels.back().range = {0.0, brightest};
    };
    add(name + ": measured", measured, false);
    add("predicted", predicted, false);
    add(fmt::format("difference, {:.1f} % RMS", 100.0 * frames.planes[plane].relative_rms),
        measured - predicted, true);
  }
  return picture;
}

}  // namespace

std::vector<RunFile> frame_files() {
  return joined({{{"consistency.csv", FileRole::table},
                  {"phase.fits", FileRole::image},
                  {"frames.fits", FileRole::image},
                  {"predicted.fits", FileRole::image}},
                 picture_files({"phase", "frames"})});
}

std::vector<std::string> write_frame_files(const FrameRun& run, const OutputFolder& folder) {
  write_phases(run, folder);
  write_images("frames.fits", run, folder, &FrameReconstruction::measured);
  write_images("predicted.fits", run, folder, &FrameReconstruction::predicted);
  folder.write("consistency.csv", consistency_table(run));
  return draw_pictures(
      {planned("phase", phase_picture(run)), planned("frames", images_picture(run))}, folder);
}

}  // namespace nlcwfs
