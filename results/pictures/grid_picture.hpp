// A sweep's grid is drawn, with its best and the path of a search.
#pragma once

#include "model/sensor_design.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A design with what it costs.
struct CostedDesign {
  SensorDesign design;  ///< whose place on the grid is marked
  double cost;          ///< NaN where it is not known
};

/// A search to draw over a grid.
struct SearchPath {
  std::vector<CostedDesign> designs;  ///< in the order of their evaluation
  CostedDesign best;                  ///< of them
};

/// Writes a figure of a sweep's grid as a FITS map over the axes that its picture has, in SI;
/// nothing where that has not two.
/// @param grid    the object `grid` of a sweep's summary
/// @param figure  one of its matrices: "cost", "residual_wfe_nm", ...
/// @param unit    of the figure, as FITS has it
/// @param path    of the file, which is replaced
/// @throws std::runtime_error with path and cause where it cannot be written
void write_grid_map(const nlohmann::ordered_json& grid, const std::string& figure,
                    const std::string& unit, const std::filesystem::path& path);

/// Draws a figure of a sweep's grid: a map over two axes, a line over one. Of more axes than two,
/// the two of the most values are drawn, and at each of their points the design of the others that
/// costs the least.
/// @param title   of what the designs are for
/// @param grid    the object `grid` of a sweep's summary
/// @param figure  one of its matrices: "cost", "residual_wfe_nm", ...
/// @param best    of the sweep
/// @param stem    the files' path without .svg and .png
/// @return why there is no picture; nothing where there is one
std::optional<std::string> write_grid_picture(const std::string& title,
                                              const nlohmann::ordered_json& grid,
                                              const std::string& figure, const CostedDesign& best,
                                              const std::filesystem::path& stem,
                                              const std::optional<SearchPath>& search = {});

/// Where a design stands on each axis of a sweep's grid: the axis' value, or the number of its word
/// among the axis' words; NaN where nowhere.
std::vector<double> grid_place(const nlohmann::ordered_json& grid, const SensorDesign& design);

}  // namespace nlcwfs
