// The section sweep becomes a grid of designs.
#include "studies/settings/sweep_grid.hpp"

#include "model/input_error.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr std::string_view section = "sweep.";

/// Makes the options of the grid, from the keys and from the planes that stand.
class GridBuilder {
 public:
  GridBuilder(const Configuration& configuration, SensorDesign base);

  DesignGrid grid(const Telescope& telescope);

 private:
  void read_axes();
  void set_plane_counts();
  /// Each distance without an axis is that of the standing planes.
  void fix_distances();
  void set_orders();
  /// The order in which so many of the standing planes are visited.
  VisitingOrder standing_order(int planes) const;
  /// Says what of the standing planes could have stood for a key that is not set.
  [[noreturn]] void refuse_missing(std::string_view key, std::string_view what) const;

  bool is_symmetric() const { return options_.layout == Layout::symmetric; }

  const Configuration& configuration_;
  DesignSpaceOptions options_;
  std::optional<SymmetricPlanes> pairs_;  ///< of the standing planes
  std::vector<std::string> axes_;
};

GridBuilder::GridBuilder(const Configuration& configuration, SensorDesign base)
    : configuration_(configuration),
      options_{.base = std::move(base),
               .layout = value_of_word<Layout>(configuration.choice("sweep.layout")).value(),
               .plane_counts = {},
               .section = "sweep"},
      pairs_(symmetric_planes(options_.base.planes)) {}

DesignGrid GridBuilder::grid(const Telescope& telescope) {
  read_axes();
  set_plane_counts();
  fix_distances();
  if (is_symmetric()) {
    set_orders();
  } else if (configuration_.is_set("sweep.order")) {
    throw InputError("sweep.order", configuration_.value_text("sweep.order"),
                     "is for sweep.layout = symmetric; a free layout is visited as numbered");
  }
  return {telescope, options_, axes_, configuration_.choice("sweep.crossed_pairs") == "kept"};
}

void GridBuilder::read_axes() {
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!key.name.starts_with(section) || key.kind != Kind::axis) continue;
    const auto values = configuration_.axis(key.name);
    if (!values) continue;
    axes_.push_back(key.name.substr(section.size()));
    if (key.name == "sweep.plane_count") {
      options_.plane_counts.assign(values->begin(), values->end());
    } else {
      options_.domains.emplace(axes_.back(), *values);
    }
  }
  if (axes_.empty() && !configuration_.is_set("sweep.order")) {
    throw InputError("sweep.z_near", "not set",
                     "a sweep needs an axis, such as --sweep.z_near 5km:100km:24, or another key "
                     "of the section sweep");
  }
}

void GridBuilder::set_plane_counts() {
  std::vector<int>& counts = options_.plane_counts;
  if (!counts.empty()) return;
  auto count = static_cast<int>(options_.base.planes.size());
  if (count < 2 || count > 6) {
    throw InputError("sensor.planes", configuration_.value_text("sensor.planes"),
                     "2 to 6 planes in a sweep");
  }
  for (int plane = count + 1; plane <= 6 && !is_symmetric(); ++plane) {
    if (options_.domains.contains(fmt::format("z{}", plane))) count = plane;
  }
  counts = {count};
}

void GridBuilder::fix_distances() {
  const int most = std::ranges::max(options_.plane_counts);
  const int needed = is_symmetric() ? (most + 1) / 2 : most;
  const std::vector<double> none;
  const std::vector<double>& standing = is_symmetric() ? (pairs_ ? pairs_->pairs : none)  //
                                                       : options_.base.planes;
  for (int i = 0; i < needed; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const std::string name =
        is_symmetric() ? std::string(pair_names[index]) : fmt::format("z{}", i + 1);
    if (options_.domains.contains(name)) continue;
    if (index >= standing.size()) {
      refuse_missing("sweep." + name, is_symmetric() ? "distance of a pair" : "plane");
    }
    options_.domains.emplace(name, std::vector<double>{standing[index]});
  }
}

void GridBuilder::set_orders() {
  const std::vector<int>& counts = options_.plane_counts;
  std::vector<VisitingOrder>& orders = options_.orders;
  const bool is_set = configuration_.is_set("sweep.order");
  orders = configuration_.orders("sweep.order");
  const bool is_all = is_set && orders.empty();
  for (const int planes : counts) {
    if (is_all) {
      std::ranges::copy(all_orders(planes), std::back_inserter(orders));
    } else if (!is_set) {
      orders.push_back(standing_order(planes));
    } else if (std::ranges::count(orders, static_cast<std::size_t>(planes), &VisitingOrder::size) ==
               0) {
      throw InputError("sweep.order", configuration_.value_text("sweep.order"),
                       fmt::format("has no order of {} planes", planes), "add one, or take all");
    }
  }
  for (const VisitingOrder& order : orders) {
    if (std::ranges::count(counts, static_cast<int>(order.size())) > 0) continue;
    throw InputError(
        "sweep.order", fmt::format("{}", fmt::join(order, "")),
        fmt::format("an order of {} planes, see sweep.plane_count", fmt::join(counts, " or ")));
  }
  // Where each number of planes has one order, there is nothing to choose beside the number.
  if (is_set && (counts.size() == 1 || orders.size() > counts.size())) {
    axes_.insert(axes_.begin() + (configuration_.is_set("sweep.plane_count") ? 1 : 0), "order");
  }
}

VisitingOrder GridBuilder::standing_order(int planes) const {
  const auto count = static_cast<std::size_t>(planes);
  VisitingOrder order = pairs_ ? pairs_->order : VisitingOrder();
  if (order.size() > count) std::erase_if(order, [&](int number) { return number > planes; });
  if (order.size() != count) {
    refuse_missing("sweep.order", fmt::format("order of {} planes", planes));
  }
  return order;
}

void GridBuilder::refuse_missing(std::string_view key, std::string_view what) const {
  if (is_symmetric() && !pairs_) {
    throw InputError("sensor.planes", configuration_.value_text("sensor.planes"),
                     fmt::format("pairs -z, +z, whose {} the sweep keeps; or set {}, or "
                                 "sweep.layout = free",
                                 what, key));
  }
  throw InputError(key, "not set", fmt::format("sensor.planes has no such {}", what),
                   "give one or more");
}

}  // namespace

DesignGrid sweep_grid_of(const Configuration& configuration, const Telescope& telescope,
                         SensorDesign base) {
  return GridBuilder(configuration, std::move(base)).grid(telescope);
}

}  // namespace nlcwfs
