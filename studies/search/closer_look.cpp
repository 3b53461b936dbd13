// A design is shown on its typical and on its worst wavefront.
#include "studies/search/closer_look.hpp"

#include "results/fits/fits_cube.hpp"
#include "results/pictures/curve_picture.hpp"
#include "results/pictures/design_picture.hpp"
#include "results/pictures/image_picture.hpp"
#include "results/pictures/picture_set.hpp"
#include "results/tables/csv_table.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double nm = 1e-9;

/// A screen that is looked at.
struct ShownScreen {
  std::string name;            ///< "typical"
  const Condition* condition;  ///< of the trial
  SensorDesign design;         ///< as it was simulated there
  int screen;
  ScreenRecord record;

  const Telescope& telescope() const { return condition->simulation->telescope(); }
  double residual_nm() const { return record.performance.wavefront.residual_wfe / nm; }
};

/// The typical one and the worst: indices among all screens of all conditions.
std::pair<std::size_t, std::size_t> chosen_screens(const Performance& performance) {
  std::vector<std::size_t> order(performance.screens.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return performance.screens[i].wavefront.residual_wfe; });
  return {order[(order.size() - 1) / 2], order.back()};
}

ShownScreen shown_screen(const std::string& name, const DesignTrial& trial,
                         const SensorDesign& design, std::size_t index) {
  const auto screens = static_cast<std::size_t>(trial.screen_count());
  const Condition& condition = trial.conditions()[index / screens];
  const auto screen = static_cast<int>(index % screens);
  const Simulation& simulation = *condition.simulation;
  const SensorDesign simulated = simulation.checked(condition.lit(design));
  return {name, &condition, simulated, screen, simulation.record(simulated, screen)};
}

// Files -------------------------------------------------------------------------------------------

void write_cube(const std::string& name, const OutputFolder& folder, const FitsCube& cube,
                const std::vector<FitsKeyword>& keywords) {
  const std::filesystem::path path = folder.file(name);
  std::filesystem::remove(path);  // of a run that was interrupted
  write_fits_cube(path, cube, keywords);
}

std::vector<FitsKeyword> keywords_of(const ShownScreen& shown, Eigen::Index samples, double pitch,
                                     const FitsAxis& slices) {
  std::vector<FitsKeyword> keywords =
      axis_keywords({centred_axis("X", samples, pitch), centred_axis("Y", samples, pitch), slices});
  const ScreenPerformance& performance = shown.record.performance;
  keywords.insert(
      keywords.end(),
      {{"DIAMETER", shown.telescope().diameter, "[m] pupil diameter"},
       {"WAVELEN", shown.telescope().wavelength, "[m] wavelength of the phases"},
       {"R0", shown.condition->fried_parameter, "[m] Fried parameter at WAVELEN"},
       {"PHOTONS", shown.design.detector.photons_per_frame(), "in all planes; 0 = without noise"},
       {"SCREEN", static_cast<std::uint64_t>(shown.screen), "counted from 0"},
       {"RESIDUAL", performance.wavefront.residual_wfe, "[m] residual wavefront error"},
       {"LOOPS", static_cast<std::uint64_t>(performance.loops), "of the reconstruction"}});
  return keywords;
}

void write_images(const ShownScreen& shown, const OutputFolder& folder) {
  const std::vector<Image<double>>& images = shown.record.images;
  std::vector<FitsKeyword> keywords = keywords_of(
      shown, images.front().rows(), shown.telescope().diameter / shown.design.detector.pupil_pixels,
      {.name = "PLANE", .reference_value = 1.0, .description = "in visiting order"});
  for (std::size_t plane = 0; plane < images.size(); ++plane) {
    keywords.push_back({fmt::format("PLANE{}", plane + 1), shown.design.planes[plane],
                        "[m] distance from the pupil"});
  }
  keywords.push_back({"INTUNIT", std::string("unaberrated pupil"), "what has the intensity 1"});
  write_cube(shown.name + "-images.fits", folder, {"1", images}, keywords);
}

void write_phases(const ShownScreen& shown, const OutputFolder& folder) {
  const ScreenRecord& record = shown.record;
  const Eigen::Index samples = record.true_phase.rows();
  std::vector<FitsKeyword> keywords =
      keywords_of(shown, samples, shown.telescope().diameter / double(samples),
                  {.name = "PHASE", .reference_value = 1.0, .description = "see PHASE1 to PHASE3"});
  keywords.push_back({"PHASE1", std::string("true"), ""});
  keywords.push_back({"PHASE2", std::string("reconstructed"), "unwrapped"});
  keywords.push_back({"PHASE3", std::string("residual"), "reconstructed - true"});
  write_cube(shown.name + "-phases.fits", folder,
             {"rad", {record.true_phase, record.reconstructed_phase, record.residual_phase}},
             keywords);
}

std::string loops_table(const ShownScreen& typical, const ShownScreen& worst) {
  CsvTable table({"loop", "typical_residual_wfe_nm", "worst_residual_wfe_nm"});
  const std::vector<double>& of_typical = typical.record.performance.residual_after_loops;
  const std::vector<double>& of_worst = worst.record.performance.residual_after_loops;
  for (std::size_t loop = 0; loop < std::max(of_typical.size(), of_worst.size()); ++loop) {
    table.row().add(double(loop + 1));
    for (const std::vector<double>* residuals : {&of_typical, &of_worst}) {
      // A screen that has stopped has no value any more.
      table.add(loop < residuals->size() ? std::optional((*residuals)[loop] / nm) : std::nullopt);
    }
  }
  return table.text();
}

Json screen_object(const ShownScreen& shown, const DesignTrial& trial) {
  Json object{{"screen", shown.screen},
              {"residual_wfe_nm", shown.residual_nm()},
              {"loops", shown.record.performance.loops}};
  if (trial.conditions().size() > 1) object["condition"] = shown.condition->name;
  return object;
}

// Pictures ----------------------------------------------------------------------------------------

/// "Typical screen: 0.5 m telescope at 532 nm, D/r0 = 4"
std::string title_of(const ShownScreen& shown) {
  const std::string word = shown.name == "typical" ? "Typical" : "Worst";
  return fmt::format(
      "{} screen: {}", word,
      picture_title(shown.telescope(), {.fried_parameter = shown.condition->fried_parameter}));
}

ImagePicture images_picture(const ShownScreen& shown) {
  ImagePicture picture{.title = title_of(shown) + "; intensity in units of the unaberrated pupil's",
                       .axis_unit = "m",
                       .panels = {},
                       .circle = shown.telescope().diameter};
  for (std::size_t plane = 0; plane < shown.record.images.size(); ++plane) {
    picture.panels.push_back(
        {.title = fmt::format("plane {}: {}", plane + 1, format_length(shown.design.planes[plane])),
         .value_label = "intensity",
         .values = shown.record.images[plane],
         .pitch = shown.telescope().diameter / shown.design.detector.pupil_pixels});
  }
  return picture;
}

ImagePicture phases_picture(const ShownScreen& shown) {
  const ScreenRecord& record = shown.record;
  const double pitch = shown.telescope().diameter / double(record.true_phase.rows());
  // In the same colours, so that they can be compared.
  const std::pair<double, double> range{
      std::min(record.true_phase.minCoeff<Eigen::PropagateNumbers>(),
               record.reconstructed_phase.minCoeff<Eigen::PropagateNumbers>()),
      std::max(record.true_phase.maxCoeff<Eigen::PropagateNumbers>(),
               record.reconstructed_phase.maxCoeff<Eigen::PropagateNumbers>())};
  const auto phase = [&](const std::string& title, const Image<double>& values) {
    return ImagePanel{title, "phase, rad", values, pitch, false, range};
  };
  const double nm_per_radian = shown.telescope().wavelength / (2.0 * std::numbers::pi) / nm;
  return {.title = title_of(shown),
          .axis_unit = "m",
          .panels = {phase("true", record.true_phase),
                     phase("reconstructed", record.reconstructed_phase),
                     {.title = fmt::format("residual, RMS {:.3g} nm", shown.residual_nm()),
                      .value_label = "path, nm",
                      .values = nm_per_radian * record.residual_phase,
                      .pitch = pitch,
                      .is_signed = true}}};
}

CurvePicture loops_picture(const ShownScreen& typical, const ShownScreen& worst,
                           const std::string& title) {
  CurvePicture picture{.title = title,
                       .x_label = "loops",
                       .y_label = "residual WFE, nm",
                       .curves = {},
                       .has_log_y = true};
  for (const ShownScreen* shown : {&typical, &worst}) {
    Curve curve{.label = fmt::format("{} screen: {:.3g} nm after {} loops", shown->name,
                                     shown->residual_nm(), shown->record.performance.loops),
                .colour = static_cast<int>(picture.curves.size())};
    for (const double residual : shown->record.performance.residual_after_loops) {
      curve.x.push_back(double(curve.x.size() + 1));
      curve.y.push_back(residual / nm);
    }
    picture.curves.push_back(std::move(curve));
  }
  return picture;
}

}  // namespace

std::vector<RunFile> closer_look_files(bool is_certain) {
  return joined({{{"loops.csv", FileRole::table, is_certain},
                  {"typical-images.fits", FileRole::image, is_certain},
                  {"worst-images.fits", FileRole::image, is_certain},
                  {"typical-phases.fits", FileRole::image, is_certain},
                  {"worst-phases.fits", FileRole::image, is_certain}},
                 picture_files({"design", "loops", "typical-images", "typical-phases",
                                "worst-images", "worst-phases"})});
}

CloserLook look_closer(const DesignTrial& trial, const TriedDesign& tried,
                       const OutputFolder& folder) {
  const auto [median, last] = chosen_screens(pooled(tried.performances));
  const ShownScreen typical = shown_screen("typical", trial, tried.design, median);
  const ShownScreen worst = shown_screen("worst", trial, tried.design, last);
  for (const ShownScreen* shown : {&typical, &worst}) {
    write_images(*shown, folder);
    write_phases(*shown, folder);
  }
  folder.write("loops.csv", loops_table(typical, worst));

  const std::string title =
      picture_title(typical.telescope(), {.fried_parameter = typical.condition->fried_parameter});
  std::vector<PlannedPicture> pictures{{"design",
                                        [&](const auto& stem) {
                                          return write_design_picture(
                                              title, typical.design, typical.telescope(),
                                              typical.condition->fried_parameter, stem);
                                        }},
                                       planned("loops", loops_picture(typical, worst, title))};
  for (const ShownScreen* shown : {&typical, &worst}) {
    pictures.push_back(planned(shown->name + "-images", images_picture(*shown)));
    pictures.push_back(planned(shown->name + "-phases", phases_picture(*shown)));
  }
  return {{{"typical", screen_object(typical, trial)}, {"worst", screen_object(worst, trial)}},
          draw_pictures(pictures, folder)};
}

}  // namespace nlcwfs
