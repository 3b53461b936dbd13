// NLopt's algorithms, global and local.
#include "optimizer/nlopt_backend.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
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
    Algorithm{"direct_l_rand", NLOPT_GN_DIRECT_L_RAND, SearchScope::global, 1},
    Algorithm{"crs2", NLOPT_GN_CRS2_LM, SearchScope::global, 1},
    Algorithm{"mlsl", NLOPT_G_MLSL_LDS, SearchScope::global, 1},
    Algorithm{"isres", NLOPT_GN_ISRES, SearchScope::global, 1},
    Algorithm{"esch", NLOPT_GN_ESCH, SearchScope::global, 1},
    Algorithm{"sbplx", NLOPT_LN_SBPLX, SearchScope::local, 1},
    Algorithm{"nelder_mead", NLOPT_LN_NELDERMEAD, SearchScope::local, 1},
    Algorithm{"bobyqa", NLOPT_LN_BOBYQA, SearchScope::local, 2},
    Algorithm{"cobyla", NLOPT_LN_COBYLA, SearchScope::local, 1},
    Algorithm{"praxis", NLOPT_LN_PRAXIS, SearchScope::local, 2},
};

const Algorithm& find_algorithm(std::string_view name, int variable_count) {
  const auto* const found = std::ranges::find(algorithms, name, &Algorithm::name);
  if (found == algorithms.end()) {
    throw std::invalid_argument(fmt::format("{} is no optimizer: there are dlib, {}", name,
                                            fmt::join(nlopt_algorithms(), ", ")));
  }
  if (variable_count >= found->least_variables) return *found;
  throw std::invalid_argument(
      fmt::format("{} needs at least {} continuous variable{}, this problem has {}: take {}", name,
                  found->least_variables, found->least_variables == 1 ? "" : "s", variable_count,
                  variable_count == 0 ? "dlib" : "sbplx"));
}

using NloptPointer = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

NloptPointer create(nlopt_algorithm id, int variable_count) {
  NloptPointer optimizer(nlopt_create(id, static_cast<unsigned>(variable_count)), nlopt_destroy);
  if (!optimizer) throw std::bad_alloc();
  return optimizer;
}

/// The cost as NLopt sees it, over the unit box. NLopt is C: no exception may pass through it, and
/// some of its algorithms go on asking for a while after they were told to stop.
struct Objective {
  Evaluator& evaluator;
  SearchPoint point;  ///< its continuous values are set for each question
  int max_evaluations;
  nlopt_opt optimizer;
  std::vector<Eigen::Index> indices = {};  ///< of the continuous variables in the point
  Eigen::VectorXd lower = {};
  Eigen::VectorXd range = {};
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
      point.x(indices) = lower + range.cwiseProduct(unit);
      const double cost = evaluator(point);
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

std::vector<std::string_view> nlopt_algorithms() {
  std::vector<std::string_view> names;
  for (const Algorithm& algorithm : algorithms) names.push_back(algorithm.name);
  return names;
}

SearchScope nlopt_scope(std::string_view algorithm, int variable_count) {
  return find_algorithm(algorithm, variable_count).scope;
}

StageResult minimize(std::string_view algorithm, Evaluator& evaluator, const SearchPoint& start,
                     const StageOptions& options) {
  assert(options.max_evaluations >= 1 && options.initial_step > 0.0 && options.initial_step <= 0.5);
  const std::vector<Variable>& variables = evaluator.variables_of(start);
  const int count =
      evaluator.sub_spaces()[static_cast<std::size_t>(start.sub_space)].continuous_count();
  const nlopt_algorithm id = find_algorithm(algorithm, count).id;
  const NloptPointer optimizer = create(id, count);

  Objective objective{evaluator, start, options.max_evaluations, optimizer.get()};
  objective.lower.resize(count);
  objective.range.resize(count);
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (!variables[i].is_continuous()) continue;
    const auto place = static_cast<Eigen::Index>(objective.indices.size());
    objective.lower[place] = variables[i].lower;
    objective.range[place] = variables[i].upper - variables[i].lower;
    objective.indices.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::VectorXd start_x = start.x(objective.indices);
  Eigen::VectorXd unit_x =
      (start_x - objective.lower).cwiseQuotient(objective.range).cwiseMax(0.0).cwiseMin(1.0);

  const auto cost = [](unsigned, const double* x, double*, void* data) {
    return static_cast<Objective*>(data)->answer(x);
  };
  nlopt_set_min_objective(optimizer.get(), cost, &objective);
  // praxis knows no bounds. NLopt would give it an infinite cost outside of them, and its parabolas
  // through that end in designs of NaN. The evaluator gives it the cost of the nearest point
  // inside, so it finds lowest points on the bounds (and closer than with reflection at the
  // bounds).
  if (id != NLOPT_LN_PRAXIS) {
    nlopt_set_lower_bounds1(optimizer.get(), 0.0);
    nlopt_set_upper_bounds1(optimizer.get(), 1.0);
  }
  nlopt_set_initial_step1(optimizer.get(), options.initial_step);
  nlopt_set_xtol_abs1(optimizer.get(), options.x_tolerance);
  if (id == NLOPT_G_MLSL_LDS) {
    // A local algorithm that may end in an error (bobyqa, cobyla: rounding) would end mlsl with
    // it. With 300 evaluations sbplx came five times as close as nelder_mead.
    const NloptPointer local = create(NLOPT_LN_SBPLX, count);
    nlopt_set_xtol_abs1(local.get(), options.x_tolerance);
    nlopt_set_local_optimizer(optimizer.get(), local.get());
  }
  if (id == NLOPT_GN_ISRES || id == NLOPT_GN_ESCH) {
    // NLopt's 20 (n + 1) and 40 leave a budget of hundreds only a few generations. It must not
    // depend on the limit, or a resumed run would take another path.
    nlopt_set_population(optimizer.get(), 3 * static_cast<unsigned>(count + 1));
    // isres would end as soon as a best point happened to be close to the one before.
    nlopt_set_xtol_abs1(optimizer.get(), 0.0);
  }
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
  return {objective.evaluations(), objective.evaluations() < options.max_evaluations};
}

}  // namespace nlcwfs
