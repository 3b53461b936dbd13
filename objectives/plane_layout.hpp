#pragma once

#include "model/telescope.hpp"
#include "optimizer/problem.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace nlcwfs {

/// The planes that a search may choose from, as variables without dimension: the logarithm of
/// lambda |Z| / D^2, which is the inverse Fresnel number, so that searches are equal for telescopes
/// of all sizes.
class PlaneLayout {
 public:
  virtual ~PlaneLayout() = default;

  virtual std::vector<Variable> variables() const = 0;
  virtual int choice_count() const = 0;
  /// Signed distances in m, in visiting order.
  virtual std::vector<double> planes(const SearchPoint& point) const = 0;
  /// The point whose planes are `planes`; nothing where the layout has no such design.
  virtual std::optional<SearchPoint> point_of(const std::vector<double>& planes) const = 0;
};

/// A range of distances, m.
using DistanceRange = std::pair<double, double>;

/// Where planes are searched by default: |Z| between the Fresnel numbers 200 and 2, which for the
/// paper's telescope is 2.3 to 235 km.
DistanceRange default_distance_range(const Telescope& telescope);

/// Two pairs of planes, -near, +near, -far, +far, in each of their 24 visiting orders (the
/// choices).
class SymmetricLayout final : public PlaneLayout {
 public:
  /// @throws InputError where a range is not 0 < min < max (in |Z|, m) or reaches beyond
  ///         farthest_distance()
  SymmetricLayout(const Telescope& telescope, DistanceRange near, DistanceRange far);

  std::vector<Variable> variables() const override;
  int choice_count() const override { return static_cast<int>(orders_.size()); }
  std::vector<double> planes(const SearchPoint& point) const override;
  std::optional<SearchPoint> point_of(const std::vector<double>& planes) const override;

 private:
  double length_unit_;  ///< D^2 / lambda, m
  DistanceRange near_;
  DistanceRange far_;
  /// Each visits the planes -near, +near, -far, +far, which are numbered 0 to 3.
  std::vector<std::vector<int>> orders_;
};

/// Planes anywhere, each at its own signed distance; the variables are in visiting order. A range
/// on both sides of the pupil is searched in log |Z| on each side, from the Fresnel number 200 on.
class FreeLayout final : public PlaneLayout {
 public:
  /// @param ranges  one per plane: signed distances in m
  /// @throws InputError where a range is not min < max, one of them is 0, or it reaches beyond
  ///         farthest_distance()
  FreeLayout(const Telescope& telescope, std::vector<DistanceRange> ranges);

  std::vector<Variable> variables() const override;
  int choice_count() const override { return 1; }
  std::vector<double> planes(const SearchPoint& point) const override;
  std::optional<SearchPoint> point_of(const std::vector<double>& planes) const override;

 private:
  double length_unit_;    ///< D^2 / lambda, m
  double nearest_plane_;  ///< of ranges on both sides of the pupil, m
  std::vector<DistanceRange> ranges_;
};

}  // namespace nlcwfs
