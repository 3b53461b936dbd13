#include "objectives/design_trial.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace nlcwfs {
namespace {

/// Screens after which a trial may end for the first time; fewer say little about the spread.
constexpr int first_block = 4;

SensorDesign under(const Condition& condition, SensorDesign design) {
  Detector& detector = design.detector;
  if (condition.light) {
    (detector.photon_rate > 0.0 ? detector.photon_rate : detector.photons) = *condition.light;
  }
  return design;
}

}  // namespace

DesignTrial::DesignTrial(std::vector<Condition> conditions, DesignCost cost)
    : conditions_(std::move(conditions)), cost_(std::move(cost)) {
  assert(!conditions_.empty());
  assert(std::ranges::all_of(conditions_, [this](const Condition& condition) {
    return condition.simulation->screen_count() == screen_count();
  }));
}

TriedDesign DesignTrial::run(const SensorDesign& design,
                             const std::function<bool(std::span<const double>)>& goes_on) const {
  TriedDesign tried{design, std::vector<Performance>(conditions_.size()), {}};
  int done = 0;
  do {
    const int next = goes_on ? std::min(std::max(first_block, 2 * done), screen_count())  //
                             : screen_count();
    for (std::size_t k = 0; k < conditions_.size(); ++k) {
      Performance block =
          conditions_[k].simulation->evaluate(under(conditions_[k], design), done, next - done);
      std::ranges::move(block.screens, std::back_inserter(tried.performances[k].screens));
    }
    done = next;
    set_costs(tried);
  } while (done < screen_count() && goes_on(tried.costs));
  return tried;
}

void DesignTrial::set_costs(TriedDesign& tried) const {
  tried.costs.assign(tried.performances.front().screens.size(), 0.0);
  tried.violation = 0.0;
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    const Condition& condition = conditions_[k];
    const SensorDesign design = under(condition, tried.design);
    const Performance& performance = tried.performances[k];
    const std::vector<double> costs =
        cost_.per_screen(performance, design, condition.fried_parameter);
    for (std::size_t i = 0; i < costs.size(); ++i) tried.costs[i] += costs[i];
    tried.violation =
        std::max(tried.violation, cost_.violation(performance, design, condition.fried_parameter));
  }
  for (double& cost : tried.costs) cost /= double(conditions_.size());
}

SensorDesign DesignTrial::checked(SensorDesign design) const {
  for (const Condition& condition : conditions_) {
    (void)condition.simulation->checked(under(condition, design));
  }
  return conditions_.front().simulation->checked(std::move(design));
}

}  // namespace nlcwfs
