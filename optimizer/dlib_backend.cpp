// dlib's global search of mixed variables.
#include "optimizer/dlib_backend.hpp"

#include "optimizer/latin_hypercube.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include <boost/random/mersenne_twister.hpp>
#include <dlib/global_optimization/global_function_search.h>

namespace nlcwfs {
namespace {

using DlibVector = dlib::matrix<double, 0, 1>;

/// Designs that dlib names before it hears of any of them, as threads can assess them together.
/// Fixed, as it decides the path. Measured on mixed test problems, with 100 and 300 evaluations:
/// batches of 2 to 8 lose nothing that shows beside the scatter between seeds.
constexpr int batch_size = 4;
/// Batches in a row without a new design after which the run ends. Each costs dlib more than the
/// one before, as known designs refine its model too.
constexpr int known_batches_allowed = 10;

/// dlib sees continuous variables from 0 to 1; discrete ones must stay whole numbers.
struct Box {
  int sub_space;
  const std::vector<Variable>& variables;

  std::size_t size() const { return variables.size(); }

  dlib::function_spec specification() const {
    DlibVector lower(static_cast<long>(size()));
    DlibVector upper(static_cast<long>(size()));
    std::vector<bool> is_integer;
    for (const Variable& variable : variables) {
      const auto i = static_cast<long>(is_integer.size());
      lower(i) = variable.is_continuous() ? 0.0 : variable.lower;
      upper(i) = variable.is_continuous() ? 1.0 : variable.upper;
      is_integer.push_back(!variable.is_continuous());
    }
    return {lower, upper, is_integer};
  }

  SearchPoint to_point(const DlibVector& x) const {
    SearchPoint point{sub_space, Eigen::VectorXd(x.size())};
    for (std::size_t i = 0; i < size(); ++i) {
      const auto& [name, lower, upper, kind] = variables[i];
      const double value = x(static_cast<long>(i));
      point.x[Eigen::Index(i)] =
          kind == VariableKind::continuous ? lower + value * (upper - lower) : value;
    }
    return point;
  }

  DlibVector to_dlib(const SearchPoint& point) const {
    DlibVector x(static_cast<long>(size()));
    for (std::size_t i = 0; i < size(); ++i) {
      const auto& [name, lower, upper, kind] = variables[i];
      const double value = point.x[Eigen::Index(i)];
      x(static_cast<long>(i)) =
          kind == VariableKind::continuous ? (value - lower) / (upper - lower) : value;
    }
    return x;
  }
};

/// One run, which counts what it may still evaluate and knows its worst real cost.
struct DlibRun {
  Evaluator& evaluator;
  int max_evaluations = 0;
  int first_evaluation = evaluator.evaluations();
  double worst = -std::numeric_limits<double>::infinity();

  int evaluations() const { return evaluator.evaluations() - first_evaluation; }
  bool is_over() const { return evaluations() >= max_evaluations; }

  /// The answers to the points, or to the first of them where there are too many new ones.
  std::vector<double> ask(const std::vector<SearchPoint>& points) {
    std::vector<double> answers;
    while (answers.size() < points.size() && !is_over()) {
      const auto begin = points.begin() + static_cast<std::ptrdiff_t>(answers.size());
      const auto count =
          std::min<std::ptrdiff_t>(points.end() - begin, max_evaluations - evaluations());
      const std::vector<double> more = evaluator.evaluate({begin, begin + count});
      answers.insert(answers.end(), more.begin(), more.end());
    }
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const std::optional<EvaluatedDesign> design = evaluator.known(points[i]);
      if (design && design->violation == 0.0) worst = std::max(worst, design->cost);
    }
    return answers;
  }

  /// What dlib, which maximises, is told.
  double told(double answer) const {
    return -(std::isfinite(worst) ? std::min(answer, worst) : answer);
  }
};

}  // namespace

StageResult minimize_with_dlib(Evaluator& evaluator, const std::vector<SearchPoint>& starts,
                               const StageOptions& options) {
  assert(options.max_evaluations >= 1);
  std::vector<Box> boxes;
  std::vector<dlib::function_spec> specifications;
  std::vector<SearchPoint> points = starts;
  boost::random::mt19937_64 generator(options.seed);
  for (const SubSpace& sub_space : evaluator.sub_spaces()) {
    boxes.push_back({static_cast<int>(boxes.size()), sub_space.variables});
    specifications.push_back(boxes.back().specification());
    // dlib's own first points are at random, and its model breaks down while a variable has the
    // same value in all of them, as happens to variables of few values.
    const int count = std::max(3, static_cast<int>(sub_space.variables.size()) + 1);
    const std::vector<SearchPoint> first =
        latin_hypercube(sub_space, boxes.back().sub_space, count, generator);
    points.insert(points.end(), first.begin(), first.end());
  }
  const auto box_of = [&](const SearchPoint& point) -> const Box& {
    return boxes[static_cast<std::size_t>(point.sub_space)];
  };

  DlibRun run{evaluator, options.max_evaluations};
  const std::vector<double> first_answers = run.ask(points);
  if (run.is_over()) return {run.evaluations(), false};
  std::vector<std::vector<dlib::function_evaluation>> first_evaluations(boxes.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    first_evaluations[static_cast<std::size_t>(points[i].sub_space)].emplace_back(
        box_of(points[i]).to_dlib(points[i]), run.told(first_answers[i]));
  }
  dlib::global_function_search search(specifications, first_evaluations);
  search.set_seed(static_cast<std::time_t>(options.seed));

  for (int known_batches = 0; known_batches < known_batches_allowed;) {
    std::vector<dlib::function_evaluation_request> requests;
    points.clear();
    for (int i = 0; i < batch_size; ++i) {
      requests.push_back(search.get_next_x());
      points.push_back(boxes[requests.back().function_idx()].to_point(requests.back().x()));
    }
    const int before = run.evaluations();
    const std::vector<double> answers = run.ask(points);
    if (run.is_over()) return {run.evaluations(), false};
    for (std::size_t i = 0; i < answers.size(); ++i) requests[i].set(run.told(answers[i]));
    known_batches = run.evaluations() == before ? known_batches + 1 : 0;
  }
  return {run.evaluations(), true};
}

}  // namespace nlcwfs
