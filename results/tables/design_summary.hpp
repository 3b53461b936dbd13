// Designs and performances become JSON, and designs come back.
#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"
#include "model/telescope.hpp"

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// {"mean": ..., "standard_error": ...}
nlohmann::ordered_json to_json(const MeanAndError& value);

/// A performance as every summary has it: each of performance_metrics() with mean and standard
/// error, captured_energy per plane, converged_fraction and the number of screens.
nlohmann::ordered_json to_json(const Performance& performance);

/// A design as every summary has it, without its performance: planes in m, in Talbot distances of
/// the Fried parameter and as Fresnel numbers (bench distances too behind a relay), and the
/// detector's and the reconstruction's settings.
/// @param fried_parameter  m, at the telescope's wavelength
nlohmann::ordered_json to_json(const SensorDesign& design, const Telescope& telescope,
                               double fried_parameter);

/// The design of a summary, the inverse of the above to the last bit.
/// @throws nlohmann::json::exception where a member is missing or of another type,
///         std::runtime_error where a word is none of a design's
SensorDesign design_from_json(const nlohmann::ordered_json& json);

}  // namespace nlcwfs
