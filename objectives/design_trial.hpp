// A design is tried: simulated under each condition, judged and remembered.
#pragma once

#include "model/performance.hpp"
#include "model/sensor_design.hpp"
#include "model/simulation.hpp"
#include "model/statistics.hpp"
#include "objectives/design_cost.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/trial_memory.hpp"
#include "objectives/trial_runner.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nlcwfs {

/// A seeing and a light level that designs are tried under.
struct Condition {
  std::string name;                              ///< for people: "D/r0 = 4, 100000 photons"
  std::shared_ptr<const Simulation> simulation;  ///< conditions of one seeing share it
  std::optional<double> light = {};  ///< replaces the design's photons, or photon_rate if used
  double fried_parameter = 0.0;      ///< r0 at the telescope's wavelength, m

  /// The design in the condition's light.
  SensorDesign lit(SensorDesign design) const;
};

/// A design with how it did.
struct TriedDesign {
  SensorDesign design;                    ///< that was tried
  std::vector<Performance> performances;  ///< one per condition
  /// Of each screen, aggregated over the conditions; their mean is the design's cost.
  std::vector<double> costs;
  double violation = 0.0;  ///< of the limits, in the worst condition; 0 = all kept
};

/// Tries designs under a list of conditions, and costs them. All conditions have as many screens;
/// it is meant that they share the screens' random numbers, so that screen i is the same turbulence
/// under each seeing. May be used by many threads; the result does not depend on their number.
class DesignTrial {
 public:
  /// @pre there is a condition, and all have the same number of screens
  DesignTrial(std::vector<Condition> conditions, DesignCost cost);

  /// From now on no screen of a design is simulated again that the memory knows, and what is
  /// simulated is kept in it, failures too unless keeps_failures is false.
  void remember_in(std::shared_ptr<TrialMemory> memory);

  /// From now on screens are simulated by the runner, if it is one.
  void run_on(std::shared_ptr<TrialRunner> runner);

  /// A name of all that decides on the performance of a design, and of nothing else: how it is
  /// costed does not.
  std::string identity() const;

  /// @param goes_on  asked with the costs of the first 4, 8, 16, ... screens: false ends the trial
  ///                 with these screens alone; a screen's result does not depend on it. Only asked
  ///                 where the aggregate is the mean
  /// @param watch    ends the trial where it says so, with the screens that are done under all
  ///                 conditions, one at least
  /// @throws InputError where a condition's simulation cannot have the design, std::runtime_error
  ///         where it failed when it was tried before, TrialMemoryFailed
  TriedDesign run(const SensorDesign& design,
                  const std::function<bool(std::span<const double>)>& goes_on = {},
                  const ScreenWatch& watch = {}) const;

  /// The performance of a design on `count` screens alone, of which `first` is the first, under
  /// each condition. Each screen's result is that of the trial on all of them.
  /// @throws InputError where a condition's simulation cannot have the design
  std::vector<Performance> simulate(const SensorDesign& design, int first, int count,
                                    const ScreenWatch& watch = {}) const;

  /// A design that was tried here as if it had been tried on the first screens alone.
  /// @pre it was tried on `count` screens at least
  TriedDesign on_first_screens(TriedDesign tried, std::size_t count) const;

  /// A metric of a design that was tried here: its mean over all screens and conditions, and the
  /// standard error of that over the screens, which the conditions have in common.
  MeanAndError mean_of(const TriedDesign& tried, const DesignMetric& metric) const;

  /// A metric of a design that was tried here as an objective: a value of each screen, aggregated
  /// over the conditions as costs are, with the highest values as the worst ones or, where higher
  /// is better, the lowest. Their mean is the objective.
  std::vector<double> objective_of(const TriedDesign& tried, const DesignMetric& metric) const;

  /// See simulated_design.
  /// @throws InputError where a condition's simulation cannot have the design
  SensorDesign checked(SensorDesign design) const;

  /// How many wavefronts there are under each condition.
  int screen_count() const { return conditions_.front().simulation->screen_count(); }
  /// The conditions that every design is tried under.
  const std::vector<Condition>& conditions() const { return conditions_; }
  /// How performances become costs.
  const DesignCost& cost() const { return cost_; }

  /// What another process can make the same trial from, see trial_from_spec; empty where none can.
  std::string spec;

  /// Whether a failure is met again by a run that goes on, as a search must, which goes its way by
  /// what it has met. Otherwise such a run tries again.
  bool keeps_failures = true;

 private:
  /// Whether a trial of the design can have left these; anything else is not used.
  bool may_be_of(const SensorDesign& design, const std::vector<Performance>& performances) const;

  /// Of each condition, of each of its screens.
  std::vector<std::vector<double>> values_of(const TriedDesign& tried,
                                             const DesignMetric& metric) const;
  /// From the performances.
  void set_costs(TriedDesign& tried) const;

  TriedDesign simulated(const SensorDesign& design, RememberedTrial known,
                        const std::function<bool(std::span<const double>)>& goes_on,
                        const ScreenWatch& watch) const;

  std::vector<Condition> conditions_;
  DesignCost cost_;
  std::shared_ptr<TrialMemory> memory_;
  std::shared_ptr<TrialRunner> runner_;
  std::string identity_;  // empty before it was needed
};

}  // namespace nlcwfs
