// The bands of light of the paper, which figures 7 and 8 are of.
#pragma once

#include "studies/reproduction/plan.hpp"
#include "studies/reproduction/reproduced_runs.hpp"

#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A row of Table 1 of the paper, with the ends of its bands rounded up to whole nm: 500-549 is
/// 500nm:550nm, whose middle is the paper's 525 nm. For P2 of the wide band the paper prints
/// 500-69; it can only be 500-699.
struct PaperBand {
  std::string_view name;   ///< in names of runs
  std::string_view bands;  ///< as source.bands; empty = one wavelength
  int wavelengths;         ///< per plane

  /// What a run has in this light.
  Settings settings() const {
    if (bands.empty()) return {{"seeing.d_over_r0", "6"}};
    return {{"seeing.d_over_r0", "6"},
            {"source.bands", std::string(bands)},
            {"source.wavelengths", fmt::format("{}", wavelengths)}};
  }
};
/// The middle one of the table.
inline constexpr PaperBand medium_band{"medium", "400nm:500nm,500nm:600nm,600nm:700nm,700nm:800nm",
                                       20};
/// The rows of the table, and light of one wavelength.
inline constexpr std::array<PaperBand, 4> paper_bands{
    {{"monochromatic", "", 1},
     {"narrow", "500nm:550nm,550nm:600nm,600nm:650nm,650nm:700nm", 25},
     medium_band,
     {"wide", "300nm:500nm,500nm:700nm,700nm:900nm,900nm:1100nm", 40}}};

/// Adds the run of figure 8 in this light.
inline void add_band(Plan& plan, StudySetup setup, const PaperBand& band) {
  Settings settings = band.settings();
  settings.emplace_back("detector.pupil_pixels", "128");
  plan.add(run_folder("figure-8", setup, band.name), "convergence", plan.base(setup), settings);
}

/// What its summary has of the residual after each loop, nm.
inline const nlohmann::ordered_json& residuals_of(const SetupRuns& runs, std::string_view band) {
  return runs.summary("figure-8", band).at("residual_after_loops_nm");
}

}  // namespace nlcwfs
