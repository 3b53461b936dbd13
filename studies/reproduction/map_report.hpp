// Plane maps in the report, as the paper draws them.
#pragma once

#include "studies/reproduction/markdown_report.hpp"
#include "studies/reproduction/plane_map.hpp"

#include <string>

namespace nlcwfs {

/// What of a map is drawn.
struct DrawnMetric {
  std::string metric;  ///< as the grid of a sweep's summary names it
  std::string label;   ///< ends with the unit
  std::string unit;    ///< as FITS has it
  double scale = 1.0;  ///< what its values are multiplied by
};

/// Draws a map with Z_far to the right and Z_near upwards and the Talbot distance of r0 on both,
/// and writes it as FITS.
/// @param ratio  D/r0
/// @param name   of the files
/// @return a cell that shows it
std::string draw_map(MarkdownReport& report, const PlaneMap& map, const DrawnMetric& drawn,
                     int ratio, const std::string& title, const std::string& name);

/// The same of residual WFE and loops, with a table of both: a line for each design.
/// @return a cell that shows each of the two
Cells draw_maps(MarkdownReport& report, const PlaneMap& map, int ratio, const std::string& title,
                const std::string& name);

}  // namespace nlcwfs
