// An independent reconstruction of a comatic wavefront, to be held against.
#pragma once

#include "model/pupil.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"
#include "tests/paths.hpp"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// The independent values of tests/reference for a comatic beam on a periodic 256 x 256 grid.
inline nlohmann::json coma_reference() {
  std::ifstream file(test_reference_folder() + "/fresnel-gs-coma.json");
  return nlohmann::json::parse(file);
}

inline constexpr int coma_grid = 256;
inline constexpr int coma_pupil_samples = 64;

/// phi = coefficient (3 r^3 - 2 r) cos(theta), rad, over the square around the pupil.
inline PhaseScreen coma_phase(double coefficient, int samples = coma_pupil_samples) {
  PhaseScreen phase(samples, samples);
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const double y = (row - 0.5 * (samples - 1)) / (0.5 * samples);
      const double x = (column - 0.5 * (samples - 1)) / (0.5 * samples);
      const double r = std::hypot(x, y);
      phase(row, column) = coefficient * (3.0 * r * r * r - 2.0 * r) * std::cos(std::atan2(y, x));
    }
  }
  return phase;
}

/// The comatic pupil field in the middle of the periodic grid.
inline Field<double> coma_field(double coefficient) {
  const int border = (coma_grid - coma_pupil_samples) / 2;
  Field<double> field = Field<double>::Zero(coma_grid, coma_grid);
  field.block(border, border, coma_pupil_samples, coma_pupil_samples) =
      pupil_field(coma_phase(coefficient), pupil_mask(coma_pupil_samples, 0.0));
  return field;
}

}  // namespace nlcwfs
