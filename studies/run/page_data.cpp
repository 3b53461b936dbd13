// The files of a run become the data of its page.
#include "studies/run/page_data.hpp"

#include "model/input_error.hpp"
#include "results/archive/output_folder.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/page/page.hpp"
#include "results/pictures/grid_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/design_summary.hpp"
#include "results/tables/json_text.hpp"
#include "results/tables/text_file.hpp"
#include "results/text/design_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <algorithm>
#include <chrono>

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
  const Setup setup(configuration);
  const DesignSpace space = search_space_of(configuration, setup.telescope, setup.simulated());
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
  Gathering(Path folder, const Command& command) : folder_(std::move(folder)), command_(command) {}

  Json data() {
    Json summary = summary_of_run(folder_);
    summary.erase("config");
    data_ = {{"command", command_.name},
             {"version", version_of(summary)},
             {"written", time_of(folder_ / "summary.json")},
             {"notes", Json::array()},
             {"summary", summary}};
    attempt("the verdict cannot be told", [&] { data_["verdict"] = command_.verdict(summary); });
    add_configuration();
    add_files();
    if (summary.contains("grid") && summary.contains("best")) {
      attempt("the best is not marked", [&] {
        data_["best_place"] = grid_place(summary.at("grid"), design_from_json(summary.at("best")));
      });
    }
    if (!missing_.empty()) {
      data_["notes"].push_back(fmt::format("Not in the folder, and so not on this page: {}.",
                                           fmt::join(missing_, ", ")));
    }
    return std::move(data_);
  }

 private:
  /// Does what may fail for want of a member or by an older configuration.
  void attempt(const std::string& what, const std::function<void()>& action) {
    try {
      action();
    } catch (const std::exception& error) {
      data_["notes"].push_back(fmt::format("{}: {}", what, error.what()));
    }
  }

  /// What the page says of the telescope, and the configurations of a front.
  void add_configuration() {
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
      data_["diameter_m"] = telescope.diameter;
      if (command_.is_of_one_seeing) {
        data_["telescope"] = telescope_line(telescope, seeing);
        data_["talbot_m"] = talbot_distance(seeing.fried_parameter, telescope.wavelength);
      } else {
        data_["telescope"] = fmt::format("{:.4g} m telescope at {}", telescope.diameter,
                                         format_length(telescope.wavelength));
      }
      const Json& summary = data_.at("summary");
      if (!summary.contains("front")) return;
      data_["front_configurations"] = front_configurations(summary.at("front"), configuration);
    });
  }

  void add_file(const std::string& name, FileRole role) {
    const Path path = folder_ / name;
    switch (role) {
      case FileRole::hidden:
        break;
      case FileRole::design:
        data_["design_configuration"] = {{"file", name}, {"text", text_of_file(path)}};
        break;
      case FileRole::table:
        data_["tables"][name] = columns_of(read_csv(path));
        break;
      case FileRole::image:
        data_["images"][name] = images_of(path);
        break;
      case FileRole::picture:
        data_["pictures"][name] = text_of_file(path);
    }
  }

  /// Those that the page shows.
  void add_files() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    for (const RunFile& file : command_.files) {
      if (file.role == FileRole::hidden) continue;
      bool is_there = false;
      for (const std::string& name : names) {
        if (!is_named(name, {&file, 1})) continue;
        is_there = true;
        attempt(name, [&] { add_file(name, file.role); });
      }
      if (!is_there && file.is_certain) missing_.push_back(file.name);
    }
  }

  Path folder_;
  const Command& command_;
  Json data_;
  std::vector<std::string> missing_;
};

}  // namespace

Json summary_of_run(const Path& folder) {
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

Json page_data(const Path& folder, const Command& command) {
  return Gathering(folder, command).data();
}

void write_page(const Path& folder, const Command& command) {
  const std::string title =
      fmt::format("nlcwfs {}: {}", command.name,
                  std::filesystem::absolute(folder).lexically_normal().filename().string());
  OutputFolder::of_earlier_run(folder).write("report.html",
                                             page_of(title, page_data(folder, command)));
}

}  // namespace nlcwfs
