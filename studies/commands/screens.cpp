// screens: Phase screens as a FITS cube, with their statistics.
#include "model/screen_statistics.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/trials.hpp"

#include <cmath>

namespace nlcwfs {
namespace {

/// Measured and expected structure function along rows, columns and diagonals.
std::string structure_function_table(const std::vector<PhaseScreen>& screens, double pitch,
                                     const Seeing& seeing) {
  CsvTable table({"direction", "separation_m", "structure_function_rad2", "standard_error_rad2",
                  "expected_rad2"});
  struct Direction {
    const char* name;
    int rows;
    int columns;
  };
  const auto samples = static_cast<int>(screens.front().rows());
  for (const Direction& direction :
       {Direction{"row", 0, 1}, {"column", 1, 0}, {"diagonal", 1, 1}, {"antidiagonal", 1, -1}}) {
    for (int step = 1; step < samples; ++step) {
      const MeanAndError measured = structure_function(
          screens, {.rows = step * direction.rows, .columns = step * direction.columns});
      const double separation = step * std::hypot(direction.rows, direction.columns) * pitch;
      table.row()
          .add(direction.name)
          .add(separation)
          .add(measured)
          .add(von_karman_structure_function(separation, seeing));
    }
  }
  return table.text();
}

/// Of the cube of screens.
std::vector<FitsKeyword> keywords_of(const ScreenSource& source, const Telescope& telescope,
                                     const Seeing& seeing, int samples) {
  const double pitch = telescope.diameter / samples;
  std::vector<FitsKeyword> keywords =
      axis_keywords({centred_axis("X", samples, pitch),
                     centred_axis("Y", samples, pitch),
                     {.name = "SCREEN", .description = "counted from 0"}});
  keywords.push_back({"DIAMETER", telescope.diameter, "[m] pupil diameter = width of the square"});
  keywords.push_back({"WAVELEN", telescope.wavelength, "[m] wavelength of the phases"});
  // What made the screens of a file is not known.
  if (source.file.empty()) {
    keywords.push_back({"SEED", source.seed, "seed of the screens"});
    keywords.push_back({"R0", seeing.fried_parameter, "[m] Fried parameter at WAVELEN"});
    if (seeing.outer_scale) keywords.push_back({"L0", *seeing.outer_scale, "[m] outer scale"});
  }
  return keywords;
}

void run_screens(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  const Telescope telescope = telescope_of(configuration);
  const Seeing seeing = seeing_of(configuration, telescope);
  const ScreenSource source(configuration);
  std::vector<std::string> notes;
  // From before the screens, of which those that are drawn are written.
  const InterruptWatch watch;
  std::vector<PhaseScreen> screens = [&] {
    Progress progress("screens", source.count, "screens", "then their statistics");
    return screens_of(source, telescope, seeing, truth_samples(configuration), notes, source.count,
                      [&](int drawn) {
                        progress.advance(drawn);
                        return !InterruptWatch::interrupted();
                      });
  }();
  RunRecord record(request);
  if (source.file.empty() && static_cast<int>(screens.size()) < source.count) {
    record.note_interrupted(
        fmt::format("{} of {} screens were drawn", screens.size(), source.count));
  }

  const auto samples = static_cast<int>(screens.front().rows());
  const PupilMask mask = pupil_mask(samples, telescope.central_obscuration);
  for (PhaseScreen& screen : screens) screen -= piston(screen, mask);
  const MeanAndError variance = piston_removed_variance(screens, mask);
  const MeanAndError tilt_removed = tilt_removed_variance(screens, mask);
  const double expected = noll_piston_removed_variance(telescope.diameter, seeing.fried_parameter);
  const double expected_tilt_removed =
      noll_tilt_removed_variance(telescope.diameter, seeing.fried_parameter);

  const double pitch = telescope.diameter / samples;
  record.folder().write("structure_function.csv", structure_function_table(screens, pitch, seeing));
  const std::size_t count = screens.size();
  write_fits_cube(record.folder().file("screens.fits"), {"rad", std::move(screens)},
                  keywords_of(source, telescope, seeing, samples));
  record.write_summary({{"screens", count},
                        {"samples", samples},
                        {"fried_parameter_m", seeing.fried_parameter},
                        {"piston_removed_variance_rad2", to_json(variance)},
                        {"tilt_removed_variance_rad2", to_json(tilt_removed)},
                        {"kolmogorov_piston_removed_variance_rad2", expected},
                        {"kolmogorov_tilt_removed_variance_rad2", expected_tilt_removed}});

  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n\n{} screen{} of {} x {} samples in screens.fits, rad\n",
             telescope_line(telescope, seeing), count, count == 1 ? "" : "s", samples, samples);
  fmt::print("  {:<34} {:>20} {:>28}\n", "variance over the pupil, rad^2", "these screens",
             "Kolmogorov, clear, no L0");
  fmt::print("  {:<34} {:>20} {:>28.4g}\n", "piston removed", with_error(variance), expected);
  fmt::print("  {:<34} {:>20} {:>28.4g}\n", "piston, tip and tilt removed",
             with_error(tilt_removed), expected_tilt_removed);
  if (count == 1) fmt::print("note: one screen has no standard error\n");
  fmt::print("\n");
  record.close();
}

std::string of_screens(const Json& summary) {
  return fmt::format("{} screens: piston-removed variance {} rad^2, Kolmogorov's {:.4g} rad^2.",
                     integer_from_json(summary.at("screens")),
                     figure_text(summary, "piston_removed_variance_rad2"),
                     number_from_json(summary.at("kolmogorov_piston_removed_variance_rad2")));
}

}  // namespace

Command screens_command() {
  return {.name = "screens",
          .group = "One design",
          .description = "make phase screens: a FITS cube and its statistics",
          .about =
              "Writes the wavefronts that the other commands use as screens.fits, and holds their "
              "variances and structure function against theory.",
          .keys = keys::joined(
              {keys::site, {"screens", "simulation.truth", "simulation.pupil_samples"}}),
          .examples = {"nlcwfs screens --screens.count 100 --seeing.outer_scale 25"},
          .run = run_screens,
          .files = {{"structure_function.csv", FileRole::table}, {"screens.fits", FileRole::image}},
          .verdict = of_screens};
}

}  // namespace nlcwfs
