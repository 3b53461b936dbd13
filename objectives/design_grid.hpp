// The designs of a grid, and which of its points share one.
#pragma once

#include "objectives/design_space.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nlcwfs {

/// What a grid's designs differ in.
struct GridAxis {
  std::string name;            ///< plane_count, order, or of DesignSpaceOptions::domains
  std::vector<double> values;  ///< in SI; of order: indices of DesignSpaceOptions::orders
};

/// A design of a grid, with all the points that have it.
struct GridDesign {
  std::string key;                  ///< see design_key
  SensorDesign design;              ///< at its points
  std::vector<std::size_t> points;  ///< ascending
};

/// The designs of a space of lists, one for each combination of its axes' values. Points are
/// numbered with the last axis running fastest.
///
/// A design does not depend on axes that it has no use for: the far pair's distance where there are
/// two planes, the order where its number of planes has only one. There is no design where the
/// order is one of another number of planes, and none where pairs are crossed and shall not be.
class DesignGrid {
 public:
  static constexpr std::size_t most_points = 1'000'000;  ///< of a grid

  /// @param options  its domains are lists; in a symmetric layout each number of planes has orders
  /// @param axes     names, outermost first; what has several values must be among them
  /// @param has_crossed_pairs  whether there are designs at points whose z_near is above their
  ///                           z_far, where both are axes
  /// @throws InputError where there are more than most_points, or DesignSpace refuses the options
  DesignGrid(const Telescope& telescope, const DesignSpaceOptions& options,
             const std::vector<std::string>& axes, bool has_crossed_pairs = true);

  /// The space that the grid's designs are of.
  const DesignSpace& space() const { return space_; }
  /// The axes, outermost first.
  const std::vector<GridAxis>& axes() const { return axes_; }
  /// The visiting orders that an axis `order` chooses from.
  const std::vector<VisitingOrder>& orders() const { return orders_; }
  /// How many points there are, with and without a design.
  std::size_t size() const { return size_; }

  /// The index of a point's value on each axis.
  std::vector<std::size_t> places(std::size_t point) const;

  /// @param point  below size()
  std::optional<SensorDesign> design(std::size_t point) const;

  /// The designs that differ, in the order of their first points: where pairs are exchanged, or
  /// windows are rounded to the same pixels, points share one.
  std::vector<GridDesign> distinct_designs() const;

 private:
  /// The axis of a name; nothing where there is none.
  std::optional<std::size_t> find_axis(std::string_view name) const;

  bool has_crossed_pairs_;
  std::vector<int> plane_counts_;
  std::vector<VisitingOrder> orders_;
  std::vector<GridAxis> axes_;
  std::size_t size_;
  DesignSpace space_;
  std::vector<SubSpace> sub_spaces_;
};

}  // namespace nlcwfs
