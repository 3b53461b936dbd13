// Problems whose answers are known, for all backends.
#pragma once

#include "optimizer/problem.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <fmt/format.h>

namespace nlcwfs {

/// The exact digits of a point: every point is its own design.
inline std::string exact_key(const SearchPoint& point) {
  std::string key = fmt::format("{}", point.sub_space);
  for (const double value : point.x) key += fmt::format(" {}", value);
  return key;
}

/// A count that threads may raise together and that is copied with its owner.
struct Counter {
  Counter() = default;
  Counter(const Counter& other) : count(other.count.load()) {}
  ~Counter() = default;
  Counter& operator=(const Counter& other) {
    count = other.count.load();
    return *this;
  }
  Counter& operator=(int value) {
    count = value;
    return *this;
  }
  void operator++() { ++count; }
  operator int() const { return count; }

  std::atomic<int> count = 0;
};

/// A problem with a known optimum, which counts how often its cost was computed.
struct TestProblem : Problem {
  using Cost = std::function<double(int choice, const Eigen::VectorXd& x)>;

  TestProblem(std::string its_name, std::vector<Variable> its_box, Cost its_function, double lowest)
      : name(std::move(its_name)),
        box(std::move(its_box)),
        function(std::move(its_function)),
        minimum(lowest) {}

  std::vector<SubSpace> sub_spaces() const override {
    std::vector<SubSpace> all = spaces;
    if (!all.empty()) return all;
    for (int choice = 0; choice < choices; ++choice)
      all.push_back({fmt::format("{}", choice), box});
    return all;
  }
  std::string key(const SearchPoint& point) const override { return key_of(point); }
  Assessment assess(const SearchPoint& point, const GoesOn& /*goes_on*/) override {
    ++calls;
    return {.costs = {function(point.sub_space, point.x)},
            .violation = excess(point.x),
            .objectives = objectives(point)};
  }

  /// A point beside the centre of the first box where every solvable problem has a cost.
  Eigen::VectorXd start() const {
    const std::vector<Variable>& first = spaces.empty() ? box : spaces.front().variables;
    Eigen::VectorXd x(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      x[i] = first[i].lower + 0.6 * (first[i].upper - first[i].lower);
      if (!first[i].is_continuous()) x[i] = std::round(x[i]);
    }
    return x;
  }

  std::string name;
  std::vector<Variable> box;
  Cost function;
  double minimum;                     ///< the lowest cost; infinity where every evaluation fails
  int choices = 1;                    ///< sub-spaces over the same box
  std::vector<SubSpace> spaces = {};  ///< where there are any, the sub-spaces instead of these
  std::function<std::string(const SearchPoint&)> key_of = exact_key;
  /// By how much a limit is exceeded.
  std::function<double(const Eigen::VectorXd&)> excess = [](const auto&) { return 0.0; };
  std::function<std::vector<double>(const SearchPoint&)> objectives = [](const auto&) {
    return std::vector<double>{};
  };
  Counter calls;
};

inline std::vector<Variable> cube(int variables, double lower, double upper) {
  std::vector<Variable> box;
  box.reserve(static_cast<std::size_t>(variables));
  for (int i = 0; i < variables; ++i) box.push_back({fmt::format("x{}", i), lower, upper});
  return box;
}

/// A smooth bowl over the logarithms of two distances, ten times as steep along one diagonal as
/// along the other; lowest, 2, at (10^4.4, 10^5.1).
inline double rotated_bowl_cost(const Eigen::VectorXd& x) {
  const double along = (x[0] - 4.4) + (x[1] - 5.1);
  const double across = (x[0] - 4.4) - (x[1] - 5.1);
  return 2.0 + along * along + 10.0 * across * across;
}

inline TestProblem rotated_bowl() {
  return {"rotated_bowl",
          {{"log_z_near", 3.5, 5.0}, {"log_z_far", 4.5, 6.0}},
          [](int, const Eigen::VectorXd& x) { return rotated_bowl_cost(x); },
          2.0};
}

/// One variable, lowest at 1/3, where the curvature is discontinuous.
inline TestProblem one_variable() {
  return {"one_variable", cube(1, -1.0, 1.0),
          [](int, const Eigen::VectorXd& x) {
            return std::abs(x[0] - 1.0 / 3.0) * (x[0] < 1.0 / 3.0 ? 1.0 : 2.0);
          },
          0.0};
}

/// Branin's function: three equal minima (Dixon & Szego 1978).
inline TestProblem branin() {
  return {"branin",
          {{"x0", -5.0, 10.0}, {"x1", 0.0, 15.0}},
          [](int, const Eigen::VectorXd& x) {
            constexpr double pi = std::numbers::pi;
            const double valley =
                x[1] - 5.1 / (4.0 * pi * pi) * x[0] * x[0] + 5.0 / pi * x[0] - 6.0;
            return valley * valley + 10.0 * (1.0 - 1.0 / (8.0 * pi)) * std::cos(x[0]) + 10.0;
          },
          0.39788735772973816};
}

/// Rastrigin's function with few, shallow local minima, lowest off the centre of the box.
inline TestProblem rastrigin() {
  return {"rastrigin", cube(2, -2.0, 2.0),
          [](int, const Eigen::VectorXd& x) {
            double sum = 0.0;
            for (const double value : x) {
              const double offset = value - 0.37;
              sum += offset * offset + 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * offset));
            }
            return sum;
          },
          0.0};
}

/// Levy's function: a long valley with ripples, lowest at (1, 1, ...) (Laguna & Marti 2005).
inline TestProblem levy(int variables) {
  return {fmt::format("levy_{}", variables), cube(variables, -10.0, 10.0),
          [](int, const Eigen::VectorXd& x) {
            constexpr double pi = std::numbers::pi;
            const auto square = [](double value) { return value * value; };
            const Eigen::ArrayXd w = 1.0 + (x.array() - 1.0) / 4.0;
            const Eigen::Index last = w.size() - 1;
            double sum = square(std::sin(pi * w[0])) +
                         square(w[last] - 1.0) * (1.0 + square(std::sin(2.0 * pi * w[last])));
            for (Eigen::Index i = 0; i < last; ++i) {
              sum += square(w[i] - 1.0) * (1.0 + 10.0 * square(std::sin(pi * w[i] + 1.0)));
            }
            return sum;
          },
          0.0};
}

/// A bowl in four logarithms of distances, coupled so that its axes differ by a factor of 30.
inline TestProblem coupled_bowl() {
  return {"coupled_bowl", cube(4, 3.5, 5.5),
          [](int, const Eigen::VectorXd& x) {
            const Eigen::Vector4d offset = x - Eigen::Vector4d(4.1, 4.6, 5.0, 4.3);
            const double sum = offset.sum();
            return 3.0 + offset.squaredNorm() + 7.0 * sum * sum;
          },
          3.0};
}

/// Hartmann's six-variable function (Dixon & Szego 1978), its minimum to 5 digits.
inline TestProblem hartmann() {
  return {"hartmann", cube(6, 0.0, 1.0),
          [](int, const Eigen::VectorXd& x) {
            static const Eigen::Matrix<double, 4, 6> scale{{10.0, 3.0, 17.0, 3.5, 1.7, 8.0},
                                                           {0.05, 10.0, 17.0, 0.1, 8.0, 14.0},
                                                           {3.0, 3.5, 1.7, 10.0, 17.0, 8.0},
                                                           {17.0, 8.0, 0.05, 10.0, 0.1, 14.0}};
            static const Eigen::Matrix<double, 4, 6> centre{
                {0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}};
            static const Eigen::Vector4d weight(1.0, 1.2, 3.0, 3.2);
            double sum = 0.0;
            for (int i = 0; i < 4; ++i) {
              const Eigen::VectorXd offset = x - centre.row(i).transpose();
              sum += weight[i] * std::exp(-scale.row(i).dot(offset.cwiseAbs2()));
            }
            return -sum;
          },
          -3.32237};
}

/// The bowl in steps with a fine ripple on top, as counts of loops over few screens make it.
inline TestProblem plateau() {
  return {"plateau",
          {{"x0", 3.5, 5.0}, {"x1", 4.5, 6.0}},
          [](int, const Eigen::VectorXd& x) {
            const double ripple = 0.01 * std::sin(4000.0 * x[0]) * std::sin(3000.0 * x[1]);
            return std::floor(10.0 * rotated_bowl_cost(x)) / 10.0 + ripple;
          },
          1.99};
}

/// Rosenbrock's function: a narrow, curved valley, lowest at (1, 1) (Rosenbrock 1960).
inline TestProblem rosenbrock() {
  return {"rosenbrock", cube(2, -2.0, 2.0),
          [](int, const Eigen::VectorXd& x) {
            const double across = x[1] - x[0] * x[0];
            const double along = 1.0 - x[0];
            return 100.0 * across * across + along * along;
          },
          0.0};
}

/// A bowl that is lowest, 1, on the middle of a side of the box, with a slope across that side.
inline TestProblem lowest_on_a_bound() {
  return {"lowest_on_a_bound", cube(2, 0.0, 1.0),
          [](int, const Eigen::VectorXd& x) { return 1.0 + x[0] + (x[1] - 0.3) * (x[1] - 0.3); },
          1.0};
}

/// Lowest, -6, in a corner of the box, with a slope along each side.
inline TestProblem lowest_in_a_corner() {
  return {"lowest_in_a_corner", cube(3, -1.0, 1.0),
          [](int, const Eigen::VectorXd& x) { return x[0] - 2.0 * x[1] + 3.0 * x[2]; }, -6.0};
}

/// A problem with noise of standard deviation 0.003 that is drawn anew for every point, but always
/// the same at the same point; its lowest cost is not below the problem's by more than 6
/// deviations.
inline TestProblem with_noise(TestProblem problem) {
  problem.name = "noisy_" + problem.name;
  problem.function = [exact = problem.function](int sub_space, const Eigen::VectorXd& x) {
    std::uint64_t seed = 0;
    for (const double value : x)
      seed = 6364136223846793005u * (seed + std::bit_cast<std::uint64_t>(value)) + 1;
    boost::random::mt19937_64 generator(seed);
    return exact(sub_space, x) + 0.003 * boost::random::normal_distribution<double>()(generator);
  };
  problem.minimum -= 0.018;
  return problem;
}

inline TestProblem noisy_bowl() { return with_noise(rotated_bowl()); }

/// The same cost everywhere.
inline TestProblem constant() {
  return {"constant", cube(2, 0.0, 1.0), [](int, const Eigen::VectorXd&) { return 0.0; }, 0.0};
}

/// 24 choices, each a bowl with its own offset and its lowest point shifted from the others' by up
/// to `shift` of the box. Offsets are up to 3 above the best choice's, which is drawn too.
inline TestProblem choices(std::uint64_t seed = 1, double shift = 0.15) {
  constexpr int count = 24;
  boost::random::mt19937_64 generator(seed);
  boost::random::uniform_real_distribution<double> uniform(0.0, 1.0);
  Eigen::Matrix2Xd centres(2, count);
  Eigen::VectorXd offsets(count);
  const Eigen::Vector2d common(0.3 + 0.4 * uniform(generator), 0.3 + 0.4 * uniform(generator));
  for (int choice = 0; choice < count; ++choice) {
    for (int i = 0; i < 2; ++i) {
      centres(i, choice) = common[i] + shift * (2.0 * uniform(generator) - 1.0);
    }
    offsets[choice] = 5.0 + 3.0 * uniform(generator);
  }
  TestProblem problem{"choices", cube(2, 0.0, 1.0),
                      [=](int choice, const Eigen::VectorXd& x) {
                        const Eigen::Vector2d offset = x - centres.col(choice);
                        const double sum = offset.sum();
                        return offsets[choice] + 10.0 * offset.squaredNorm() + 40.0 * sum * sum;
                      },
                      offsets.minCoeff()};
  problem.choices = count;
  return problem;
}

/// The bowl without an answer (NaN, infinities) in a disc round the centre of the box that nearly
/// touches the lowest point.
inline TestProblem nan_region() {
  TestProblem problem = rotated_bowl();
  problem.name = "nan_region";
  problem.function = [](int, const Eigen::VectorXd& x) {
    if (std::hypot(x[0] - 4.25, x[1] - 5.25) < 0.2) {
      return x[0] > 4.25 ? std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
    }
    return rotated_bowl_cost(x);
  };
  return problem;
}

/// The bowl, throwing beside a line that passes close to its lowest point.
inline TestProblem throwing_region() {
  TestProblem problem = rotated_bowl();
  problem.name = "throwing_region";
  problem.function = [](int, const Eigen::VectorXd& x) {
    if (x[1] < 5.05) throw std::runtime_error("the planes are too close");
    return rotated_bowl_cost(x);
  };
  return problem;
}

/// No design has a cost.
inline TestProblem all_failing() {
  return {"all_failing", cube(2, 0.0, 1.0),
          [](int, const Eigen::VectorXd&) -> double { throw std::runtime_error("no light"); },
          std::numeric_limits<double>::infinity()};
}

/// The problems that have an optimum, for every backend.
inline std::vector<TestProblem> solvable_problems() {
  return {
      one_variable(), rotated_bowl(),    branin(),     rastrigin(),         levy(4),
      coupled_bowl(), hartmann(),        plateau(),    constant(),          choices(),
      nan_region(),   throwing_region(), rosenbrock(), lowest_on_a_bound(), lowest_in_a_corner(),
      noisy_bowl()};
}

/// Sensors of 2 to 4 planes, each number a sub-space: the planes' places, a number of pixels and a
/// first guess. Lowest, 5, with 3 planes, 9 pixels and the second guess.
inline TestProblem sensors() {
  TestProblem problem{"sensors",
                      {},
                      [](int sub_space, const Eigen::VectorXd& x) {
                        static const Eigen::Vector4d places(4.1, 4.6, 5.0, 4.3);
                        const int planes = sub_space + 2;
                        Eigen::VectorXd offset = x.head(planes) - places.head(planes);
                        const double guess = x[planes + 1];
                        offset[0] += 0.2 * (1.0 - guess);
                        const double sum = offset.sum();
                        const double pixels = (x[planes] - 9.0) / 4.0;
                        return 5.0 + 0.4 * std::abs(sub_space - 1) + 0.5 * (1.0 - guess) +
                               offset.squaredNorm() + 2.0 * sum * sum + pixels * pixels;
                      },
                      5.0};
  for (int planes = 2; planes <= 4; ++planes) {
    SubSpace space{fmt::format("{} planes", planes), {}};
    for (int i = 1; i <= planes; ++i) {
      space.variables.push_back({fmt::format("log_z{}", i), 3.5, 5.5});
    }
    space.variables.push_back({"pixels", 4.0, 12.0, VariableKind::integer});
    space.variables.push_back({"guess", 0.0, 1.0, VariableKind::categorical});
    problem.spaces.push_back(space);
  }
  return problem;
}

/// No continuous variable: lowest, 0, at (21, 6) of the fourth of eight kinds.
inline TestProblem whole_numbers() {
  return {"whole_numbers",
          {{"n", 1.0, 30.0, VariableKind::integer},
           {"m", 0.0, 20.0, VariableKind::integer},
           {"kind", 0.0, 7.0, VariableKind::categorical}},
          [](int, const Eigen::VectorXd& x) {
            const double n = (x[0] - 21.0) / 10.0;
            const double m = (x[1] - 6.0) / 8.0;
            return n * n + m * m + n * m + (x[2] == 3.0 ? 0.0 : 0.2 + 0.1 * x[2]);
          },
          0.0};
}

/// A limit, n (1 - x) <= 4, which the lowest point, n = 6 and x = 1/3, lies on.
inline TestProblem limited() {
  TestProblem problem{"limited",
                      {{"x", 0.0, 1.0}, {"n", 1.0, 8.0, VariableKind::integer}},
                      [](int, const Eigen::VectorXd& x) {
                        return 1.0 + 4.0 * (x[0] - 0.2) * (x[0] - 0.2) + 3.0 / x[1];
                      },
                      1.5 + 16.0 / 225.0};
  problem.excess = [](const Eigen::VectorXd& x) {
    return std::max(0.0, (x[1] * (1.0 - x[0]) - 4.0) / 4.0);
  };
  return problem;
}

/// The sensors without an answer where the first two planes are close to each other, as they are
/// not at the lowest point.
inline TestProblem failing_sensors() {
  TestProblem problem = sensors();
  problem.name = "failing_sensors";
  problem.function = [exact = problem.function](int sub_space, const Eigen::VectorXd& x) {
    if (x[1] - x[0] < 0.2 && x[1] > x[0]) throw std::runtime_error("the planes are too close");
    if (x[0] > 5.2) return std::numeric_limits<double>::quiet_NaN();
    return exact(sub_space, x);
  };
  return problem;
}

/// Problems with discrete variables, for every backend that searches these.
inline std::vector<TestProblem> mixed_problems() {
  return {sensors(), whole_numbers(), limited(), with_noise(sensors()), failing_sensors()};
}

/// Zitzler, Deb & Thiele's first problem (2000): two objectives whose front is f2 = 1 - sqrt(f1).
inline TestProblem zdt1() {
  TestProblem problem{"zdt1", cube(4, 0.0, 1.0), [](int, const Eigen::VectorXd& x) { return x[0]; },
                      0.0};
  problem.objectives = [](const SearchPoint& point) {
    const double g = 1.0 + 9.0 * point.x.tail(point.x.size() - 1).mean();
    return std::vector{point.x[0], g * (1.0 - std::sqrt(point.x[0] / g))};
  };
  return problem;
}

/// A problem's cost against the size of the design: its planes, pixels and distances.
inline TestProblem with_size(TestProblem problem) {
  problem.objectives = [cost = problem.function](const SearchPoint& point) {
    return std::vector{cost(point.sub_space, point.x), point.x.sum() + 5.0 * point.sub_space};
  };
  return problem;
}

/// Problems of several objectives, all with discrete variables but the first.
inline std::vector<TestProblem> pareto_problems() {
  std::vector<TestProblem> problems{zdt1()};
  for (TestProblem& problem : mixed_problems()) {
    problems.push_back(with_size(std::move(problem)));
  }
  TestProblem three = with_size(sensors());
  three.name = "three_objectives";
  three.objectives = [two = three.objectives](const SearchPoint& point) {
    std::vector<double> all = two(point);
    all.push_back(std::abs(point.x[0] - 4.8));
    return all;
  };
  problems.push_back(three);
  return problems;
}

}  // namespace nlcwfs
