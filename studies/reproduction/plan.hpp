#pragma once

#include "studies/settings/configuration.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// One run of a command that a reproduction is made of.
struct PlannedRun {
  std::string folder;           ///< below the reproduction's: "figure-3/paper-4"
  std::string command;          ///< that it runs
  Configuration configuration;  ///< all of its keys
};

/// What a reproduction may have, as reproduce.figures names it.
inline constexpr std::array<std::string_view, 9> reproduced_figures{
    "3", "4", "5", "6", "7", "8", "scaling", "response", "numerics"};

/// In which of two set-ups a study is run.
enum class StudySetup {
  paper,    ///< the paper's: data on the reconstruction's own grid, rms_change
  extended  ///< data on an extended grid, difference
};
/// Both of them.
inline constexpr std::array setups{StudySetup::paper, StudySetup::extended};
/// As names of runs have it.
std::string_view to_string(StudySetup setup);

/// D/r0 of the maps of figure 3.
inline constexpr std::array map_ratios{4, 6, 8};
/// D/r0 of the curves of figure 6.
inline constexpr std::array sampling_ratios{4, 6, 8, 10};

/// A row of Table 1 of the paper, with the ends of its bands rounded up to whole nm: 500-549 is
/// 500nm:550nm, whose middle is the paper's 525 nm. For P2 of the wide band the paper prints
/// 500-69; it can only be 500-699.
struct PaperBand {
  std::string_view name;   ///< in names of runs
  std::string_view bands;  ///< as source.bands; empty = one wavelength
  int wavelengths;         ///< per plane
};
/// The rows of the table, and light of one wavelength.
inline constexpr std::array<PaperBand, 4> paper_bands{
    {{"monochromatic", "", 1},
     {"narrow", "500nm:550nm,550nm:600nm,600nm:650nm,650nm:700nm", 25},
     {"medium", "400nm:500nm,500nm:600nm,600nm:700nm,700nm:800nm", 20},
     {"wide", "300nm:500nm,500nm:700nm,700nm:900nm,900nm:1100nm", 40}}};

/// A telescope that the paper's design is moved to, or a change of the numerics.
struct NamedSettings {
  std::string name;                                           ///< in names of runs
  std::vector<std::pair<std::string, std::string>> settings;  ///< key, value
};
/// The telescopes that the paper's design is moved to.
const std::vector<NamedSettings>& scaled_telescopes();
/// What the numerics decide: settings that are laid over the paper's.
/// @param screens  of the reproduction; two variants have more
std::vector<NamedSettings> numerical_variants(int screens);
/// The numbers of the paper that are looked at in each of these: settings, the later with evaluate
/// but for "medium-band", which takes convergence.
const std::vector<NamedSettings>& numerical_probes();

/// How many times as many wavefronts the designs at the paper's distances are evaluated on.
inline constexpr int more_screens = 16;

/// Figures that a configuration asks for.
/// @throws InputError where reproduce.figures names one that is not known
std::vector<std::string> figures_of(const Configuration& configuration);

/// How much a run takes beside others, for predictions of the time left: samples that Fourier
/// transforms see, in 1e9. Loops are guessed, and the verification of a sweep is left out.
double work_of(const PlannedRun& run);

/// Everything that these need, in the order of the paper; figures share runs.
/// @param configuration  gives the sizes (section reproduce), the screens and the search's
///                       precision; the paper's set-up is laid over its defaults
/// @throws InputError where it has another telescope, seeing, sensor or sweep than the paper's
std::vector<PlannedRun> planned_runs(const Configuration& configuration);

}  // namespace nlcwfs
