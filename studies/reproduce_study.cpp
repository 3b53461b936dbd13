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

/// A figure of a two-axis sweep as the paper draws it: Z_far to the right, Z_near upwards, with the
/// Talbot distance of r0 on both.
std::optional<std::string> draw_map(const Json& grid, const char* figure, const char* label,
                                    int ratio, const std::string& title,
                                    const std::filesystem::path& stem) {
  MapPicture picture{.title = title,
                     .x = {.label = "Z_far, km", .values = {}},
                     .y = {.label = "Z_near, km", .values = {}},
                     .value_label = label,
                     .values = {}};
  const PlaneMap map(grid);
  for (const double far : map.far()) picture.x.values.push_back(far / km);
  for (const double near : map.near()) picture.y.values.push_back(near / km);
  for (std::size_t far = 0; far < map.far().size(); ++far) {
    picture.values.emplace_back();
    for (std::size_t near = 0; near < map.near().size(); ++near) {
      picture.values.back().push_back(map.value(figure, near, far));
    }
  }
  const Telescope telescope;
  const double talbot = talbot_distance(telescope.diameter / ratio, telescope.wavelength) / km;
  const double last = picture.x.values.back();
  picture.overlay.curves = {{"Z_near = Z_T(r0)", {{0.0, talbot}, {last, talbot}}},
                            {"Z_far = Z_T(r0)", {{talbot, 0.0}, {talbot, last}}}};
  return write_picture(picture, stem);
}

/// The same as a FITS image, NaN where there is no design: Z_far along axis 1, Z_near along axis 2.
void write_map(const Json& grid, const char* figure, const std::string& unit,
               const std::filesystem::path& path) {
  const PlaneMap map(grid);
  Image<double> values(map.near().size(), map.far().size());
  for (std::size_t near = 0; near < map.near().size(); ++near) {
    for (std::size_t far = 0; far < map.far().size(); ++far) {
      values(Eigen::Index(near), Eigen::Index(far)) = map.value(figure, near, far);
    }
  }
  std::vector<FitsKeyword> keywords;
  const auto add_axis = [&](int number, const char* name, const std::vector<double>& distances) {
    keywords.push_back({fmt::format("CTYPE{}", number), std::string(name), "distance of a pair"});
    keywords.push_back({fmt::format("CUNIT{}", number), std::string("m"), ""});
    keywords.push_back({fmt::format("CRPIX{}", number), 1.0, ""});
    keywords.push_back({fmt::format("CRVAL{}", number), distances[0], "first distance"});
    keywords.push_back(
        {fmt::format("CDELT{}", number), distances[1] - distances[0], "to the next distance"});
  };
  add_axis(1, "Z_FAR", map.far());
  add_axis(2, "Z_NEAR", map.near());
  std::filesystem::remove(path);  // of a report that was interrupted
  write_fits_cube(path, {unit, {values}}, keywords);
}

/// What a reproduction leaves beside its runs.
class Report {
 public:
  Report(const OutputFolder& folder, const ReproducedRuns& runs) : folder_(folder), runs_(runs) {}

  void add_text(const std::string& text) { text_ += text; }
  const std::string& text() const { return text_; }
  /// Where there is no picture.
  const std::vector<std::string>& notes() const { return notes_; }

  void add_maps(const std::string& run, int ratio, const std::string& title, bool has_time) {
    const Json& grid = runs_.summary(run).at("grid");
    std::vector<std::pair<const char*, const char*>> figures{
        {"residual_wfe_nm", "residual WFE, nm"}, {"loops", "loops"}};
    if (has_time) figures.emplace_back("fft_count", "Fourier transforms per reconstruction");
    for (const auto& [figure, label] : figures) {
      std::string name = fmt::format("{}-{}", run, figure);
      std::ranges::replace(name, '/', '-');
      note(draw_map(grid, figure, label, ratio, title, folder_.file(name)), name);
      write_map(grid, figure, figure == std::string_view("residual_wfe_nm") ? "nm" : "",
                folder_.file(name + ".fits"));
      show(name, fmt::format("{}, {}", title, label));
    }
  }

  void add_fifth_plane(Setup setup) {
    const std::string run = fmt::format("figure-5/{}", to_string(setup));
    for (const char* figure : {"residual_wfe", "fractional_loops"}) {
      text_ += fmt::format("![{} of five planes, {}]({}/map-{}.png)\n", figure, title_of(setup),
                           run, figure);
    }
    text_ += '\n';
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
    add_curves(fmt::format("figure-6-{}", to_string(setup)), picture, table.text());
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
    add_curves(fmt::format("figure-8-{}", to_string(setup)), picture, table.text());
  }

  void add_numerics() {
    CsvTable table({"variant", "d_over_r0", "residual_wfe_nm", "residual_wfe_standard_error_nm",
                    "loops", "loops_standard_error", "converged_fraction"});
    text_ += "| changed from the paper's set-up |";
    for (const int ratio : map_ratios) text_ += fmt::format(" D/r0 = {} |", ratio);
    text_ += "\n|---|---|---|---|\n";
    for (const NamedSettings& variant : numerical_variants()) {
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
  void add_curves(const std::string& name, const CurvePicture& picture, const std::string& table) {
    note(write_picture(picture, folder_.file(name)), name);
    folder_.write(name + ".csv", table);
    show(name, picture.title);
  }

  void note(const std::optional<std::string>& no_picture, const std::string& name) {
    if (no_picture) notes_.push_back(fmt::format("there is no {}.svg: {}", name, *no_picture));
  }

  void show(const std::string& name, const std::string& title) {
    text_ += fmt::format("![{}]({}.png)\n", title, name);
  }

  const OutputFolder& folder_;
  const ReproducedRuns& runs_;
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
                        fmt::format("Four planes, D/r0 = {}, {}", ratio, title_of(setup)), false);
      }
      report.add_text("\n");
    }
  }
  if (wants("4")) {
    report.add_text("## Figure 4: three planes\n\n");
    for (const Setup setup : setups) {
      for (const char* without : {"p3", "p1"}) {
        report.add_maps(fmt::format("figure-4/{}-without-{}", to_string(setup), without), 4,
                        fmt::format("Without {}, D/r0 = 4, {}", without, title_of(setup)), true);
      }
      report.add_maps(fmt::format("figure-3/{}-4", to_string(setup)), 4,
                      fmt::format("Four planes, D/r0 = 4, {}", title_of(setup)), true);
      report.add_text("\n");
    }
  }
  if (wants("5")) {
    report.add_text("## Figure 5: a fifth plane\n\n");
    for (const Setup setup : setups) report.add_fifth_plane(setup);
  }
  if (wants("6")) {
    report.add_text("## Figure 6: sampling\n\n");
    for (const Setup setup : setups) report.add_sampling(setup);
    report.add_text("\n");
  }
  if (wants("7")) {
    report.add_text("## Figure 7: medium band, each aberration\n\n");
    for (const Setup setup : setups) {
      report.add_text(fmt::format("![medium band, {}](figure-8/{}-medium/convergence.png)\n",
                                  title_of(setup), to_string(setup)));
    }
    report.add_text("\n");
  }
  if (wants("8")) {
    report.add_text("## Figure 8: bands\n\n");
    for (const Setup setup : setups) report.add_broadband(setup);
    report.add_text("\n");
  }
  if (wants("response")) {
    report.add_text(
        "## Response to single spatial frequencies\n\n"
        "![response of the paper's planes](response/noise-free/response.png)\n"
        "![with photon noise](response/photons/response.png)\n"
        "![recovered by pairs](response/noise-free/response-map-recovered.png)\n\n");
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
  Report report(record.folder(), reproduced);
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
      "{} reads as one: report.md\n{}\n",
      count_text(claims, Setup::paper), count_text(claims, Setup::extended), "What was found",
      record.closing_line());
}

}  // namespace nlcwfs
