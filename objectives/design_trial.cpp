#include "objectives/design_trial.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace nlcwfs {
namespace {

/// Screens after which a trial may end for the first time; fewer say little about the spread.
constexpr int first_block = 4;

SensorDesign under(const Condition& condition, SensorDesign design) {
  if (condition.light) design.detector.photons = *condition.light;
  return design;
}

/// Of each screen: the mean over the conditions.
std::vector<double> costs_of(const TriedDesign& tried, const DesignCost& cost) {
  std::vector<double> costs(tried.performances.front().screens.size());
  for (const Performance& performance : tried.performances) {
    const std::vector<double> of_condition = cost.per_screen(performance, tried.design);
    for (std::size_t i = 0; i < costs.size(); ++i) costs[i] += of_condition[i];
  }
  for (double& value : costs) value /= double(tried.performances.size());
  return costs;
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
    tried.costs = costs_of(tried, cost_);
  } while (done < screen_count() && goes_on(tried.costs));
  return tried;
}

SensorDesign DesignTrial::checked(SensorDesign design) const {
  for (const Condition& condition : conditions_) {
    (void)condition.simulation->checked(under(condition, design));
  }
  return conditions_.front().simulation->checked(std::move(design));
}

}  // namespace nlcwfs
