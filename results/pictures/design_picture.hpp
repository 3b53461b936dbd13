// A design is drawn from the side.
#pragma once

#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace nlcwfs {

/// Draws a design from the side, with gnuplot, as SVG and as PNG: the planes along the beam to
/// scale, each with its detector's window and its number in visiting order, the pupil, the beam (as
/// wide as the pupil, and with the spread that seeing gives its light), and the Talbot distance of
/// the Fried parameter. What is there already is overwritten.
/// @param fried_parameter  m, at the telescope's wavelength
/// @param stem             the files' path without .svg and .png
/// @return why there is no picture (gnuplot is not installed, or fails); nothing where there is one
std::optional<std::string> write_design_picture(const std::string& title,
                                                const SensorDesign& design,
                                                const Telescope& telescope, double fried_parameter,
                                                const std::filesystem::path& stem);

}  // namespace nlcwfs
