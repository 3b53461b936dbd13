#include "studies/reproduction/report.hpp"

#include "model/telescope.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/pictures/curve_picture.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/text/design_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double km = 1e3;

std::string_view title_of(StudySetup setup) {
  return setup == StudySetup::paper ? "the paper's set-up" : "extended truth, rule difference";
}

/// A quantity over the distances of two pairs of planes; NaN where there is no design.
struct DistanceMap {
  std::string label;  ///< ends with the unit
  std::string unit;   ///< as FITS has it
  const PlaneMap& places;
  Image<double> values;  ///< rows: near, columns: far
};

/// @param figure  as the grid of a sweep's summary names it
/// @param scale   what its values are multiplied by
DistanceMap distance_map(const PlaneMap& map, const char* figure, double scale,
                         const std::string& label, const std::string& unit) {
  Image<double> values(map.near().size(), map.far().size());
  for (std::size_t near = 0; near < map.near().size(); ++near) {
    for (std::size_t far = 0; far < map.far().size(); ++far) {
      values(Eigen::Index(near), Eigen::Index(far)) = scale * map.value(figure, near, far);
    }
  }
  return {label, unit, map, std::move(values)};
}

/// As the paper draws it: Z_far to the right, Z_near upwards, with the Talbot distance of r0 on
/// both.
std::optional<std::string> draw_map(const DistanceMap& map, int ratio, const std::string& title,
                                    const std::filesystem::path& stem) {
  MapPicture picture{.title = title,
                     .x = {.label = "Z_far, km", .values = {}},
                     .y = {.label = "Z_near, km", .values = {}},
                     .value_label = map.label,
                     .values = {}};
  for (const double far : map.places.far()) picture.x.values.push_back(far / km);
  for (const double near : map.places.near()) picture.y.values.push_back(near / km);
  for (const auto far : map.values.colwise()) {
    picture.values.emplace_back(far.begin(), far.end());
  }
  const Telescope telescope;
  const double talbot = talbot_distance(telescope.diameter / ratio, telescope.wavelength) / km;
  const double last = picture.x.values.back();
  picture.overlay.curves = {{"Z_near = Z_T(r0)", {{0.0, talbot}, {last, talbot}}},
                            {"Z_far = Z_T(r0)", {{talbot, 0.0}, {talbot, last}}}};
  return write_picture(picture, stem);
}

/// As a FITS image: Z_far along axis 1, Z_near along axis 2.
void write_map(const DistanceMap& map, const std::filesystem::path& path) {
  std::filesystem::remove(path);  // of a report that was interrupted
  const std::string description = "distance of a pair";
  write_fits_map(path, {.unit = map.unit,
                        .x = {"Z_FAR", "m", map.places.far(), {}, description},
                        .y = {"Z_NEAR", "m", map.places.near(), {}, description},
                        .values = map.values});
}

/// What the maps hold, with standard errors, one line for each design.
std::string map_table(const PlaneMap& map) {
  CsvTable table({"z_near_m", "z_far_m", "residual_wfe_nm", "residual_wfe_standard_error_nm",
                  "loops", "loops_standard_error"});
  for (std::size_t near = 0; near < map.near().size(); ++near) {
    for (std::size_t far = 0; far < map.far().size(); ++far) {
      const MeanAndError residual = map.mean("residual_wfe_nm", near, far);
      const MeanAndError loops = map.mean("loops", near, far);
      if (!std::isfinite(residual.mean)) continue;
      table.row()
          .add(map.near()[near])
          .add(map.far()[far])
          .add(residual.mean)
          .add(residual.standard_error)
          .add(loops.mean)
          .add(loops.standard_error);
    }
  }
  return table.text();
}

/// Lines of a Markdown table.
std::string table_row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}
std::string table_head(const std::vector<std::string>& cells) {
  return table_row(cells) + table_row(std::vector<std::string>(cells.size(), "---"));
}

// The report --------------------------------------------------------------------------------------

class Report {
 public:
  Report(const OutputFolder& folder, const ReproducedRuns& runs, const std::vector<Claim>& claims,
         int screens)
      : folder_(folder), runs_(runs), claims_(claims), screens_(screens) {}

  const std::vector<std::string>& notes() const { return notes_; }

  void write() const { folder_.write("report.md", text_); }

  void add_introduction() {
    text_ += fmt::format(
        "# Letchev, Crass, Crepp & Potier 2022, claim by claim\n\n"
        "Made by `nlcwfs reproduce` on {} wavefronts; the designs at the paper's distances on {}.\n"
        "Of {} claims, in the paper's set-up {}; with an extended truth {}.\n\n"
        "Telescope, planes, sampling, tolerance (1 nm) and 20 loops at most are the paper's. Two "
        "set-ups are compared:\n\n"
        "- *The paper's set-up*: the data are made on the reconstruction's own periodic grid of 4 "
        "pupil diameters, the aberration is the same phase at every wavelength, and the loop stops "
        "where the *RMS of the wavefront* changes by less than the tolerance (`rms_change`). The "
        "paper's text (section 2.3) speaks of the RMS of the *difference*; with that rule its "
        "numbers do not come out, with this one most do: see the numerics at the end.\n"
        "- *Extended truth, rule difference*: the light is propagated without an edge, from a "
        "pupil "
        "sampled twice as finely as the detector (at figures 6 and 8 as finely: 128), the detector "
        "is 4 diameters wide, the aberration is the same path at every wavelength, and the loop "
        "stops where the RMS of the phase's difference falls below the tolerance.\n\n"
        "The wavefronts at all D/r0 are the same ones at other strengths, which makes differences "
        "clearer; the paper has a series for each. Z_T is the Talbot distance 2 r0^2 / lambda, S_F "
        "the field-estimated Strehl ratio; *recommended designs* have Z_near within a factor 1.5 "
        "of "
        "Z_T and Z_far from 150 km on. `a +- b` is a mean with its standard error, `a (b to c)` a "
        "median with what eight tenths are within. Maps are searched in single precision, all else "
        "is in double.\n\n",
        screens_, more_screens * screens_, claims_.size(), count_text(claims_, StudySetup::paper),
        count_text(claims_, StudySetup::extended));
  }

  void add_heading(const std::string& heading, const std::string& text) {
    text_ += fmt::format("## {}\n\n{}\n\n", heading, text);
  }

  /// The claims that a figure's runs check.
  void add_claims(const std::string& figure) {
    text_ += table_head({"the paper says", "its number", std::string(title_of(StudySetup::paper)),
                         std::string(title_of(StudySetup::extended)), "counts as reproduced"});
    for (const Claim& claim : claims_) {
      if (claim.figure != figure) continue;
      std::vector<std::string> cells{claim.sentence, claim.papers};
      for (const StudySetup setup : setups) {
        const ClaimFinding& finding = claim.findings.at(setup);
        cells.push_back(fmt::format("**{}**: {}. *{}*", to_string(finding.verdict), finding.number,
                                    finding.why));
      }
      cells.push_back(claim.rule);
      text_ += table_row(cells);
    }
    text_ += '\n';
  }

  /// The maps of four planes, as the paper's figure 3 has them: D/r0 to the right.
  void add_four_plane_maps(StudySetup setup) {
    std::vector<std::vector<std::string>> rows(2);
    std::vector<std::string> heads;
    for (const int ratio : map_ratios) {
      heads.push_back(fmt::format("D/r0 = {}", ratio));
      const std::string title = fmt::format("Four planes, D/r0 = {}, {}", ratio, title_of(setup));
      const auto shown =
          draw_maps(fmt::format("figure-3/{}-{}", to_string(setup), ratio), ratio, title);
      for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(shown[row]);
    }
    add_pictures(setup, heads, rows);
  }

  /// Those of three and four planes, with the time as the paper has it: the loops, by the time that
  /// one takes.
  void add_plane_count_maps(StudySetup setup) {
    struct Column {
      const char* head;
      std::string run;
      std::string design;
    };
    const std::string_view name = to_string(setup);
    const std::vector<Column> columns{
        {"without P3", fmt::format("figure-4/{}-without-p3", name), "without-p3"},
        {"without P1", fmt::format("figure-4/{}-without-p1", name), "without-p1"},
        {"four planes", fmt::format("figure-3/{}-4", name), "four-planes"}};
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows(3);
    for (const Column& column : columns) {
      const Json& performance = runs_.summary(fmt::format("designs/{}-{}", name, column.design))
                                    .at("design")
                                    .at("performance");
      const double milliseconds = 1e3 * mean_from_json(performance.at("seconds")).mean /
                                  mean_from_json(performance.at("loops")).mean;
      heads.push_back(fmt::format("{}, {:.3g} ms a loop", column.head, milliseconds));
      const std::string title = fmt::format("{}, D/r0 = 4, {}", column.head, title_of(setup));
      const auto shown = draw_maps(column.run, 4, title);
      for (std::size_t row = 0; row < shown.size(); ++row) rows[row].push_back(shown[row]);
      const PlaneMap map(runs_.summary(column.run).at("grid"));
      rows[2].push_back(draw(distance_map(map, "loops", milliseconds, "approximate time, ms", "ms"),
                             4, title, fmt::format("figure-4-{}-{}-time", name, column.design)));
    }
    add_pictures(setup, heads, rows);
  }

  void add_fifth_plane(StudySetup setup) {
    const Json& grid = runs_.summary(fmt::format("figure-5/{}", to_string(setup))).at("grid");
    const Json& four = runs_.summary(fmt::format("designs/{}-four-planes", to_string(setup)))
                           .at("design")
                           .at("performance");
    const Json& axes = grid.at("axes");
    const auto fifth =
        std::ranges::find_if(axes, [](const Json& axis) { return axis.at("name") == "z5"; });
    const std::vector<double> distances = numbers_from_json(fifth->at("values"));
    CsvTable table({"z5_m", "residual_wfe_nm", "residual_wfe_standard_error_nm", "loops",
                    "loops_standard_error"});
    std::vector<std::string> shown;
    const auto add = [&](const char* figure, const char* label, const std::string& name) {
      Curve five{.label = "five planes",
                 .spread = numbers_from_json(grid.at("standard_error").at(figure))};
      for (const double distance : distances) five.x.push_back(distance / km);
      five.y = numbers_from_json(grid.at(figure));
      const double of_four = mean_from_json(four.at(figure)).mean;
      shown.push_back(draw({.title = fmt::format("Fifth plane, {}", title_of(setup)),
                            .x_label = "Z of the fifth plane, km",
                            .y_label = label,
                            .curves = {five,
                                       {.label = "four planes",
                                        .x = {five.x.front(), five.x.back()},
                                        .y = {of_four, of_four},
                                        .colour = 1}}},
                           fmt::format("figure-5-{}-{}", to_string(setup), name)));
      return five;
    };
    const Curve residual = add("residual_wfe_nm", "residual WFE, nm", "residual_wfe");
    const Curve loops = add("loops", "loops", "loops");
    for (std::size_t i = 0; i < distances.size(); ++i) {
      table.row()
          .add(distances[i])
          .add(residual.y[i])
          .add(residual.spread[i])
          .add(loops.y[i])
          .add(loops.spread[i]);
    }
    folder_.write(fmt::format("figure-5-{}.csv", to_string(setup)), table.text());
    add_pictures(setup, {"residual WFE", "loops"}, {shown});
  }

  void add_sampling() {
    std::vector<std::string> shown;
    for (const StudySetup setup : setups) shown.push_back(draw_sampling(setup));
    add_both(shown);
  }

  void add_medium_band() {
    std::vector<std::string> shown;
    for (const StudySetup setup : setups) {
      shown.push_back(copied(fmt::format("figure-8/{}-medium", to_string(setup)), "convergence",
                             fmt::format("figure-7-{}", to_string(setup)),
                             fmt::format("medium band, {}", title_of(setup))));
    }
    add_both(shown);
  }

  void add_bands() {
    std::vector<std::string> shown;
    for (const StudySetup setup : setups) shown.push_back(draw_bands(setup));
    add_both(shown);
  }

  void add_scaling() {
    std::vector<std::string> heads{"telescope"};
    for (const StudySetup setup : setups) heads.emplace_back(title_of(setup));
    text_ += table_head(heads);
    for (const NamedSettings& telescope : scaled_telescopes()) {
      std::vector<std::string> cells{telescope.name};
      for (const StudySetup setup : setups) {
        const Json& performance =
            runs_.summary(fmt::format("scaling/{}-{}", to_string(setup), telescope.name))
                .at("design")
                .at("performance");
        cells.push_back(fmt::format("{} nm, {} loops",
                                    with_error(mean_from_json(performance.at("residual_wfe_nm"))),
                                    with_error(mean_from_json(performance.at("loops")))));
      }
      text_ += table_row(cells);
    }
    text_ += '\n';
  }

  void add_responses() {
    text_ += table_head({"the paper's planes", "with photon noise"});
    text_ += table_row({copied("response/noise-free", "response", "response", "the paper's planes"),
                        copied("response/photons", "response", "response-photons",
                               "the paper's planes, with photon noise")});
    text_ += '\n' + table_head({"pairs: recovered share", "residual WFE", "loops"});
    text_ += table_row(
        {copied("response/noise-free", "response-map-recovered", "response-pairs", "recovered"),
         copied("response/noise-free", "response-map-residual", "response-pairs-residual",
                "residual WFE"),
         copied("response/noise-free", "response-map-loops", "response-pairs-loops", "loops")});
    text_ += '\n';
  }

  void add_numerics() {
    CsvTable table({"variant", "probe", "residual_wfe_nm", "residual_wfe_standard_error_nm",
                    "loops", "loops_standard_error", "field_strehl", "field_strehl_standard_error",
                    "converged_fraction", "floor_nm", "floor_standard_error_nm"});
    text_ += table_head({"changed", "D/r0 = 4", "D/r0 = 6", "D/r0 = 8", "without P3", "without P1",
                         "fifth plane at 100 km", "4 pixels per r0 at D/r0 = 8",
                         "medium band at D/r0 = 6"});
    for (const NamedSettings& variant : numerical_variants(screens_)) {
      std::vector<std::string> cells{variant.name};
      for (const NamedSettings& probe : numerical_probes()) {
        const std::string run = fmt::format("numerics/{}/{}", variant.name, probe.name);
        const Json& summary = runs_.summary(run);
        const Json& performance = summary.at("design").at("performance");
        const auto mean = [&](const char* metric) {
          return mean_from_json(performance.at(metric));
        };
        const MeanAndError floor = floor_of(summary);
        table.row().add(variant.name).add(probe.name);
        for (const char* metric : {"residual_wfe_nm", "loops", "field_strehl"}) {
          table.add(mean(metric).mean).add(mean(metric).standard_error);
        }
        table.add(performance.at("converged_fraction").get<double>())
            .add(floor.mean)
            .add(floor.standard_error);
        if (std::isfinite(floor.mean)) {
          cells.push_back(fmt::format("{} nm", with_error(floor)));
        } else if (probe.name == "four-pixels") {
          cells.push_back("S_F " + with_error(mean("field_strehl")));
        } else {
          cells.push_back(fmt::format("{} nm, {} loops", with_error(mean("residual_wfe_nm")),
                                      with_error(mean("loops"))));
        }
      }
      text_ += table_row(cells);
    }
    text_ += '\n';
    folder_.write("numerics.csv", table.text());
  }

 private:
  /// The residual after the last loop of a convergence, nm; NaN of other runs.
  static MeanAndError floor_of(const Json& summary) {
    const auto loops = summary.find("residual_after_loops_nm");
    if (loops == summary.end()) return {std::nan(""), std::nan("")};
    return {loops->at("mean").back(), loops->at("standard_error").back()};
  }

  /// The residual and the loops of a map: both as a cell of a table.
  std::vector<std::string> draw_maps(const std::string& run, int ratio, const std::string& title) {
    const PlaneMap map(runs_.summary(run).at("grid"));
    std::string name = run;
    std::ranges::replace(name, '/', '-');
    folder_.write(name + ".csv", map_table(map));
    return {draw(distance_map(map, "residual_wfe_nm", 1.0, "residual WFE, nm", "nm"), ratio, title,
                 name + "-residual_wfe"),
            draw(distance_map(map, "loops", 1.0, "loops", ""), ratio, title, name + "-loops")};
  }

  std::string draw(const DistanceMap& map, int ratio, const std::string& title,
                   const std::string& name) {
    write_map(map, folder_.file(name + ".fits"));
    return shown(name, fmt::format("{}, {}", title, map.label),
                 draw_map(map, ratio, title, folder_.file(name)));
  }

  std::string draw(const CurvePicture& picture, const std::string& name) {
    return shown(name, fmt::format("{}, {}", picture.title, picture.y_label),
                 write_picture(picture, folder_.file(name)));
  }

  std::string draw_sampling(StudySetup setup) {
    CurvePicture picture{.title = fmt::format("Sampling, {}", title_of(setup)),
                         .x_label = "pixels per r0",
                         .y_label = "field-estimated Strehl ratio",
                         .curves = {},
                         .has_log_x = true};
    CsvTable table({"d_over_r0", "pupil_pixels", "pixels_per_r0", "field_strehl",
                    "field_strehl_standard_error"});
    for (const int ratio : sampling_ratios) {
      const Json& grid =
          runs_.summary(fmt::format("figure-6/{}-{}", to_string(setup), ratio)).at("grid");
      Curve curve{.label = fmt::format("D/r0 = {}", ratio),
                  .y = numbers_from_json(grid.at("field_strehl")),
                  .spread = numbers_from_json(grid.at("standard_error").at("field_strehl")),
                  .colour = static_cast<int>(picture.curves.size())};
      const std::vector<double> pixels = numbers_from_json(grid.at("axes").front().at("values"));
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        curve.x.push_back(pixels[i] / ratio);
        table.row()
            .add(double(ratio))
            .add(pixels[i])
            .add(curve.x[i])
            .add(curve.y[i])
            .add(curve.spread[i]);
      }
      picture.curves.push_back(std::move(curve));
    }
    const std::string name = fmt::format("figure-6-{}", to_string(setup));
    folder_.write(name + ".csv", table.text());
    return draw(picture, name);
  }

  std::string draw_bands(StudySetup setup) {
    CurvePicture picture{.title = fmt::format("D/r0 = 6, bands of Table 1, {}", title_of(setup)),
                         .x_label = "loops",
                         .y_label = "residual WFE, nm",
                         .curves = {}};
    CsvTable table(
        {"band", "loop", "residual_wfe_nm", "standard_error_nm", "standard_deviation_nm"});
    for (const PaperBand& band : paper_bands) {
      const Json& loops = runs_.summary(fmt::format("figure-8/{}-{}", to_string(setup), band.name))
                              .at("residual_after_loops_nm");
      Curve curve{.label = std::string(band.name),
                  .y = numbers_from_json(loops.at("mean")),
                  .spread = numbers_from_json(loops.at("standard_deviation")),
                  .colour = static_cast<int>(picture.curves.size())};
      const std::vector<double> errors = numbers_from_json(loops.at("standard_error"));
      for (std::size_t loop = 0; loop < errors.size(); ++loop) {
        curve.x.push_back(double(loop + 1));
        table.row()
            .add(band.name)
            .add(curve.x[loop])
            .add(curve.y[loop])
            .add(errors[loop])
            .add(curve.spread[loop]);
      }
      picture.curves.push_back(std::move(curve));
    }
    const std::string name = fmt::format("figure-8-{}", to_string(setup));
    folder_.write(name + ".csv", table.text());
    return draw(picture, name);
  }

  /// A picture and a table that a run has made.
  std::string copied(const std::string& run, const std::string& file, const std::string& name,
                     const std::string& title) {
    for (const char* kind : {".png", ".svg", ".csv"}) {
      const std::filesystem::path made = folder_.path() / run / (file + kind);
      if (!std::filesystem::exists(made)) continue;  // no gnuplot, or no table of its own
      std::filesystem::copy_file(made, folder_.file(name + kind),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    return shown(name, title, std::nullopt);
  }

  /// A picture as a cell of a table, where there is one.
  std::string shown(const std::string& name, const std::string& title,
                    const std::optional<std::string>& no_picture) {
    if (no_picture) notes_.push_back(fmt::format("there is no {}.svg: {}", name, *no_picture));
    if (!std::filesystem::exists(folder_.file(name + ".png"))) return "no picture";
    return fmt::format("![{}]({}.png)", title, name);
  }

  void add_pictures(StudySetup setup, const std::vector<std::string>& heads,
                    const std::vector<std::vector<std::string>>& rows) {
    text_ += fmt::format("*{}*\n\n", title_of(setup)) + table_head(heads);
    for (const std::vector<std::string>& row : rows) text_ += table_row(row);
    text_ += '\n';
  }

  /// One picture of each set-up, side by side.
  void add_both(const std::vector<std::string>& cells) {
    text_ += table_head(
        {std::string(title_of(StudySetup::paper)), std::string(title_of(StudySetup::extended))});
    text_ += table_row(cells) + '\n';
  }

  const OutputFolder& folder_;
  const ReproducedRuns& runs_;
  const std::vector<Claim>& claims_;
  int screens_;
  std::string text_;
  std::vector<std::string> notes_;
};

std::string claims_csv(const std::vector<Claim>& claims) {
  std::vector<std::string> columns{"figure", "claim", "papers_number"};
  for (const StudySetup setup : setups) {
    for (const char* what : {"verdict", "number", "why"}) {
      columns.push_back(fmt::format("{}_{}", to_string(setup), what));
    }
  }
  columns.emplace_back("rule");
  CsvTable table(columns);
  for (const Claim& claim : claims) {
    table.row().add(claim.figure).add(claim.sentence).add(claim.papers);
    for (const StudySetup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      table.add(to_string(finding.verdict)).add(finding.number).add(finding.why);
    }
    table.add(claim.rule);
  }
  return table.text();
}

}  // namespace

std::string count_text(const std::vector<Claim>& claims, StudySetup setup) {
  std::vector<std::string> texts;
  for (const ClaimVerdict verdict : {ClaimVerdict::reproduced, ClaimVerdict::in_trend,
                                     ClaimVerdict::not_reproduced, ClaimVerdict::open}) {
    const auto count = std::ranges::count_if(
        claims, [&](const Claim& claim) { return claim.findings.at(setup).verdict == verdict; });
    if (count > 0) texts.push_back(fmt::format("{} {}", count, to_string(verdict)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::vector<std::string> write_reproduction_report(const OutputFolder& folder,
                                                   const ReproducedRuns& runs,
                                                   const std::vector<Claim>& claims,
                                                   const std::vector<std::string>& figures,
                                                   int screens) {
  const auto wants = [&](std::string_view figure) {
    return std::ranges::count(figures, figure) > 0;
  };
  Report report(folder, runs, claims, screens);
  report.add_introduction();
  if (wants("3")) {
    report.add_heading(
        "Figure 3: four planes",
        "In the order -near, +near, -far, +far. Residual WFE above, loops below, "
        "over Z_far (right) and Z_near (up); lines: the Talbot distance of r0. Where "
        "Z_near is larger than Z_far the designs are left out, as in the paper.");
    for (const StudySetup setup : setups) report.add_four_plane_maps(setup);
    report.add_claims("3");
  }
  if (wants("scaling")) {
    report.add_heading(
        "Scaling by Fresnel numbers",
        "The paper's planes moved to other telescopes, with the tolerance as the same "
        "share of the wavelength.");
    report.add_scaling();
    report.add_claims("scaling");
  }
  if (wants("4")) {
    report.add_heading("Figure 4: three planes",
                       "D/r0 = 4. Residual WFE, loops, and the loops by the time that one takes on "
                       "this machine, measured at 47 and 180 km.");
    for (const StudySetup setup : setups) report.add_plane_count_maps(setup);
    report.add_claims("4");
  }
  if (wants("5")) {
    report.add_heading("Figure 5: a fifth plane",
                       "D/r0 = 4, four planes at 47 and 180 km, the fifth read last. Bars are "
                       "standard errors; the line is the mean of the four planes alone.");
    for (const StudySetup setup : setups) report.add_fifth_plane(setup);
    report.add_claims("5");
  }
  if (wants("6")) {
    report.add_heading(
        "Figure 6: sampling",
        "Z_near = Z_T, Z_far = 180 km. The truth has 128 samples across the pupil; "
        "8 to 128 detector pixels bin it (in the paper's set-up on its periodic grid "
        "of 4 diameters). Bars are standard errors.");
    report.add_sampling();
    report.add_claims("6");
  }
  if (wants("7")) {
    report.add_heading("Figure 7: the medium band",
                       "D/r0 = 6, 128 pixels, planes at 47 and 180 km at their bands' middles, 20 "
                       "wavelengths a plane; each wavefront, and their mean.");
    report.add_medium_band();
    report.add_claims("7");
  }
  if (wants("8")) {
    report.add_heading("Figure 8: bands",
                       "The same for one wavelength and the bands of Table 1 (the wide band's P2 "
                       "as 500 to 699 nm). Bars are standard deviations, as in the paper.");
    report.add_bands();
    report.add_claims("8");
  }
  if (wants("response")) {
    report.add_heading(
        "Response to single spatial frequencies",
        "Sinusoidal aberrations of 10 nm with an extended truth: what the loop "
        "recovers of them with the paper's planes, without noise and with 1e6 photons "
        "per frame, and with single pairs of planes at their distance; beside it the "
        "Talbot prediction and the photon limit.");
    report.add_responses();
  }
  if (wants("numerics")) {
    report.add_heading(
        "What the numerics decide",
        "The paper's set-up with one thing changed; planes at 47 and 180 km unless "
        "said otherwise. Where the truth's samples change, so do the wavefronts, not "
        "their statistics.");
    report.add_numerics();
  }
  report.write();
  folder.write("claims.csv", claims_csv(claims));
  return report.notes();
}

}  // namespace nlcwfs
