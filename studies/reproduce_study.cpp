#include "model/telescope.hpp"
#include "results/csv_table.hpp"
#include "results/curve_picture.hpp"
#include "results/fits_cube.hpp"
#include "results/json_numbers.hpp"
#include "results/map_picture.hpp"
#include "studies/design_text.hpp"
#include "studies/paper_claims.hpp"
#include "studies/plane_map.hpp"
#include "studies/progress_line.hpp"
#include "studies/reproduction_plan.hpp"
#include "studies/run_record.hpp"
#include "studies/settings.hpp"
#include "studies/studies.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr double km = 1e3;

std::string_view title_of(Setup setup) {
  return setup == Setup::paper ? "the paper's set-up" : "extended truth, rule difference";
}

void run_part(const CommandLine& command_line) {
  static const std::map<std::string, std::function<void(const CommandLine&)>> commands{
      {"convergence", run_convergence},
      {"evaluate", run_evaluate},
      {"response", run_response},
      {"sweep", run_sweep}};
  commands.at(command_line.command)(command_line);
}

/// Runs what of the plan is not done yet.
void run_missing(const std::vector<PlannedRun>& runs, const std::filesystem::path& folder,
                 const CommandLine& command_line) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::filesystem::path path = folder / runs[i].folder;
    if (std::filesystem::exists(path / "summary.json")) continue;
    CommandLine part{.command = runs[i].command,
                     .arguments = {},
                     .configuration = runs[i].configuration,
                     .output = path,
                     .resume = {},
                     .quiet = command_line.quiet,
                     .silent = true};
    if (part.command == "sweep" && std::filesystem::exists(path / "archive.sqlite")) {
      part.resume = path;
    } else {
      std::filesystem::remove_all(path);  // what a killed run has left, which cannot go on
      std::filesystem::create_directories(path.parent_path());
    }
    if (!command_line.quiet) {
      fmt::print("{} of {}: {} {}\n", i + 1, runs.size(), runs[i].command, runs[i].folder);
      std::fflush(stdout);
    }
    try {
      run_part(part);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}; go on with: nlcwfs reproduce --resume {}",
                                           runs[i].folder, error.what(), folder.string()));
    }
  }
}

// Pictures ----------------------------------------------------------------------------------------

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
  std::vector<FitsKeyword> keywords;
  const auto add_axis = [&](int number, const char* name, const std::vector<double>& distances) {
    keywords.push_back({fmt::format("CTYPE{}", number), std::string(name), "distance of a pair"});
    keywords.push_back({fmt::format("CUNIT{}", number), std::string("m"), ""});
    keywords.push_back({fmt::format("CRPIX{}", number), 1.0, ""});
    keywords.push_back({fmt::format("CRVAL{}", number), distances[0], "first distance"});
    keywords.push_back(
        {fmt::format("CDELT{}", number), distances[1] - distances[0], "to the next distance"});
  };
  add_axis(1, "Z_FAR", map.places.far());
  add_axis(2, "Z_NEAR", map.places.near());
  std::filesystem::remove(path);  // of a report that was interrupted
  write_fits_cube(path, {map.unit, {map.values}}, keywords);
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

/// What a reproduction leaves beside its runs, so that the folder without them is a whole.
class Report {
 public:
  /// @param screens  of the reproduction
  Report(const OutputFolder& folder, const ReproducedRuns& runs, int screens)
      : folder_(folder), runs_(runs), screens_(screens) {}

  void add_text(const std::string& text) { text_ += text; }
  const std::string& text() const { return text_; }
  /// Where there is no picture.
  const std::vector<std::string>& notes() const { return notes_; }

  void add_maps(const std::string& run, int ratio, const std::string& title) {
    const PlaneMap map(runs_.summary(run).at("grid"));
    const std::string name = flat_name(run);
    folder_.write(name + ".csv", map_table(map));
    add_map(distance_map(map, "residual_wfe_nm", 1.0, "residual WFE, nm", "nm"), ratio, title,
            name + "-residual_wfe");
    add_map(distance_map(map, "loops", 1.0, "loops", ""), ratio, title, name + "-loops");
  }

  /// The time as the paper has it: the loops, by the time that one takes.
  /// @param design  whose loop is timed
  void add_time(const std::string& run, const std::string& design, int ratio,
                const std::string& title) {
    const PlaneMap map(runs_.summary(run).at("grid"));
    const Json& performance = runs_.summary("designs/" + design).at("design").at("performance");
    const double milliseconds = 1e3 * mean_from_json(performance.at("seconds")).mean /
                                mean_from_json(performance.at("loops")).mean;
    add_map(distance_map(map, "loops", milliseconds, "approximate time, ms", "ms"), ratio, title,
            "figure-4-" + design + "-time");
    text_ += fmt::format("{:.3g} ms a loop.\n\n", milliseconds);
  }

  void add_fifth_plane(Setup setup) {
    const Json& grid = runs_.summary(fmt::format("figure-5/{}", to_string(setup))).at("grid");
    const Json& four = runs_.summary(fmt::format("designs/{}-four-planes", to_string(setup)))
                           .at("design")
                           .at("performance");
    const Json& axes = grid.at("axes");
    const auto fifth =
        std::ranges::find_if(axes, [](const Json& axis) { return axis.at("name") == "z5"; });
    const std::vector<double> distances = numbers_from_json(fifth->at("values"));
    const std::pair<const char*, const char*> figures[]{{"residual_wfe_nm", "residual WFE, nm"},
                                                        {"loops", "loops"}};
    CsvTable table({"z5_m", "residual_wfe_nm", "residual_wfe_standard_error_nm", "loops",
                    "loops_standard_error"});
    std::vector<std::vector<MeanAndError>> means;
    for (const auto& [figure, label] : figures) {
      const std::vector<double> values = numbers_from_json(grid.at(figure));
      const std::vector<double> errors = numbers_from_json(grid.at("standard_error").at(figure));
      Curve five{.label = "five planes", .spread = errors};
      for (const double distance : distances) five.x.push_back(distance / km);
      five.y = values;
      const double of_four = mean_from_json(four.at(figure)).mean;
      const Curve line{.label = "four planes",
                       .x = {five.x.front(), five.x.back()},
                       .y = {of_four, of_four},
                       .colour = 1};
      CurvePicture picture{.title = fmt::format("Fifth plane, {}", title_of(setup)),
                           .x_label = "Z_5, km",
                           .y_label = label,
                           .curves = {std::move(five), line}};
      std::string name = fmt::format("figure-5-{}-{}", to_string(setup), figure);
      draw_curves(name, picture);
      means.emplace_back();
      for (std::size_t i = 0; i < values.size(); ++i) {
        means.back().push_back({values[i], errors[i]});
      }
    }
    for (std::size_t i = 0; i < distances.size(); ++i) {
      table.row().add(distances[i]);
      for (const std::vector<MeanAndError>& of_figure : means) {
        table.add(of_figure[i].mean).add(of_figure[i].standard_error);
      }
    }
    folder_.write(fmt::format("figure-5-{}.csv", to_string(setup)), table.text());
  }

  /// A picture and a table that a run has made.
  void add_from(const std::string& run, const std::string& file, const std::string& name,
                const std::string& title) {
    for (const char* kind : {".png", ".svg", ".csv"}) {
      const std::filesystem::path made = folder_.path() / run / (file + kind);
      if (!std::filesystem::exists(made)) continue;  // no gnuplot, or no table of its own
      std::filesystem::copy_file(made, folder_.file(name + kind),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    show(name, title);
  }

  void add_sampling(Setup setup) {
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
                  .colour = static_cast<int>(picture.curves.size())};
      const Json& pixels = grid.at("axes").front().at("values");
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        curve.x.push_back(pixels[i].get<double>() / ratio);
        curve.y.push_back(grid.at("field_strehl")[i]);
        curve.spread.push_back(grid.at("standard_error").at("field_strehl")[i]);
        table.row()
            .add(double(ratio))
            .add(pixels[i].get<double>())
            .add(curve.x.back())
            .add(curve.y.back())
            .add(curve.spread.back());
      }
      picture.curves.push_back(std::move(curve));
    }
    const std::string name = fmt::format("figure-6-{}", to_string(setup));
    draw_curves(name, picture);
    folder_.write(name + ".csv", table.text());
  }

  void add_broadband(Setup setup) {
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
                  .colour = static_cast<int>(picture.curves.size())};
      for (std::size_t loop = 0; loop < loops.at("mean").size(); ++loop) {
        curve.x.push_back(double(loop + 1));
        curve.y.push_back(loops.at("mean")[loop]);
        curve.spread.push_back(loops.at("standard_deviation")[loop]);
        table.row()
            .add(band.name)
            .add(curve.x.back())
            .add(curve.y.back())
            .add(loops.at("standard_error")[loop].get<double>())
            .add(curve.spread.back());
      }
      picture.curves.push_back(std::move(curve));
    }
    const std::string name = fmt::format("figure-8-{}", to_string(setup));
    draw_curves(name, picture);
    folder_.write(name + ".csv", table.text());
  }

  void add_numerics() {
    CsvTable table({"variant", "d_over_r0", "residual_wfe_nm", "residual_wfe_standard_error_nm",
                    "loops", "loops_standard_error", "converged_fraction"});
    text_ += "| changed from the paper's set-up |";
    for (const int ratio : map_ratios) text_ += fmt::format(" D/r0 = {} |", ratio);
    text_ += "\n|---|---|---|---|\n";
    for (const NamedSettings& variant : numerical_variants(screens_)) {
      text_ += fmt::format("| {} |", variant.name);
      for (const int ratio : map_ratios) {
        const Json& performance = runs_.summary(fmt::format("numerics/{}-{}", variant.name, ratio))
                                      .at("design")
                                      .at("performance");
        const MeanAndError residual = mean_from_json(performance.at("residual_wfe_nm"));
        const MeanAndError loops = mean_from_json(performance.at("loops"));
        text_ += fmt::format(" {} nm, {} loops |", with_error(residual), with_error(loops));
        table.row()
            .add(variant.name)
            .add(double(ratio))
            .add(residual.mean)
            .add(residual.standard_error)
            .add(loops.mean)
            .add(loops.standard_error)
            .add(performance.at("converged_fraction").get<double>());
      }
      text_ += '\n';
    }
    text_ += '\n';
    folder_.write("numerics.csv", table.text());
  }

 private:
  /// "figure-3/paper-4" as part of a file's name.
  static std::string flat_name(std::string run) {
    std::ranges::replace(run, '/', '-');
    return run;
  }

  void add_map(const DistanceMap& map, int ratio, const std::string& title,
               const std::string& name) {
    note(draw_map(map, ratio, title, folder_.file(name)), name);
    write_map(map, folder_.file(name + ".fits"));
    show(name, fmt::format("{}, {}", title, map.label));
  }

  void draw_curves(const std::string& name, const CurvePicture& picture) {
    note(write_picture(picture, folder_.file(name)), name);
    show(name, fmt::format("{}, {}", picture.title, picture.y_label));
  }

  void note(const std::optional<std::string>& no_picture, const std::string& name) {
    if (no_picture) notes_.push_back(fmt::format("there is no {}.svg: {}", name, *no_picture));
  }

  void show(const std::string& name, const std::string& title) {
    text_ += fmt::format("![{}]({}.png)\n", title, name);
  }

  const OutputFolder& folder_;
  const ReproducedRuns& runs_;
  int screens_;
  std::string text_;
  std::vector<std::string> notes_;
};

// Claims ------------------------------------------------------------------------------------------

std::string claims_csv(const std::vector<Claim>& claims) {
  CsvTable table({"figure", "claim", "paper", "paper_set_up", "paper_set_up_verdict", "extended",
                  "extended_verdict", "rule", "why"});
  for (const Claim& claim : claims) {
    table.row().add(claim.figure).add(claim.sentence).add(claim.papers);
    for (const Setup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      table.add(finding.number).add(to_string(finding.verdict));
    }
    table.add(claim.rule).add(claim.why);
  }
  return table.text();
}

Json claims_array(const std::vector<Claim>& claims) {
  Json array = Json::array();
  for (const Claim& claim : claims) {
    Json json{{"figure", claim.figure},
              {"claim", claim.sentence},
              {"papers_number", claim.papers},
              {"rule", claim.rule},
              {"why", claim.why}};
    for (const Setup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      json[std::string(to_string(setup))] = {{"number", finding.number},
                                             {"verdict", to_string(finding.verdict)}};
    }
    array.push_back(std::move(json));
  }
  return array;
}

std::string claims_markdown(const std::vector<Claim>& claims) {
  std::string text =
      "| figure | the paper says | its number | the paper's set-up | extended truth, rule "
      "difference | reproduced means | why |\n|---|---|---|---|---|---|---|\n";
  for (const Claim& claim : claims) {
    text += fmt::format("| {} | {} | {} |", claim.figure, claim.sentence, claim.papers);
    for (const Setup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      text += fmt::format(" **{}**: {} |", to_string(finding.verdict), finding.number);
    }
    text += fmt::format(" {} | {} |\n", claim.rule, claim.why);
  }
  return text + '\n';
}

/// "11 reproduced, 6 reproduced in trend, 4 not reproduced"
std::string count_text(const std::vector<Claim>& claims, Setup setup) {
  std::vector<std::string> texts;
  for (const ClaimVerdict verdict :
       {ClaimVerdict::reproduced, ClaimVerdict::in_trend, ClaimVerdict::not_reproduced}) {
    const auto count = std::ranges::count_if(
        claims, [&](const Claim& claim) { return claim.findings.at(setup).verdict == verdict; });
    texts.push_back(fmt::format("{} {}", count, to_string(verdict)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void add_figures(Report& report, const std::vector<std::string>& figures) {
  const auto wants = [&](std::string_view figure) {
    return std::ranges::count(figures, figure) > 0;
  };
  if (wants("3")) {
    report.add_text("## Figure 3: four planes\n\n");
    for (const Setup setup : setups) {
      for (const int ratio : map_ratios) {
        report.add_maps(fmt::format("figure-3/{}-{}", to_string(setup), ratio), ratio,
                        fmt::format("Four planes, D/r0 = {}, {}", ratio, title_of(setup)));
      }
      report.add_text("\n");
    }
  }
  if (wants("4")) {
    report.add_text("## Figure 4: three planes\n\n");
    for (const Setup setup : setups) {
      const std::array<std::array<std::string, 3>, 3> maps{
          {{"figure-4/{}-without-p3", "{}-without-p3", "Without P3"},
           {"figure-4/{}-without-p1", "{}-without-p1", "Without P1"},
           {"figure-3/{}-4", "{}-four-planes", "Four planes"}}};
      for (const auto& [run, design, planes] : maps) {
        const auto of_setup = [&](const std::string& name) {
          return fmt::format(fmt::runtime(name), to_string(setup));
        };
        const std::string title = fmt::format("{}, D/r0 = 4, {}", planes, title_of(setup));
        report.add_maps(of_setup(run), 4, title);
        report.add_time(of_setup(run), of_setup(design), 4, title);
      }
    }
  }
  if (wants("5")) {
    report.add_text("## Figure 5: a fifth plane\n\n");
    for (const Setup setup : setups) report.add_fifth_plane(setup);
    report.add_text("\n");
  }
  if (wants("6")) {
    report.add_text("## Figure 6: sampling\n\n");
    for (const Setup setup : setups) report.add_sampling(setup);
    report.add_text("\n");
  }
  if (wants("7")) {
    report.add_text("## Figure 7: medium band, each aberration\n\n");
    for (const Setup setup : setups) {
      report.add_from(fmt::format("figure-8/{}-medium", to_string(setup)), "convergence",
                      fmt::format("figure-7-{}", to_string(setup)),
                      fmt::format("Medium band, {}", title_of(setup)));
    }
    report.add_text("\n");
  }
  if (wants("8")) {
    report.add_text("## Figure 8: bands\n\n");
    for (const Setup setup : setups) report.add_broadband(setup);
    report.add_text("\n");
  }
  if (wants("response")) {
    report.add_text("## Response to single spatial frequencies\n\n");
    report.add_from("response/noise-free", "response", "response", "The paper's planes");
    report.add_from("response/photons", "response", "response-photons", "With photon noise");
    report.add_from("response/noise-free", "response-map-recovered", "response-pairs",
                    "Pairs of planes: recovered share");
    report.add_from("response/noise-free", "response-map-residual", "response-pairs-residual",
                    "Pairs of planes: residual WFE");
    report.add_from("response/noise-free", "response-map-loops", "response-pairs-loops",
                    "Pairs of planes: loops");
    report.add_text("\n");
  }
  if (wants("numerics")) {
    report.add_text(
        "## What the numerics decide\n\nPlanes at 47 and 180 km, one thing changed at "
        "a time.\n\n");
    report.add_numerics();
  }
}

}  // namespace

void run_reproduce(const CommandLine& command_line) {
  const Configuration& configuration = command_line.configuration;
  require_one_condition(configuration);
  const auto start = Clock::now();
  const std::vector<std::string> figures = figures_of(configuration);
  const std::vector<PlannedRun> runs = planned_runs(configuration);
  RunRecord record(command_line);
  const std::filesystem::path& folder = record.folder().path();
  run_missing(runs, folder, command_line);

  const ReproducedRuns reproduced(folder);
  const std::vector<Claim> claims = checked_claims(reproduced, figures);
  Report report(record.folder(), reproduced, configuration.integer("screens.count"));
  report.add_text(fmt::format(
      "# Letchev, Crass, Crepp & Potier 2022, claim by claim\n\nMade by `nlcwfs reproduce` on {} "
      "screens. In the paper's set-up {}; with an extended truth and the rule difference {}.\n\n",
      configuration.integer("screens.count"), count_text(claims, Setup::paper),
      count_text(claims, Setup::extended)));
  report.add_text(claims_markdown(claims));
  add_figures(report, figures);
  record.folder().write("report.md", report.text());
  record.folder().write("claims.csv", claims_csv(claims));
  Json names = Json::array();
  for (const PlannedRun& run : runs) names.push_back(run.folder);
  record.write_summary(
      {{"runs", names},
       {"claims", claims_array(claims)},
       {"wall_seconds", std::chrono::duration<double>(Clock::now() - start).count()}});

  for (const std::string& note : report.notes()) fmt::print("note: {}\n", note);
  for (const Claim& claim : claims) {
    fmt::print("Figure {}: {} ({})\n", claim.figure, claim.sentence, claim.papers);
    for (const Setup setup : setups) {
      const ClaimFinding& finding = claim.findings.at(setup);
      fmt::print("  {:<8} {:<20} {}\n", to_string(setup), to_string(finding.verdict),
                 finding.number);
    }
  }
  fmt::print(
      "\nIn the paper's set-up: {}.\nWith an extended truth and the rule difference: {}.\n"
      "report.md has every claim and figure.\n{}\n",
      count_text(claims, Setup::paper), count_text(claims, Setup::extended), record.closing_line());
}

}  // namespace nlcwfs
