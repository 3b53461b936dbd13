// A design is tried: simulated under each condition, judged and remembered.
#include "objectives/design_trial.hpp"

#include "model/input_error.hpp"
#include "objectives/design_space.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// Screens after which a trial may end for the first time; fewer say little about the spread.
constexpr int first_block = 4;

}  // namespace

SensorDesign Condition::lit(SensorDesign design) const {
  Detector& detector = design.detector;
  if (light) (detector.photon_rate > 0.0 ? detector.photon_rate : detector.photons) = *light;
  return design;
}

DesignTrial::DesignTrial(std::vector<Condition> conditions, DesignCost cost)
    : conditions_(std::move(conditions)), cost_(std::move(cost)) {
  assert(!conditions_.empty());
  assert(std::ranges::all_of(conditions_, [this](const Condition& condition) {
    return condition.simulation->screen_count() == screen_count();
  }));
}

void DesignTrial::remember_in(std::shared_ptr<TrialMemory> memory) {
  memory_ = std::move(memory);
  identity_ = identity();
}

void DesignTrial::run_on(std::shared_ptr<TrialRunner> runner) {
  runner_ = std::move(runner);
  if (runner_) identity_ = identity();
}

std::string DesignTrial::identity() const {
  if (!identity_.empty()) return identity_;
  std::string identity;
  for (const Condition& condition : conditions_) {
    identity += condition.simulation->identity();
    if (condition.light) identity += fmt::format(" {}", *condition.light);
    identity += ';';
  }
  return identity;
}

TriedDesign DesignTrial::run(const SensorDesign& design,
                             const std::function<bool(std::span<const double>)>& goes_on,
                             const ScreenWatch& watch) const {
  RememberedTrial known{std::vector<Performance>(conditions_.size())};
  if (!memory_) return simulated(design, std::move(known), goes_on, watch);

  const std::string text = exact_text(design);
  if (auto remembered = memory_->find(identity_, text)) {
    if (!remembered->failure.empty()) throw std::runtime_error(remembered->failure);
    if (may_be_of(design, remembered->performances)) known = std::move(*remembered);
  }
  const std::size_t known_screens = known.performances.front().screens.size();
  TriedDesign tried;
  try {
    tried = simulated(design, std::move(known), goes_on, watch);
  } catch (const InputError&) {
    throw;  // it was never tried
  } catch (const std::exception& error) {
    if (keeps_failures) {
      memory_->keep(identity_, text, {.performances = {}, .failure = error.what()});
    }
    throw;
  }
  if (tried.costs.size() > known_screens) {
    memory_->keep(identity_, text, {.performances = tried.performances});
  }
  return tried;
}

bool DesignTrial::may_be_of(const SensorDesign& design,
                            const std::vector<Performance>& performances) const {
  if (performances.size() != conditions_.size()) return false;
  const std::size_t screens = performances.front().screens.size();
  return std::ranges::all_of(performances, [&](const Performance& performance) {
    return performance.screens.size() == screens &&
           std::ranges::all_of(performance.screens, [&](const ScreenPerformance& screen) {
             return screen.captured_energy.size() == design.planes.size();
           });
  });
}

TriedDesign DesignTrial::simulated(const SensorDesign& design, RememberedTrial known,
                                   const std::function<bool(std::span<const double>)>& goes_on,
                                   const ScreenWatch& watch) const {
  TriedDesign tried{design, std::vector<Performance>(conditions_.size()), {}};
  const bool may_end = goes_on && cost_.aggregate.kind == AggregateKind::mean;
  int done = 0;
  do {
    const int next = may_end ? std::min(std::max(first_block, 2 * done), screen_count())  //
                             : screen_count();
    // As many are known under each condition.
    const auto known_screens = static_cast<int>(known.performances.front().screens.size());
    const int from = std::clamp(known_screens, done, next);
    std::vector<Performance> block(conditions_.size());
    if (from < next) {
      block = runner_ ? runner_->run(*this, design, from, next - from, watch)
                      : simulate(design, from, next - from, watch);
    }
    auto least = static_cast<std::size_t>(next);
    for (std::size_t k = 0; k < conditions_.size(); ++k) {
      std::vector<ScreenPerformance>& screens = tried.performances[k].screens;
      std::vector<ScreenPerformance>& before = known.performances[k].screens;
      for (int i = done; i < from; ++i) {
        screens.push_back(std::move(before[static_cast<std::size_t>(i)]));
      }
      std::ranges::move(block[k].screens, std::back_inserter(screens));
      least = std::min(least, screens.size());
    }
    if (least < static_cast<std::size_t>(next)) return on_first_screens(std::move(tried), least);
    done = next;
    set_costs(tried);
  } while (done < screen_count() && goes_on(tried.costs));
  return tried;
}

std::vector<Performance> DesignTrial::simulate(const SensorDesign& design, int first, int count,
                                               const ScreenWatch& watch) const {
  std::vector<Performance> performances;
  for (const Condition& condition : conditions_) {
    performances.push_back(
        condition.simulation->evaluate(condition.lit(design), first, count, watch));
  }
  return performances;
}

TriedDesign DesignTrial::on_first_screens(TriedDesign tried, std::size_t count) const {
  for (Performance& performance : tried.performances) {
    assert(performance.screens.size() >= count);
    performance.screens.resize(count);
  }
  set_costs(tried);
  return tried;
}

void DesignTrial::set_costs(TriedDesign& tried) const {
  std::vector<std::vector<double>> costs;
  tried.violation = 0.0;
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    const Condition& condition = conditions_[k];
    const SensorDesign design = condition.lit(tried.design);
    const Performance& performance = tried.performances[k];
    costs.push_back(cost_.per_screen(performance, design, condition.fried_parameter));
    tried.violation =
        std::max(tried.violation, cost_.violation(performance, design, condition.fried_parameter));
  }
  tried.costs = cost_.aggregate.per_screen(costs);
}

std::vector<std::vector<double>> DesignTrial::values_of(const TriedDesign& tried,
                                                        const DesignMetric& metric) const {
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    const Condition& condition = conditions_[k];
    const SensorDesign design = condition.lit(tried.design);
    const MetricContext context{design, cost_.operation, condition.fried_parameter};
    values.push_back(tried.performances[k].samples_of(
        [&](const ScreenPerformance& screen) { return metric.value(screen, context); }));
  }
  return values;
}

MeanAndError DesignTrial::mean_of(const TriedDesign& tried, const DesignMetric& metric) const {
  return mean_and_standard_error(CostAggregate{}.per_screen(values_of(tried, metric)));
}

std::vector<double> DesignTrial::objective_of(const TriedDesign& tried,
                                              const DesignMetric& metric) const {
  const auto minimised = [&](double& value) { value = metric.minimised(value); };
  std::vector<std::vector<double>> values = values_of(tried, metric);
  for (std::vector<double>& of_condition : values) std::ranges::for_each(of_condition, minimised);
  std::vector<double> objective = cost_.aggregate.per_screen(values);
  std::ranges::for_each(objective, minimised);
  return objective;
}

SensorDesign DesignTrial::checked(SensorDesign design) const {
  for (const Condition& condition : conditions_) {
    (void)condition.simulation->checked(condition.lit(design));
  }
  return conditions_.front().simulation->checked(std::move(design));
}

}  // namespace nlcwfs
