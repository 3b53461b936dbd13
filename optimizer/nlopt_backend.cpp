#include "optimizer/nlopt_backend.hpp"

#include <array>
#include <cassert>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlopt.h>

namespace nlcwfs {
namespace {

struct Algorithm {
  std::string_view name;
  nlopt_algorithm id;
  SearchScope scope;
  int least_variables;
};

constexpr std::array algorithms{
    Algorithm{"direct_l", NLOPT_GN_DIRECT_L, SearchScope::global, 1},
    Algorithm{"crs2", NLOPT_GN_CRS2_LM, SearchScope::global, 1},
    Algorithm{"sbplx", NLOPT_LN_SBPLX, SearchScope::local, 1},
    Algorithm{"nelder_mead", NLOPT_LN_NELDERMEAD, SearchScope::local, 1},
    Algorithm{"bobyqa", NLOPT_LN_BOBYQA, SearchScope::local, 2},
    Algorithm{"cobyla", NLOPT_LN_COBYLA, SearchScope::local, 1},
};

const Algorithm& find_algorithm(std::string_view name, int variable_count) {
  std::string names;
  for (const Algorithm& algorithm : algorithms) {
    if (algorithm.name == name) {
      if (variable_count >= algorithm.least_variables) return algorithm;
      throw std::invalid_argument(
          fmt::format("{} needs at least {} variables, this problem has {}: take sbplx", name,
                      algorithm.least_variables, variable_count));
    }
    names += fmt::format("{}{}", names.empty() ? "" : ", ", algorithm.name);
  }
  throw std::invalid_argument(fmt::format("{} is no optimizer: there are {}", name, names));
}

/// The cost as NLopt sees it, over the unit box. NLopt is C: no exception may pass through it, and
/// some of its algorithms go on asking for a while after they were told to stop.
struct Objective {
  Evaluator& evaluator;
  int choice;
  int max_evaluations;
  nlopt_opt optimizer;
  Eigen::VectorXd lower;
  Eigen::VectorXd range;
  int first_evaluation = evaluator.evaluations();
  bool stopped = false;
  std::exception_ptr error = nullptr;

  int evaluations() const { return evaluator.evaluations() - first_evaluation; }

  double answer(const double* unit_x) {
    const Eigen::Map<const Eigen::VectorXd> unit(unit_x, lower.size());
    // An algorithm whose model broke down asks for the cost of NaN: its run is over.
    if (!unit.allFinite()) stop();
    if (stopped) return 0.0;
    try {
      const double cost = evaluator({choice, lower + range.cwiseProduct(unit)});
      if (evaluations() >= max_evaluations) stop();
      return cost;
    } catch (...) {
      error = std::current_exception();
      stop();
      return 0.0;
    }
  }

  void stop() {
    stopped = true;
    nlopt_force_stop(optimizer);
  }
};

}  // namespace

SearchScope nlopt_scope(std::string_view algorithm, int variable_count) {
  return find_algorithm(algorithm, variable_count).scope;
}

StageResult minimize(std::string_view algorithm, Evaluator& evaluator, int choice,
                     const Eigen::VectorXd& start, const StageOptions& options) {
  assert(options.max_evaluations >= 1 && options.initial_step > 0.0 && options.initial_step <= 0.5);
  const std::vector<Variable>& variables = evaluator.variables();
  const int count = static_cast<int>(variables.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(
      nlopt_create(find_algorithm(algorithm, count).id, static_cast<unsigned>(count)),
      nlopt_destroy);
  if (!optimizer) throw std::bad_alloc();

  Objective objective{evaluator,
                      choice,
                      options.max_evaluations,
                      optimizer.get(),
                      Eigen::VectorXd(count),
                      Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    objective.lower[i] = variables[i].lower;
    objective.range[i] = variables[i].upper - variables[i].lower;
  }
  Eigen::VectorXd unit_x =
      (start - objective.lower).cwiseQuotient(objective.range).cwiseMax(0.0).cwiseMin(1.0);

  const auto cost = [](unsigned, const double* x, double*, void* data) {
    return static_cast<Objective*>(data)->answer(x);
  };
  nlopt_set_min_objective(optimizer.get(), cost, &objective);
  nlopt_set_lower_bounds1(optimizer.get(), 0.0);
  nlopt_set_upper_bounds1(optimizer.get(), 1.0);
  nlopt_set_initial_step1(optimizer.get(), options.initial_step);
  nlopt_set_xtol_abs1(optimizer.get(), options.x_tolerance);
  // The evaluator counts what costs. This only ends an algorithm that would go round for ever in
  // designs that are known, and leaves room to replay all of them.
  nlopt_set_maxeval(optimizer.get(), 10 * (evaluator.evaluations() + options.max_evaluations));
  nlopt_srand(options.seed);

  double ignored_cost = 0.0;
  const nlopt_result result = nlopt_optimize(optimizer.get(), unit_x.data(), &ignored_cost);
  if (objective.error) std::rethrow_exception(objective.error);
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  if (result == NLOPT_INVALID_ARGS) {
    const char* reason = nlopt_get_errmsg(optimizer.get());
    throw std::logic_error(
        fmt::format("NLopt refuses {}: {}", algorithm, reason ? reason : "invalid arguments"));
  }
  // Any other result, NLopt's failures included, says only that the run ended.
  return {objective.evaluations(), !objective.stopped};
}

}  // namespace nlcwfs
