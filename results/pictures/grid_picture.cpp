// A sweep's grid is drawn, with its best and the path of a search.
#include "results/pictures/grid_picture.hpp"

#include "objectives/design_space.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/pictures/map_picture.hpp"
#include "results/tables/json_numbers.hpp"
#include "results/text/axis_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <boost/algorithm/string/case_conv.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// An axis of the grid as it is drawn.
struct GridPictureAxis {
  explicit GridPictureAxis(const Json& axis);

  /// Where a design stands on it; NaN where nowhere.
  /// @param orders  that the grid has: they say which pair it calls near
  double place_of(const SensorDesign& design, const std::vector<std::string>& orders) const;

  std::string name;
  std::string si_unit;
  std::vector<double> si_values;  ///< those of words are their numbers
  PictureAxis drawn;
  double unit = 1.0;  ///< of what is drawn, SI
};

GridPictureAxis::GridPictureAxis(const Json& axis) : name(axis.at("name")) {
  drawn.label = label_of(name);
  for (const Json& value : axis.at("values")) {
    if (value.is_string()) {
      drawn.values.push_back(double(drawn.words.size()));
      drawn.words.push_back(value);
    } else {
      drawn.values.push_back(value);
    }
  }
  if (!drawn.words.empty() && drawn.words.size() != drawn.values.size()) {
    throw std::runtime_error(fmt::format("the axis {} has words and numbers", name));
  }
  si_unit = axis.at("unit");
  si_values = drawn.values;
  const AxisUnit shown = axis_unit_of(si_unit, si_values);
  unit = shown.size;
  drawn.label += shown.suffix();
  for (double& value : drawn.values) value /= unit;
}

std::string word_of(const VisitingOrder& order) { return fmt::format("{}", fmt::join(order, "")); }

double GridPictureAxis::place_of(const SensorDesign& design,
                                 const std::vector<std::string>& orders) const {
  if (name == "plane_count") return double(design.planes.size());
  const std::vector<SymmetricPlanes> namings = symmetric_namings(design.planes);
  auto pairs = std::ranges::find_if(namings, [&](const SymmetricPlanes& naming) {
    return std::ranges::count(orders, word_of(naming.order)) > 0;
  });
  if (pairs == namings.end()) pairs = namings.begin();
  const bool is_symmetric = !namings.empty();
  const auto* const pair = std::ranges::find(pair_names, name);
  if (pair != pair_names.end()) {
    const auto index = static_cast<std::size_t>(pair - pair_names.begin());
    return is_symmetric && index < pairs->pairs.size() ? pairs->pairs[index] / unit : nan;
  }
  const auto place_of_word = [&](std::string_view word) {
    const auto found = std::ranges::find(drawn.words, word);
    return found == drawn.words.end() ? nan : double(found - drawn.words.begin());
  };
  if (name == "order") return is_symmetric ? place_of_word(word_of(pairs->order)) : nan;
  if (name.size() == 2 && name[0] == 'z') {
    const auto plane = static_cast<std::size_t>(name[1] - '1');
    return plane < design.planes.size() ? design.planes[plane] / unit : nan;
  }
  const DesignField* property = find_design_property(name);
  if (property == nullptr) return nan;
  const double value = property->get(design);
  if (drawn.words.empty()) return value / unit;
  // A word's value is its number among all words, of which the axis may have some.
  return place_of_word(property->words[static_cast<std::size_t>(value)]);
}

/// The points of a grid as they are drawn: what its axes other than those drawn have at their best.
struct DrawnGrid {
  explicit DrawnGrid(const Json& grid);

  /// Of each point that is drawn, the last axis running fastest.
  std::vector<double> values_of(const Json& matrix) const;

  std::vector<GridPictureAxis> axes;  ///< those that are drawn, in the grid's order: none to two
  bool hides_axes = false;
  std::vector<std::size_t> chosen;  ///< the grid's point that stands for each drawn one
};

DrawnGrid::DrawnGrid(const Json& grid) {
  const Json& all = grid.at("axes");
  const auto length = [&](std::size_t axis) { return all[axis].at("values").size(); };
  const std::vector<double> costs = numbers_from_json(grid.at("cost"));
  std::vector<std::size_t> drawn;
  double points = 1.0;  // may be too many for an integer
  for (std::size_t axis = 0; axis < all.size(); ++axis) {
    points *= double(length(axis));
    if (length(axis) > 1) drawn.push_back(axis);
  }
  if (points != double(costs.size())) {
    throw std::runtime_error(
        fmt::format("the grid has {} costs at {:.0f} points", costs.size(), points));
  }
  std::ranges::stable_sort(drawn, std::ranges::greater(), length);
  if (drawn.size() > 2) {
    hides_axes = true;
    drawn.resize(2);
  }
  std::ranges::sort(drawn);
  std::size_t count = 1;
  for (const std::size_t axis : drawn) {
    axes.emplace_back(all[axis]);
    count *= length(axis);
  }

  chosen.assign(count, costs.size());
  for (std::size_t point = 0; point < costs.size(); ++point) {
    std::size_t rest = point;
    std::size_t place = 0;
    std::size_t stride = 1;
    for (std::size_t axis = all.size(); axis-- > 0;) {
      if (std::ranges::count(drawn, axis) > 0) {
        place += rest % length(axis) * stride;
        stride *= length(axis);
      }
      rest /= length(axis);
    }
    std::size_t& best = chosen[place];
    const bool is_first = best == costs.size() || std::isnan(costs[best]);
    if (is_first || costs[point] < costs[best]) best = point;
  }
}

std::vector<double> DrawnGrid::values_of(const Json& matrix) const {
  const std::vector<double> all = numbers_from_json(matrix);
  std::vector<double> values;
  for (const std::size_t point : chosen) values.push_back(all.at(point));
  return values;
}

}  // namespace

void write_grid_map(const Json& grid, const std::string& figure, const std::string& unit,
                    const std::filesystem::path& path) {
  const DrawnGrid drawn(grid);
  if (drawn.axes.size() != 2) return;
  const auto axis_of = [](const GridPictureAxis& axis) {
    return FitsMapAxis{.name = boost::algorithm::to_upper_copy(axis.name),
                       .unit = axis.si_unit,
                       .values = axis.si_values,
                       .words = axis.drawn.words,
                       .description = label_of(axis.name)};
  };
  FitsMap map{.unit = unit, .x = axis_of(drawn.axes[0]), .y = axis_of(drawn.axes[1]), .values = {}};
  const std::vector<double> values = drawn.values_of(grid.at(figure));
  // They have the second axis running fastest.
  map.values = Eigen::Map<const Image<double>>(values.data(), Eigen::Index(map.x.values.size()),
                                               Eigen::Index(map.y.values.size()))
                   .transpose();
  std::filesystem::remove(path);  // of a run that was interrupted
  write_fits_map(path, map);
}

std::vector<double> grid_place(const Json& grid, const SensorDesign& design) {
  const std::vector<std::string> orders = grid.at("orders");
  std::vector<double> place;
  for (const Json& json : grid.at("axes")) {
    const GridPictureAxis axis(json);
    place.push_back(axis.place_of(design, orders) * axis.unit);
  }
  return place;
}

std::optional<std::string> write_grid_picture(const std::string& title, const Json& grid,
                                              const std::string& figure, const CostedDesign& best,
                                              const std::filesystem::path& stem,
                                              const std::optional<SearchPath>& search) {
  const DrawnGrid drawn(grid);
  const std::vector<GridPictureAxis>& axes = drawn.axes;
  if (axes.empty()) return "the grid has one value on each axis";
  const std::vector<double> values = drawn.values_of(grid.at(figure));

  const std::vector<std::string> orders = grid.at("orders");

  const auto point_of = [&](const CostedDesign& tried) {
    return PicturePoint{axes[0].place_of(tried.design, orders),
                        axes.size() > 1 ? axes[1].place_of(tried.design, orders) : tried.cost};
  };
  const auto is_on_picture = [](const PicturePoint& point) {
    return std::isfinite(point.x) && std::isfinite(point.y);
  };
  PictureOverlay overlay;
  if (search) {
    overlay.path_label = axes.size() > 1 ? "search, in its order" : "designs of the search";
    for (const CostedDesign& tried : search->designs) {
      const PicturePoint point = point_of(tried);
      if (is_on_picture(point)) overlay.path.push_back(point);
    }
    if (const PicturePoint point = point_of(search->best); is_on_picture(point)) {
      overlay.marks.push_back({"best of the search", point});
    }
  }
  // A line has the place of its best at the figure's own height.
  PicturePoint place = point_of(best);
  if (axes.size() == 1) {
    const auto& places = axes[0].drawn.values;
    const auto nearest = std::ranges::min_element(
        places, {}, [&](double value) { return std::abs(value - place.x); });
    place.y = values[static_cast<std::size_t>(nearest - places.begin())];
  }
  if (is_on_picture(place)) overlay.marks.push_back({"best of the sweep", place});

  const std::string label = label_of(figure);
  const std::string whole_title =
      drawn.hides_axes ? fmt::format("{}, at the best of the other axes", title) : title;
  if (axes.size() == 1) {
    const std::vector<double> errors = drawn.values_of(grid.at("standard_error").at(figure));
    LinePicture picture{whole_title, axes[0].drawn, label, {}, std::move(overlay)};
    for (std::size_t i = 0; i < values.size(); ++i) {
      picture.values.push_back({values[i], errors[i]});
    }
    return write_picture(picture, stem);
  }
  MapPicture picture{whole_title, axes[0].drawn, axes[1].drawn, label, {}, std::move(overlay)};
  const std::size_t rows = axes[1].drawn.values.size();
  for (std::size_t first = 0; first < values.size(); first += rows) {
    picture.values.emplace_back(values.begin() + std::ptrdiff_t(first),
                                values.begin() + std::ptrdiff_t(first + rows));
  }
  return write_picture(picture, stem);
}

}  // namespace nlcwfs
