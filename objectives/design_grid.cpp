// The designs of a grid, and which of its points share one.
#include "objectives/design_grid.hpp"

#include "model/input_error.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

std::vector<double> values_of(const DesignSpaceOptions& options, const std::string& axis) {
  if (axis == "plane_count") return {options.plane_counts.begin(), options.plane_counts.end()};
  if (axis == "order") {
    std::vector<double> indices(options.orders.size());
    std::iota(indices.begin(), indices.end(), 0.0);
    return indices;
  }
  return std::get<std::vector<double>>(options.domains.at(axis));
}

std::vector<GridAxis> axes_of(const DesignSpaceOptions& options,
                              const std::vector<std::string>& names) {
  std::vector<GridAxis> axes;
  for (const std::string& name : names) axes.push_back({name, values_of(options, name)});
  return axes;
}

/// The product of the axes' lengths.
std::size_t point_count(const std::vector<GridAxis>& axes, std::string_view section) {
  double points = 1.0;
  for (const GridAxis& axis : axes) points *= double(axis.values.size());
  if (points <= double(DesignGrid::most_points)) return static_cast<std::size_t>(points);
  const auto longest =
      std::ranges::max_element(axes, {}, [](const GridAxis& axis) { return axis.values.size(); });
  throw InputError(fmt::format("{}.{}", section, longest->name),
                   fmt::format("{} values", longest->values.size()),
                   fmt::format("with the other axes the grid has {:g} points, and at most {} are "
                               "allowed; take fewer values",
                               points, DesignGrid::most_points));
}

}  // namespace

DesignGrid::DesignGrid(const Telescope& telescope, const DesignSpaceOptions& options,
                       const std::vector<std::string>& axes, bool has_crossed_pairs)
    : has_crossed_pairs_(has_crossed_pairs),
      plane_counts_(options.plane_counts),
      orders_(options.orders),
      axes_(axes_of(options, axes)),
      size_(point_count(axes_, options.section)),
      space_(telescope, options),
      sub_spaces_(space_.sub_spaces()) {}

std::vector<std::size_t> DesignGrid::places(std::size_t point) const {
  std::vector<std::size_t> places(axes_.size());
  for (std::size_t axis = axes_.size(); axis-- > 0;) {
    places[axis] = point % axes_[axis].values.size();
    point /= axes_[axis].values.size();
  }
  return places;
}

std::optional<std::size_t> DesignGrid::find_axis(std::string_view name) const {
  const auto found = std::ranges::find(axes_, name, &GridAxis::name);
  if (found == axes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - axes_.begin());
}

std::optional<SensorDesign> DesignGrid::design(std::size_t point) const {
  const std::vector<std::size_t> places = this->places(point);
  const auto count_axis = find_axis("plane_count");
  const std::size_t sub_space = count_axis ? places[*count_axis] : 0;
  const auto planes = static_cast<std::size_t>(plane_counts_[sub_space]);

  const std::size_t variables = sub_spaces_[sub_space].variables.size();
  SearchPoint found{static_cast<int>(sub_space), Eigen::VectorXd(variables)};
  double near = 0.0;
  double far = HUGE_VAL;
  for (std::size_t variable = 0; variable < variables; ++variable) {
    const std::string name = space_.name(found.sub_space, variable);
    const auto axis = find_axis(name);
    assert(axis);
    std::size_t place = places[*axis];
    if (name == pair_names[0]) near = axes_[*axis].values[place];
    if (name == pair_names[1]) far = axes_[*axis].values[place];
    if (name == "order") {
      if (orders_[place].size() != planes) return std::nullopt;
      // The space counts the orders of each number of planes on their own.
      place = static_cast<std::size_t>(
          std::count_if(orders_.begin(), orders_.begin() + std::ptrdiff_t(place),
                        [&](const VisitingOrder& order) { return order.size() == planes; }));
    }
    found.x[Eigen::Index(variable)] = double(place);
  }
  if (near > far && !has_crossed_pairs_) return std::nullopt;
  return space_.design(found);
}

std::vector<GridDesign> DesignGrid::distinct_designs() const {
  std::vector<GridDesign> designs;
  std::map<std::string, std::size_t> known;
  for (std::size_t point = 0; point < size_; ++point) {
    std::optional<SensorDesign> here = design(point);
    if (!here) continue;
    std::string key = design_key(*here);
    const auto [found, is_new] = known.emplace(key, designs.size());
    if (is_new) designs.push_back({std::move(key), std::move(*here), {}});
    designs[found->second].points.push_back(point);
  }
  return designs;
}

}  // namespace nlcwfs
