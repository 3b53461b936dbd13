// A wrapped phase becomes a continuous one.
#include "model/phase_unwrapping.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/SparseCholesky>

namespace nlcwfs {
namespace {

using std::numbers::pi;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Disjoint regions of samples; every sample knows its whole cycles relative to its region's root.
class Regions {
 public:
  explicit Regions(std::size_t samples) : parents_(samples), cycles_(samples), sizes_(samples, 1) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  /// Merging the smaller into the larger region bounds the depth of the recursion by log2.
  int root(int sample) {
    const int parent = parents_[sample];
    if (parent == sample) return sample;
    parents_[sample] = root(parent);
    cycles_[sample] += cycles_[parent];
    return parents_[sample];
  }

  /// Cycles relative to the root, which root() has just brought up to date.
  int cycles(int sample) {
    root(sample);
    return cycles_[sample];
  }

  /// Joins the two samples' regions so that cycles(second) = cycles(first) + step, unless they are
  /// one already.
  void merge(int first, int second, int step) {
    int large = root(first);
    int small = root(second);
    if (large == small) return;
    int shift = cycles_[first] + step - cycles_[second];
    if (sizes_[large] < sizes_[small]) {
      std::swap(large, small);
      shift = -shift;
    }
    parents_[small] = large;
    cycles_[small] = shift;
    sizes_[large] += sizes_[small];
  }

 private:
  std::vector<int> parents_;
  std::vector<int> cycles_;
  std::vector<int> sizes_;
};

}  // namespace

PhaseUnwrapper::PhaseUnwrapper(const PupilMask& mask, UnwrappingMethod method)
    : rows_(mask.rows()), columns_(mask.cols()), method_(method) {
  assert(mask.any());
  Eigen::ArrayXXi number(rows_, columns_);
  for (Eigen::Index row = 0; row < rows_; ++row) {
    for (Eigen::Index column = 0; column < columns_; ++column) {
      if (!mask(row, column)) continue;
      const int sample = static_cast<int>(samples_.size());
      number(row, column) = sample;
      samples_.push_back(row * columns_ + column);
      if (column > 0 && mask(row, column - 1)) edges_.push_back({number(row, column - 1), sample});
      if (row > 0 && mask(row - 1, column)) edges_.push_back({number(row - 1, column), sample});
    }
  }
  if (method_ == UnwrappingMethod::least_squares) sort_samples_for_elimination();

  Regions regions(samples_.size());
  for (const Edge& edge : edges_) regions.merge(edge.first, edge.second, 0);
  std::vector<int> part_of_root(samples_.size(), -1);
  for (int sample = 0; sample < std::ssize(samples_); ++sample) {
    int& part = part_of_root[regions.root(sample)];
    if (part < 0) part = part_count_++;
    parts_.push_back(part);
  }
}

void PhaseUnwrapper::sort_samples_for_elimination() {
  const auto count = std::ssize(samples_);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(samples_.size() + 2 * edges_.size());
  for (int sample = 0; sample < count; ++sample) entries.emplace_back(sample, sample, 1.0);
  for (const Edge& edge : edges_) {
    entries.emplace_back(edge.first, edge.second, 1.0);
    entries.emplace_back(edge.second, edge.first, 1.0);
  }
  SparseMatrix pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(pattern, order);

  std::vector<int> place(samples_.size());
  std::vector<Eigen::Index> sorted(samples_.size());
  for (int rank = 0; rank < count; ++rank) {
    place[order.indices()[rank]] = rank;
    sorted[rank] = samples_[order.indices()[rank]];
  }
  samples_ = std::move(sorted);
  for (Edge& edge : edges_) edge = {place[edge.first], place[edge.second]};
}

Image<double> PhaseUnwrapper::unwrap(const Field<double>& field) const {
  assert(field.rows() == rows_ && field.cols() == columns_);
  const auto count = std::ssize(samples_);
  const auto edge_count = std::ssize(edges_);

  Eigen::ArrayXcd values(count);
  for (Eigen::Index i = 0; i < count; ++i) values[i] = field.data()[samples_[i]];
  // arg(-0 + 0i) is pi, hence the select; the smallest number keeps a dark field from dividing 0/0.
  const Eigen::ArrayXd phase = (values == 0.0).select(0.0, values.arg());
  const Eigen::ArrayXd intensity = values.abs2().max(std::numeric_limits<double>::min());
  const double mean_intensity = intensity.mean();
  assert(std::isfinite(mean_intensity));

  const Eigen::ArrayXd noise = mean_intensity / intensity;
  std::vector<int> steps(edges_.size());
  Eigen::ArrayXd quality(edge_count);
  for (Eigen::Index i = 0; i < edge_count; ++i) {
    const auto [first, second] = edges_[i];
    const double cycles = (phase[second] - phase[first]) / (2.0 * pi);
    const double nearest = std::round(cycles);
    steps[i] = -static_cast<int>(nearest);
    quality[i] =
        (1.0 - 2.0 * std::abs(cycles - nearest)) * 12.0 / (10.0 + noise[first] + noise[second]);
  }

  const std::vector<int> cycles = method_ == UnwrappingMethod::quality_guided
                                      ? quality_guided_cycles(steps, quality)
                                      : least_squares_cycles(values, phase, steps, quality);
  Eigen::ArrayXd unwrapped(count);
  Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(part_count_);
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(part_count_);
  for (Eigen::Index i = 0; i < count; ++i) {
    unwrapped[i] = phase[i] + 2.0 * pi * cycles[i];
    sums[parts_[i]] += unwrapped[i];
    sizes[parts_[i]] += 1.0;
  }
  const Eigen::ArrayXd piston = 2.0 * pi * ((sums / sizes - pi) / (2.0 * pi)).ceil();
  Image<double> result = Image<double>::Zero(rows_, columns_);
  for (Eigen::Index i = 0; i < count; ++i) {
    result.data()[samples_[i]] = unwrapped[i] - piston[parts_[i]];
  }
  return result;
}

std::vector<int> PhaseUnwrapper::quality_guided_cycles(const std::vector<int>& steps,
                                                       const Eigen::ArrayXd& quality) const {
  std::vector<std::pair<double, int>> surest_first(edges_.size());
  for (int i = 0; i < std::ssize(edges_); ++i) surest_first[i] = {quality[i], i};
  std::sort(surest_first.begin(), surest_first.end(), std::greater<>());

  Regions regions(samples_.size());
  for (const auto& [edge_quality, i] : surest_first) {
    regions.merge(edges_[i].first, edges_[i].second, steps[i]);
  }
  std::vector<int> cycles(samples_.size());
  for (int i = 0; i < std::ssize(samples_); ++i) cycles[i] = regions.cycles(i);
  return cycles;
}

std::vector<int> PhaseUnwrapper::least_squares_cycles(const Eigen::ArrayXcd& field,
                                                      const Eigen::ArrayXd& phase,
                                                      const std::vector<int>& steps,
                                                      const Eigen::ArrayXd& quality) const {
  // The floor keeps the matrix regular where the field is dark, and is too small to matter
  // elsewhere.
  constexpr double smallest_weight = 1e-6;
  const auto count = std::ssize(samples_);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(edges_.size() + samples_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto [first, second] = edges_[i];
    const double weight = smallest_weight + std::pow(quality[static_cast<Eigen::Index>(i)], 4);
    const double flow = weight * (phase[second] - phase[first] + 2.0 * pi * steps[i]);
    diagonal[first] += weight;
    diagonal[second] += weight;
    right_side[first] -= flow;
    right_side[second] += flow;
    entries.emplace_back(std::max(first, second), std::min(first, second), -weight);
  }
  // Every part's piston is free: hold its first sample at 0, which costs nothing.
  std::vector<bool> held(part_count_, false);
  for (int i = 0; i < count; ++i) {
    if (!held[parts_[i]]) diagonal[i] += 1.0;
    held[parts_[i]] = true;
    entries.emplace_back(i, i, diagonal[i]);
  }
  SparseMatrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(
      matrix);
  if (factor.info() != Eigen::Success) {
    throw std::runtime_error("the phase could not be unwrapped: its normal matrix is singular");
  }
  const Eigen::ArrayXd solution = factor.solve(right_side).array();

  Eigen::ArrayXcd phasor_means = Eigen::ArrayXcd::Zero(part_count_);
  for (Eigen::Index i = 0; i < count; ++i) {
    phasor_means[parts_[i]] += field[i] * std::polar(1.0, -solution[i]);
  }
  std::vector<int> cycles(samples_.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const double target = solution[i] + std::arg(phasor_means[parts_[i]]);
    cycles[i] = static_cast<int>(std::round((target - phase[i]) / (2.0 * pi)));
  }
  return cycles;
}

}  // namespace nlcwfs
