// A search method is chosen by name, and run: global, then local.
#include "optimizer/chained_search.hpp"

#include "optimizer/dlib_backend.hpp"
#include "optimizer/nlopt_backend.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <fmt/format.h>

namespace nlcwfs {
namespace {

constexpr int designs_reported = 5;
constexpr std::string_view dlib_name = "dlib";

// What `auto` takes. Measured with 60 to 300 evaluations on the test problems of 2 to 6 variables,
// in boxes shifted at random and, some, in rotated coordinates: direct_l beats crs2 on all of them,
// whose first population alone takes 10 (n + 1) evaluations. sbplx copes best with failures, steps
// and ripples in the plane, but it splits more variables into groups, and where these are coupled
// nelder_mead comes 3 to 1000 times as close. bobyqa wins only where the cost is smooth.
// direct_l searches the slice of one start alone. With 24 choices in one variable that does no
// harm. With 24 slices of which some are of an integer variable, 72 in 4 sub-spaces, or 192 in one,
// dlib+nelder_mead came 1.3 to 7 times as close with 100 and 300 evaluations (dlib alone and
// dlib+sbplx in between).
/// Up to so many slices of one sub-space without integer variables are searched with direct_l.
constexpr double slices_for_direct = 32.0;

// Measured on the test problems with budgets of 60 to 300 evaluations: results change little
// between half and double of these.
/// The global stage's share of the evaluations that are left for the continuous variables.
constexpr double global_share = 0.3;
/// A slice is refined for every so many evaluations that are left.
constexpr int evaluations_per_refined_slice = 10;
/// Neighbouring slices are compared in one go up to this share of the evaluations that are left,
/// but always up to so many (the orders of four planes).
constexpr double neighbour_share = 0.25;
constexpr int neighbours_always_compared = 24;

bool is_for_direct(const std::vector<SubSpace>& sub_spaces) {
  double slices = 1.0;
  for (const Variable& variable : sub_spaces.front().variables) {
    if (variable.kind == VariableKind::integer) return false;
    if (!variable.is_continuous()) slices *= variable.upper - variable.lower + 1.0;
  }
  return sub_spaces.size() == 1 && slices <= slices_for_direct;
}

/// Continuous variables in the middle of their ranges, discrete ones at their first value.
SearchPoint centre_of(const std::vector<SubSpace>& sub_spaces, int sub_space) {
  const std::vector<Variable>& variables =
      sub_spaces[static_cast<std::size_t>(sub_space)].variables;
  SearchPoint centre{sub_space, Eigen::VectorXd(variables.size())};
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto& [name, lower, upper, kind] = variables[i];
    centre.x[Eigen::Index(i)] = kind == VariableKind::continuous ? 0.5 * (lower + upper) : lower;
  }
  return centre;
}

/// One search under way.
struct ChainedSearch {
  Evaluator& evaluator;
  SearchMethod method;
  std::vector<SearchPoint> starts;  ///< at least one
  std::uint64_t seed;
  std::uint64_t round = 0;
  std::vector<SearchStage> begun = {};  ///< with the evaluations before each

  /// Returns where nothing is left to try. @throws SearchStopped at a limit
  void run() {
    begin_stage("starts");
    evaluator.evaluate(starts);
    if (method.global == dlib_name && method.local.empty()) {
      begin_stage(method.global);
      minimize_with_dlib(evaluator, starts,
                         {.max_evaluations = std::numeric_limits<int>::max(), .seed = seed});
      return;
    }
    for (EvaluatedDesign before;;) {
      const int evaluations_before = evaluator.evaluations();
      search_globally();
      const bool all_compared = compare_neighbours();
      refine();
      // Another round would ask the same again.
      if (evaluator.evaluations() == evaluations_before) return;
      const EvaluatedDesign best = evaluator.best().value_or(EvaluatedDesign{});
      if (all_compared && !is_better(best, before)) return;
      before = best;
    }
  }

  /// The stages that evaluated anything.
  std::vector<SearchStage> stages() const {
    std::vector<SearchStage> stages;
    for (std::size_t i = 0; i < begun.size(); ++i) {
      const int end = i + 1 < begun.size() ? begun[i + 1].evaluations : evaluator.evaluations();
      const auto& [name, begin] = begun[i];
      if (end > begin) stages.push_back({name, end - begin});
    }
    return stages;
  }

  void begin_stage(std::string name) {
    begun.push_back({std::move(name), evaluator.evaluations()});
  }

  SearchPoint best_point() const {
    return evaluator.best() ? evaluator.best()->point : starts.front();
  }

  void search_globally() {
    const auto other_slices = static_cast<int>(neighbours(best_point()).size());
    const int compared = std::min(other_slices, affordable_neighbours());
    const int share = static_cast<int>(global_share * (evaluator.evaluations_left() - compared));
    if (method.global.empty() || share < 1) return;
    begin_stage(method.global);
    const bool first_round = round == 0;
    const StageOptions options{.max_evaluations = share, .seed = seed + round++};
    if (method.global == dlib_name) {
      minimize_with_dlib(evaluator, {best_point()}, options);
    } else if (method.global == "direct_l" && !first_round) {
      // direct_l itself would divide the same boxes further, round the same lowest point. With 1000
      // evaluations of Hartmann's function in shifted boxes the search with it ended in the lowest
      // region 12 times of 20, so it did 19 times.
      minimize("direct_l_rand", evaluator, best_point(), options);
    } else {
      minimize(method.global, evaluator, best_point(), options);
    }
  }

  /// One discrete variable changed at a time, to each of its other values, and the other sub-spaces
  /// with what they share with this one.
  std::vector<SearchPoint> neighbours(const SearchPoint& point) const {
    std::vector<SearchPoint> neighbours;
    for (int other = 0; other < static_cast<int>(evaluator.sub_spaces().size()); ++other) {
      if (other != point.sub_space) neighbours.push_back(moved_to_sub_space(point, other));
    }
    Eigen::Index i = 0;
    for (const Variable& variable : evaluator.variables_of(point)) {
      if (!variable.is_continuous()) {
        for (const double value : variable.outstanding_values()) {
          if (value == point.x[i]) continue;
          neighbours.push_back(point);
          neighbours.back().x[i] = value;
        }
      }
      ++i;
    }
    return neighbours;
  }

  /// The same values for variables of the same names, and those of the centre for others.
  SearchPoint moved_to_sub_space(const SearchPoint& point, int sub_space) const {
    SearchPoint moved = centre_of(evaluator.sub_spaces(), sub_space);
    const std::vector<Variable>& from = evaluator.variables_of(point);
    const std::vector<Variable>& to = evaluator.variables_of(moved);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const auto same = std::ranges::find(from, to[i].name, &Variable::name);
      if (same != from.end()) moved.x[Eigen::Index(i)] = point.x[same - from.begin()];
    }
    return moved;
  }

  int affordable_neighbours() const {
    return std::max(neighbours_always_compared,
                    static_cast<int>(neighbour_share * evaluator.evaluations_left()));
  }

  /// @return false where there were too many new ones to compare all
  bool compare_neighbours() {
    begin_stage("choices");
    std::vector<SearchPoint> points = neighbours(best_point());
    // What is known already costs nothing.
    const auto unknown = std::stable_partition(
        points.begin(), points.end(),
        [&](const SearchPoint& point) { return evaluator.was_evaluated(point); });
    const auto first_new = static_cast<std::size_t>(unknown - points.begin());
    const std::size_t affordable = first_new + static_cast<std::size_t>(affordable_neighbours());
    const bool all = points.size() <= affordable;
    if (!all) {
      boost::random::mt19937_64 generator(seed +
                                          static_cast<std::uint64_t>(evaluator.evaluations()));
      for (std::size_t i = first_new; i < affordable; ++i) {
        const boost::random::uniform_int_distribution<std::size_t> any_left(i, points.size() - 1);
        std::swap(points[i], points[any_left(generator)]);
      }
      points.resize(affordable);
    }
    evaluator.evaluate(points);
    return all;
  }

  /// Successive halving. A slice that stays in is resumed rather than begun again: minimize replays
  /// the same path through the cache.
  void refine() {
    const std::string& algorithm = method.local.empty() ? method.global : method.local;
    begin_stage(algorithm);
    std::vector<SearchPoint> kept;
    for (const EvaluatedDesign& best : evaluator.best_of_slices()) kept.push_back(best.point);
    if (kept.empty()) kept.push_back(best_point());
    const std::size_t affordable =
        1 + static_cast<std::size_t>(evaluator.evaluations_left() / evaluations_per_refined_slice);
    if (kept.size() > affordable) kept.resize(affordable);

    for (;;) {
      int rounds = 1;
      for (std::size_t count = kept.size(); count > 1; count = (count + 1) / 2) ++rounds;
      const int share = evaluator.evaluations_left() / (rounds * static_cast<int>(kept.size()));
      for (const SearchPoint& start : kept) {
        minimize(algorithm, evaluator, start,
                 {.max_evaluations = std::max(1, share), .seed = seed});
      }
      if (kept.size() == 1) return;
      std::ranges::stable_sort(kept, [&](const SearchPoint& a, const SearchPoint& b) {
        return is_better(best_of_slice(a), best_of_slice(b));
      });
      kept.resize((kept.size() + 1) / 2);
    }
  }

  EvaluatedDesign best_of_slice(const SearchPoint& point) const {
    return evaluator.best_of_slice(point).value_or(EvaluatedDesign{});
  }
};

}  // namespace

SearchMethod search_method(std::string_view optimizer, const std::vector<SubSpace>& sub_spaces) {
  int variable_count = std::numeric_limits<int>::max();
  for (const SubSpace& sub_space : sub_spaces) {
    variable_count = std::min(variable_count, sub_space.continuous_count());
  }
  if (optimizer == "auto") {
    if (variable_count == 0) return {std::string(dlib_name), ""};
    if (!is_for_direct(sub_spaces)) return {std::string(dlib_name), "nelder_mead"};
    return {"direct_l", variable_count <= 2 ? "sbplx" : "nelder_mead"};
  }
  const auto scope_of = [&](std::string_view algorithm) {
    return algorithm == dlib_name ? SearchScope::global : nlopt_scope(algorithm, variable_count);
  };
  const std::size_t plus = optimizer.find('+');
  const std::string_view first = optimizer.substr(0, plus);
  const SearchScope scope = scope_of(first);
  if (plus == std::string_view::npos) {
    return scope == SearchScope::global ? SearchMethod{std::string(first), ""}
                                        : SearchMethod{"", std::string(first)};
  }
  const std::string_view second = optimizer.substr(plus + 1);
  if (scope != SearchScope::global || scope_of(second) != SearchScope::local) {
    throw std::invalid_argument(fmt::format(
        "{} is no method: a global optimizer comes before the + and a local one after it, such as "
        "direct_l+sbplx",
        optimizer));
  }
  return {std::string(first), std::string(second)};
}

SearchResult search(Problem& problem, const SearchOptions& options) {
  Evaluator evaluator(problem, options.evaluation);
  std::vector<SearchPoint> starts = options.starts;
  if (starts.empty()) starts.push_back(centre_of(evaluator.sub_spaces(), 0));
  ChainedSearch chain{evaluator, search_method(options.optimizer, evaluator.sub_spaces()), starts,
                      options.seed};

  SearchOutcome outcome = evaluator.outcome_of([&] { chain.run(); });
  // A round that ends with the last evaluation does not know what one more would have found.
  if (outcome.termination == Termination::converged &&
      outcome.evaluations == options.evaluation.budget) {
    outcome.termination = Termination::budget_exhausted;
  }
  return {outcome, evaluator.best(), evaluator.best_designs(designs_reported), chain.stages()};
}

}  // namespace nlcwfs
