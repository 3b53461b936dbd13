#include "studies/run/page_data.hpp"

#include "model/input_error.hpp"
#include "model/telescope.hpp"
#include "objectives/design_space.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/page/page.hpp"
#include "results/pictures/grid_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/run/report_verdict.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

/// Pixels of an image on the page, along each side.
constexpr int most_pixels = 128;
/// Images of a file on the page.
constexpr std::size_t most_slices = 8;

/// The files that a command leaves for its page, apart from summary.json and config.cfg.
struct PageFiles {
  std::string_view command;
  std::string_view design_file = {};  ///< configuration of the design that it ends in
  std::vector<std::string> tables = {};
  std::vector<std::string> images = {};
  std::vector<std::string> pictures = {};
  bool shows_all_tables = false;  ///< also those that it does not always leave
};

const std::vector<PageFiles>& page_files() {
  static const std::vector<std::string> closer_look{"typical-images.fits", "worst-images.fits",
                                                    "typical-phases.fits", "worst-phases.fits"};
  static const std::vector<PageFiles> files{
      {.command = "advise", .design_file = "advised.cfg"},
      {.command = "benchmark"},
      {.command = "compare", .pictures = {"path.svg"}},
      {.command = "convergence", .tables = {"convergence.csv", "screens.csv"}},
      {.command = "evaluate", .tables = {"screens.csv", "loops.csv"}, .images = closer_look},
      {.command = "export", .shows_all_tables = true},
      {.command = "law", .tables = {"law.csv"}},
      {.command = "optimize",
       .design_file = "best.cfg",
       .tables = {"search.csv", "sensitivity.csv", "loops.csv"},
       .images = closer_look},
      {.command = "reconstruct",
       .tables = {"consistency.csv"},
       .images = {"phase.fits", "frames.fits", "predicted.fits"}},
      {.command = "reproduce", .tables = {"claims.csv"}, .shows_all_tables = true},
      {.command = "response", .tables = {"response.csv"}},
      {.command = "scale", .design_file = "scaled.cfg"},
      {.command = "screens", .tables = {"structure_function.csv"}, .images = {"screens.fits"}},
      {.command = "sweep",
       .design_file = "best.cfg",
       .tables = {"loops.csv"},
       .images = closer_look},
      {.command = "trade",
       .design_file = "knee.cfg",
       .tables = {"loops.csv"},
       .images = closer_look}};
  return files;
}

/// Of a text file; nothing where it cannot be read.
std::optional<std::string> text_of(const Path& path) {
  try {
    return text_of_file(path);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

[[noreturn]] void refuse(const Path& folder, const std::string& why) {
  throw InputError("DIR", one_line(folder.string()), why);
}

Json summary_of(const Path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    refuse(folder, "there is no such folder; name that of a run that is done");
  }
  const auto text = text_of(folder / "summary.json");
  if (!text) {
    refuse(folder, "has no summary.json that can be read; name the folder of a run that is done");
  }
  Json summary = json_of(*text);
  if (!summary.is_object()) {
    refuse(folder, "its summary.json is no JSON object; name the folder of a run that is done");
  }
  return summary;
}

const PageFiles& files_of(const Path& folder, const Json& summary) {
  const Json& command = summary.contains("command") ? summary.at("command") : Json();
  const auto found = std::ranges::find_if(
      page_files(), [&](const PageFiles& files) { return command == std::string(files.command); });
  if (found == page_files().end()) {
    std::vector<std::string_view> commands;
    for (const PageFiles& files : page_files()) commands.push_back(files.command);
    refuse(folder, fmt::format("its summary.json is of the command {}, and there is a page for the "
                               "results of {}",
                               one_line(command.dump()), fmt::join(commands, ", ")));
  }
  return *found;
}

std::string version_of(const Json& summary) {
  const auto version = summary.find("version");
  return version != summary.end() && version->is_string() ? version->get<std::string>() : "";
}

/// When a file was written, UTC.
std::string time_of(const Path& path) {
  const auto written = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(path));
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(written);
  return fmt::format("{:%Y-%m-%d %H:%M} UTC",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

/// Columns by their names: numbers (null where a cell is empty or holds none) where no cell is a
/// word, texts otherwise.
Json columns_of(const std::vector<CsvRow>& rows) {
  Json columns = Json::object();
  if (rows.empty()) return columns;
  for (const auto& [name, first] : rows.front()) {
    Json numbers = Json::array();
    Json texts = Json::array();
    bool has_words = false;
    for (const CsvRow& row : rows) {
      const std::string& cell = row.at(name);
      const auto number = parse_number(cell);
      has_words |= !number && !cell.empty() && cell != "nan" && cell != "inf" && cell != "-inf";
      numbers.push_back(number ? Json(*number) : Json(nullptr));
      texts.push_back(cell);
    }
    columns[name] = has_words ? texts : numbers;
  }
  return columns;
}

Json images_of(const Path& path) {
  const FitsCube cube = read_fits_cube(path, "DIR", FitsGaps::allowed, FitsShape::frames);
  Json json{{"unit", cube.unit},
            {"samples", cube.slices.front().rows()},
            {"count", cube.slices.size()},
            {"slices", Json::array()}};
  for (std::size_t i = 0; i < std::min(cube.slices.size(), most_slices); ++i) {
    json["slices"].push_back(page_image(cube.slices[i], most_pixels));
  }
  return json;
}

/// What a configuration says without its comments.
std::string without_comments(std::string_view dump) {
  std::string text;
  while (!dump.empty()) {
    const std::string_view line = dump.substr(0, dump.find('\n'));
    if (!line.empty() && !line.starts_with('#')) text.append(line) += '\n';
    dump.remove_prefix(std::min(line.size() + 1, dump.size()));
  }
  return text;
}

Json front_configurations(const Json& front, const Configuration& configuration) {
  const Telescope telescope = telescope_of(configuration);
  const DesignSpace space =
      search_space_of(configuration, telescope,
                      simulated_design(design_of(configuration), telescope,
                                       simulation_options_of(configuration, "search.precision"),
                                       truth_samples(configuration)));
  Json texts = Json::array();
  for (const Json& design : front) {
    Configuration own = configuration;
    set_design(own, design_from_json(design), space, "by the trade");
    texts.push_back(without_comments(own.dump()));
  }
  return texts;
}

/// Gathers the members of the data; what cannot be had becomes a note.
class Gathering {
 public:
  explicit Gathering(Path folder) : folder_(std::move(folder)) {}

  Json data();

 private:
  void add_configuration();
  void add_design_file(std::string_view name);
  void add_tables(std::vector<std::string> names, bool all);

  /// Adds what is made from a file; notes where there is no such file or it cannot be read.
  template <class Make>
  void add(const char* member, const std::string& name, const Make& make);
  /// Does what may fail for want of a member or by an older configuration.
  void attempt(const std::string& what, const std::function<void()>& action);

  Path folder_;
  Json data_;
  std::vector<std::string> missing_;
};

void Gathering::attempt(const std::string& what, const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    data_["notes"].push_back(fmt::format("{}: {}", what, error.what()));
  }
}

template <class Make>
void Gathering::add(const char* member, const std::string& name, const Make& make) {
  const Path path = folder_ / name;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    missing_.push_back(name);
    return;
  }
  attempt(name, [&] { data_[member][name] = make(path); });
}

/// What the page says of the telescope, and the configurations of a front.
void Gathering::add_configuration() {
  const auto text = text_of(folder_ / "config.cfg");
  if (!text) {
    missing_.emplace_back("config.cfg");
    return;
  }
  data_["configuration"] = *text;
  attempt("config.cfg is not of this version of the program", [&] {
    Configuration configuration;
    configuration.read_file(folder_ / "config.cfg");
    const Telescope telescope = telescope_of(configuration);
    const Seeing seeing = seeing_of(configuration, telescope);
    const auto command = data_.at("command").get<std::string>();
    data_["diameter_m"] = telescope.diameter;
    // Measured frames come with the seeing that they come with, and a law is for any.
    if (command == "reconstruct" || command == "law") {
      data_["telescope"] = fmt::format("{:.4g} m telescope at {}", telescope.diameter,
                                       format_length(telescope.wavelength));
    } else {
      data_["telescope"] = telescope_line(telescope, seeing);
      data_["talbot_m"] = talbot_distance(seeing.fried_parameter, telescope.wavelength);
    }
    const Json& summary = data_.at("summary");
    if (!summary.contains("front")) return;
    data_["front_configurations"] = front_configurations(summary.at("front"), configuration);
  });
}

void Gathering::add_design_file(std::string_view name) {
  if (name.empty()) return;
  const std::string file(name);
  if (const auto text = text_of(folder_ / file)) {
    data_["design_configuration"] = {{"file", file}, {"text", *text}};
  } else {
    missing_.push_back(file);
  }
}

/// @param all  whether others in the folder are shown too
void Gathering::add_tables(std::vector<std::string> names, bool all) {
  if (all) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".csv") && std::ranges::count(names, name) == 0) names.push_back(name);
    }
    std::ranges::sort(names);
  }
  for (const std::string& name : names) {
    add("tables", name, [](const Path& path) { return columns_of(read_csv(path)); });
  }
}

Json Gathering::data() {
  Json summary = summary_of(folder_);
  const PageFiles& files = files_of(folder_, summary);
  summary.erase("config");
  data_ = {{"command", summary.at("command")},
           {"version", version_of(summary)},
           {"written", time_of(folder_ / "summary.json")},
           {"notes", Json::array()},
           {"summary", summary}};
  attempt("the verdict cannot be told", [&] { data_["verdict"] = verdict_sentence(summary); });
  add_configuration();
  add_design_file(files.design_file);
  add_tables(files.tables, files.shows_all_tables);
  for (const std::string& name : files.images) add("images", name, images_of);
  for (const std::string& name : files.pictures) {
    add("pictures", name, [](const Path& path) { return Json(text_of(path).value_or("")); });
  }
  if (files.command == "sweep") {
    attempt("the best is not marked", [&] {
      data_["best_place"] = grid_place(summary.at("grid"), design_from_json(summary.at("best")));
    });
  }
  if (!missing_.empty()) {
    data_["notes"].push_back(
        fmt::format("Not in the folder, and so not on this page: {}.", fmt::join(missing_, ", ")));
  }
  return std::move(data_);
}

}  // namespace

Json page_data(const Path& folder) { return Gathering(folder).data(); }

}  // namespace nlcwfs
