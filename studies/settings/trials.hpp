// Screens are drawn or read, and trials made of them.
#pragma once

#include "objectives/design_trial.hpp"
#include "studies/settings/setup.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// Whether two lengths are the same but for rounding in a file.
bool is_same_length(double a, double b);

/// Where the wavefronts that designs are tried on come from: the section screens.
struct ScreenSource {
  /// As the section says.
  explicit ScreenSource(const Configuration& configuration);

  std::string file;    ///< FITS cube; empty = simulated
  int count;           ///< of the simulated ones
  std::uint64_t seed;  ///< of the simulated ones
};

/// Fresh wavefronts, which no search has seen: the section verify.
struct FreshScreens {
  /// @throws InputError where they would be those of the section screens
  explicit FreshScreens(const Configuration& configuration);

  int count;           ///< how many
  std::uint64_t seed;  ///< theirs
  int truth_factor;    ///< how many times finer the true field is
};

/// Refuses more screens than memory is allowed for, before they are made.
/// @param key, value  what asks for so many
/// @param samples     of a screen along each side
void require_memory(std::string_view key, const std::string& value, double count, int samples);

/// The wavefronts of the section screens in a seeing, simulated or from a file.
/// @param samples  of a screen along each side
/// @param notes    gets a line where screens had to be resampled
/// @param most     no more than the first so many are simulated; a file's are read all the same
/// @param watch    see generate_screens
/// @throws InputError where memory does not suffice, or the file has none
std::vector<PhaseScreen> screens_of(const ScreenSource& source, const Telescope& telescope,
                                    const Seeing& seeing, int samples,
                                    std::vector<std::string>& notes,
                                    int most = std::numeric_limits<int>::max(),
                                    const std::function<bool(int)>& watch = {});

/// What designs are tried under: the simulations of the sections screens and simulation in each
/// seeing, with each light.
/// @param setup  gets notes on the screens
DesignTrial trial_of(Setup& setup, const ScreenSource& source, Precision precision,
                     DesignCost cost);

/// The same on fresh screens.
/// @param count  how many
DesignTrial fresh_trial_of(const Setup& setup, const FreshScreens& fresh, int count,
                           Precision precision, DesignCost cost);

/// The trial that results are verified in: on all of the fresh screens, on a truth that is finer by
/// their factor, in double precision. A matched truth that is refined no longer matches the
/// reconstruction's grid, so it becomes an extended one.
DesignTrial verification_trial_of(const Setup& setup, const FreshScreens& fresh, DesignCost cost);

/// A Setup with what searches and sweeps try designs under.
struct TrialSetup : Setup {
  /// @throws InputError where values do not go together
  explicit TrialSetup(const Configuration& configuration);

  /// @param pixels_vary  see cost_of
  const DesignCost& cost(bool pixels_vary) const {
    return pixels_vary ? cost_if_varying : cost_if_not;
  }
  /// On the screens of the section screens.
  DesignTrial make_trial(bool pixels_vary);
  /// On as many fresh screens, but on 8 at least: fewer cannot tell designs apart.
  DesignTrial make_scan(bool pixels_vary) const;
  /// See verification_trial_of. A note says so where the search's screens are from a file.
  DesignTrial make_verification(bool pixels_vary);

  ScreenSource screen_source;  ///< of the search
  FreshScreens fresh;          ///< of the verification
  Precision search_precision;  ///< of trials and scans
  DesignCost cost_if_varying;  ///< of designs that differ in their pixels across the pupil
  DesignCost cost_if_not;      ///< of others
};

/// The trial that one of these functions has made, from its DesignTrial::spec: the same
/// performances, but with the costs of designs whose pixels do not vary.
/// @throws InputError where this process cannot make it, such as without screens.file
DesignTrial trial_from_spec(const std::string& spec);

}  // namespace nlcwfs
