// What a search may choose becomes points, and points become sensors.
#include "objectives/design_space.hpp"

#include "model/bound_text.hpp"
#include "model/input_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr double nearest_fresnel_number = 200.0;
constexpr double farthest_fresnel_number = 2.0;
constexpr int most_planes = 6;

bool is_equal(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }

/// Values come back from their logarithms with a rounding error, also at the ends of a range.
bool is_within(double lower, double upper, double value) {
  return (value >= lower || is_equal(value, lower)) && (value <= upper || is_equal(value, upper));
}

int pair_count(int planes) { return (planes + 1) / 2; }

std::vector<double> visited(const VisitingOrder& order, const std::vector<double>& pairs) {
  std::vector<double> planes;
  for (const int number : order) {
    const double distance = pairs[static_cast<std::size_t>((number - 1) / 2)];
    planes.push_back(number % 2 == 1 ? -distance : distance);
  }
  return planes;
}

/// The width in samples, an even number of at least a pupil's, that is nearest to a window.
int rounded_width(double window, int samples) {
  return std::max(2 * static_cast<int>(std::lround(0.5 * window * samples)), samples);
}

std::string text_of(const ValueRange& range) {
  return fmt::format("{:g}:{:g}", range.lower, range.upper);
}

std::string text_of(const Domain& domain) {
  if (const auto* range = std::get_if<ValueRange>(&domain)) return text_of(*range);
  return fmt::format("{:g}", fmt::join(std::get<std::vector<double>>(domain), ","));
}

/// @param both_sides  of the pupil; otherwise distances are above 0
void require_distances(const std::string& key, const Domain& domain, bool both_sides,
                       const Telescope& telescope) {
  const double farthest = farthest_distance(telescope);
  const auto require_near_enough = [&](double z, const std::string& value) {
    if (std::abs(z) <= farthest) return;
    throw InputError(
        key, value,
        fmt::format("within +-{}, the farthest that a plane may be", bound_text(farthest)));
  };
  if (const auto* list = std::get_if<std::vector<double>>(&domain)) {
    for (const double z : *list) {
      if (!both_sides && !(z > 0.0)) {
        throw InputError(key, fmt::format("{:g}", z),
                         "above 0: the distance of a pair, such as 47km");
      }
      require_near_enough(z, fmt::format("{:g}", z));
    }
    return;
  }
  const auto& range = std::get<ValueRange>(domain);
  if (!(range.lower < range.upper) || range.lower == 0.0 || range.upper == 0.0 ||
      (!both_sides && !(range.lower > 0.0))) {
    throw InputError(key, text_of(range),
                     both_sides ? "min:max with min < max, neither of them 0"
                                : "min:max with 0 < min < max, such as 5km:100km");
  }
  require_near_enough(range.lower, text_of(range));
  require_near_enough(range.upper, text_of(range));
}

void require_property(const std::string& key, const Domain& domain, const DesignField& property) {
  const auto* range = std::get_if<ValueRange>(&domain);
  if (range == nullptr) return;
  require(property.kind != VariableKind::categorical, key, text_of(*range), "a list of its words");
  require(range->lower < range->upper, key, text_of(*range), "min:max with min < max");
  if (range->scale.value_or(property.scale) == Scale::logarithmic && !(range->lower > 0.0)) {
    throw InputError(key, text_of(*range), "above 0 on a logarithmic scale", "take min:max:linear");
  }
  require(property.variable != "pupil_pixels", key, text_of(*range),
          "a list, such as 16,32,64: divisors of simulation.pupil_samples");
}

bool is_pair_name(std::string_view name) { return std::ranges::count(pair_names, name) > 0; }

}  // namespace

std::vector<VisitingOrder> all_orders(int planes) {
  VisitingOrder numbers(static_cast<std::size_t>(2 * pair_count(planes)));
  std::iota(numbers.begin(), numbers.end(), 1);
  std::vector<VisitingOrder> orders;
  do {
    // With an odd number, the plane that is left out stands last, in one permutation of each order.
    orders.emplace_back(numbers.begin(), numbers.begin() + planes);
  } while (std::ranges::next_permutation(numbers).found);
  return orders;
}

std::optional<SymmetricPlanes> symmetric_planes(const std::vector<double>& planes) {
  const auto count = static_cast<int>(planes.size());
  if (count < 2 || count > most_planes) return std::nullopt;
  SymmetricPlanes found;
  for (const double z : planes) {
    const auto same = [&](double pair) { return is_equal(pair, std::abs(z)); };
    if (z != 0.0 && std::ranges::none_of(found.pairs, same)) found.pairs.push_back(std::abs(z));
  }
  std::ranges::sort(found.pairs);
  if (static_cast<int>(found.pairs.size()) != pair_count(count)) return std::nullopt;
  for (const double z : planes) {
    const auto pair = std::ranges::find_if(
        found.pairs, [&](double distance) { return is_equal(distance, std::abs(z)); });
    if (pair == found.pairs.end()) return std::nullopt;
    const auto number = static_cast<int>(2 * (pair - found.pairs.begin())) + (z < 0.0 ? 1 : 2);
    if (std::ranges::count(found.order, number) > 0) return std::nullopt;
    found.order.push_back(number);
  }
  return found;
}

std::vector<SymmetricPlanes> symmetric_namings(const std::vector<double>& planes) {
  const auto symmetric = symmetric_planes(planes);
  if (!symmetric) return {};
  std::vector<SymmetricPlanes> namings;
  std::vector<std::size_t> called(symmetric->pairs.size());
  std::iota(called.begin(), called.end(), std::size_t{0});
  do {
    SymmetricPlanes& naming = namings.emplace_back();
    naming.pairs.resize(called.size());
    for (std::size_t pair = 0; pair < called.size(); ++pair) {
      naming.pairs[called[pair]] = symmetric->pairs[pair];
    }
    for (const int number : symmetric->order) {
      const std::size_t name = called[static_cast<std::size_t>((number - 1) / 2)];
      naming.order.push_back(static_cast<int>(2 * name) + (number % 2 == 1 ? 1 : 2));
    }
  } while (std::ranges::next_permutation(called).found);
  return namings;
}

DistanceRange default_distance_range(const Telescope& telescope) {
  return {distance_at_fresnel_number(telescope, nearest_fresnel_number),
          distance_at_fresnel_number(telescope, farthest_fresnel_number)};
}

/// One thing that is varied: how its values become numbers without dimension.
struct DesignSpace::Axis {
  enum class Form {
    listed,    ///< the index of a value
    linear,    ///< the value
    above,     ///< log(value / unit)
    below,     ///< -log(-value / unit), which grows with the value
    two_sided  ///< sign(value) log(|value| / unit), whose values keep |value| >= unit
  };
  std::string name;
  Form form;
  std::vector<double> values;  ///< listed ones, or least and greatest
  double unit = 1.0;
  VariableKind kind = VariableKind::continuous;

  double x_of(double value) const {
    switch (form) {
      case Form::listed:
        break;
      case Form::linear:
        return value;
      case Form::above:
        return std::log(value / unit);
      case Form::below:
        return -std::log(-value / unit);
      case Form::two_sided:
        return std::copysign(std::log(std::abs(value) / unit), value);
    }
    const auto found =
        std::ranges::find_if(values, [&](double v) { return v == value || is_equal(v, value); });
    return double(found - values.begin());
  }

  double value_at(double x) const {
    switch (form) {
      case Form::listed:
        break;
      case Form::linear:
        return x;
      case Form::above:
        return unit * std::exp(x);
      case Form::below:
        return -unit * std::exp(-x);
      case Form::two_sided:
        return std::copysign(unit * std::exp(std::abs(x)), x);
    }
    return values[static_cast<std::size_t>(std::lround(x))];
  }

  bool holds(double value) const {
    if (form == Form::listed) return x_of(value) < double(values.size());
    return is_within(values.front(), values.back(), value) &&
           (form != Form::two_sided || std::abs(value) >= unit || is_equal(std::abs(value), unit));
  }

  Variable variable() const {
    const bool is_log = form != Form::listed && form != Form::linear;
    return {is_log ? "log " + name : name, form == Form::listed ? 0.0 : x_of(values.front()),
            form == Form::listed ? double(values.size()) - 1.0 : x_of(values.back()), kind};
  }
};

/// The designs of one number of planes.
struct DesignSpace::Region {
  int planes;
  std::vector<VisitingOrder> orders;                 ///< of a symmetric layout
  std::vector<Axis> axes;                            ///< what is varied
  std::map<std::string, double, std::less<>> fixed;  ///< what has one value, by name

  /// The names of the distances.
  std::vector<std::string> distances(Layout layout) const {
    std::vector<std::string> names;
    if (layout == Layout::symmetric) {
      names.assign(pair_names.begin(), pair_names.begin() + pair_count(planes));
    } else {
      for (int plane = 1; plane <= planes; ++plane) names.push_back(fmt::format("z{}", plane));
    }
    return names;
  }

  void add(Axis axis) {
    if (axis.form == Axis::Form::listed && axis.values.size() == 1) {
      fixed.emplace(axis.name, axis.values.front());
    } else {
      axes.push_back(std::move(axis));
    }
  }
};

double rounded_window(double window, int samples) {
  const auto has_small_factors = [](int width) {
    for (const int prime : {2, 3, 5, 7}) {
      while (width % prime == 0) width /= prime;
    }
    return width == 1;
  };
  int width = rounded_width(window, samples);
  while (!has_small_factors(width)) width += 2;
  return double(width) / samples;
}

DesignSpace::DesignSpace(const Telescope& telescope, DesignSpaceOptions options)
    : telescope_(telescope), options_(std::move(options)) {
  for (const int planes : options_.plane_counts) {
    require(planes >= 2 && planes <= most_planes, key_of("plane_count"), planes,
            fmt::format("from 2 to {}", most_planes));
    regions_.push_back(region_of(planes));
  }
  require_used_domains();
}

std::string DesignSpace::key_of(std::string_view name) const {
  return fmt::format("{}.{}", options_.section, name);
}

DesignSpace::Region DesignSpace::region_of(int planes) const {
  Region region{planes, {}, {}, {}};
  for (const std::string& name : region.distances(options_.layout)) {
    region.add(distance_axis(name));
  }
  if (options_.layout == Layout::symmetric) {
    std::ranges::copy_if(
        options_.orders, std::back_inserter(region.orders),
        [&](const auto& order) { return static_cast<int>(order.size()) == planes; });
    if (region.orders.empty()) region.orders = all_orders(planes);
    std::vector<double> indices(region.orders.size());
    std::iota(indices.begin(), indices.end(), 0.0);
    region.add({"order", Axis::Form::listed, indices, 1.0, VariableKind::categorical});
  }
  for (const auto& [name, domain] : options_.domains) {
    if (const DesignField* property = find_design_property(name)) {
      region.add(property_axis(*property, domain));
    }
  }
  return region;
}

DesignSpace::Axis DesignSpace::distance_axis(const std::string& name) const {
  const bool is_symmetric = options_.layout == Layout::symmetric;
  const auto [nearest, farthest] = default_distance_range(telescope_);
  const auto given = options_.domains.find(name);
  const Domain domain = given != options_.domains.end()
                            ? given->second
                            : Domain(ValueRange{is_symmetric ? nearest : -farthest, farthest});
  require_distances(key_of(name), domain, !is_symmetric, telescope_);
  if (const auto* list = std::get_if<std::vector<double>>(&domain)) {
    return {name, Axis::Form::listed, *list, 1.0, VariableKind::integer};
  }
  const double length_unit = distance_at_fresnel_number(telescope_, 1.0);
  const auto [lower, upper, scale] = std::get<ValueRange>(domain);
  if (scale == Scale::linear) return {name, Axis::Form::linear, {lower, upper}};
  if (lower > 0.0) return {name, Axis::Form::above, {lower, upper}, length_unit};
  if (upper < 0.0) return {name, Axis::Form::below, {lower, upper}, length_unit};
  const double closest = std::min({nearest, -0.5 * lower, 0.5 * upper});
  return {name, Axis::Form::two_sided, {lower, upper}, closest};
}

DesignSpace::Axis DesignSpace::property_axis(const DesignField& property,
                                             const Domain& domain) const {
  const std::string name(property.variable);
  require_property(key_of(name), domain, property);
  const VariableKind list_kind = property.kind == VariableKind::categorical
                                     ? VariableKind::categorical
                                     : VariableKind::integer;
  if (const auto* list = std::get_if<std::vector<double>>(&domain)) {
    return {name, Axis::Form::listed, *list, 1.0, list_kind};
  }
  const auto [lower, upper, scale] = std::get<ValueRange>(domain);
  if (property.kind == VariableKind::integer) {
    return {name, Axis::Form::linear, {lower, upper}, 1.0, VariableKind::integer};
  }
  return {
      name,
      scale.value_or(property.scale) == Scale::logarithmic ? Axis::Form::above : Axis::Form::linear,
      {lower, upper}};
}

void DesignSpace::require_used_domains() const {
  const bool is_symmetric = options_.layout == Layout::symmetric;
  for (const auto& domain : options_.domains) {
    const std::string& name = domain.first;
    if (find_design_property(name) != nullptr) continue;
    if (is_pair_name(name) != is_symmetric) {
      throw InputError(key_of(name), text_of(domain.second),
                       fmt::format("is for {} = {}", key_of("layout"),
                                   word_of(is_symmetric ? Layout::free : Layout::symmetric)));
    }
    const bool is_used = std::ranges::any_of(regions_, [&](const Region& region) {
      return std::ranges::count(region.distances(options_.layout), name) > 0;
    });
    require(is_used, key_of(name), text_of(domain.second),
            fmt::format("there are at most {} planes, see {}",
                        std::ranges::max(options_.plane_counts), key_of("plane_count")));
  }
  if (options_.domains.contains("relaxation") && (options_.domains.contains("relaxation_start") ||
                                                  options_.domains.contains("relaxation_end"))) {
    throw InputError(key_of("relaxation"), text_of(options_.domains.at("relaxation")),
                     "either relaxation, or relaxation_start and relaxation_end");
  }
}

DesignSpace::~DesignSpace() = default;
DesignSpace::DesignSpace(DesignSpace&&) noexcept = default;

std::vector<SubSpace> DesignSpace::sub_spaces() const {
  std::vector<SubSpace> sub_spaces;
  for (const Region& region : regions_) {
    SubSpace sub_space{fmt::format("{} planes", region.planes), {}};
    for (const Axis& axis : region.axes) sub_space.variables.push_back(axis.variable());
    sub_spaces.push_back(std::move(sub_space));
  }
  return sub_spaces;
}

SensorDesign DesignSpace::design(const SearchPoint& point) const {
  const Region& region = regions_[static_cast<std::size_t>(point.sub_space)];
  assert(point.x.size() == static_cast<Eigen::Index>(region.axes.size()));
  std::map<std::string, double, std::less<>> values = region.fixed;
  for (std::size_t i = 0; i < region.axes.size(); ++i) {
    values.emplace(region.axes[i].name, region.axes[i].value_at(point.x[Eigen::Index(i)]));
  }

  SensorDesign design = options_.base;
  design.planes.clear();
  for (const std::string& name : region.distances(options_.layout)) {
    design.planes.push_back(values.at(name));
  }
  if (options_.layout == Layout::symmetric) {
    const auto order = static_cast<std::size_t>(std::lround(values.at("order")));
    design.planes = visited(region.orders[order], design.planes);
  }
  for (const auto& [name, value] : values) {
    if (const DesignField* property = find_design_property(name)) property->set(design, value);
  }
  if (varies("detector_window")) {
    const int width = rounded_width(design.detector.window, design.detector.pupil_pixels);
    design.detector.window = double(width) / design.detector.pupil_pixels;
  }
  if (varies("reconstruction_window")) {
    design.reconstruction.window = rounded_window(
        std::max(design.reconstruction.window, design.detector.window), design.pupil_samples());
  }
  return design;
}

std::optional<SearchPoint> DesignSpace::point_of(const SensorDesign& design) const {
  const auto planes = static_cast<int>(design.planes.size());
  const auto region = std::ranges::find(regions_, planes, &Region::planes);
  if (region == regions_.end()) return std::nullopt;
  const std::vector<std::string> names = region->distances(options_.layout);
  // Where the ranges overlap or are exchanged, the nearer pair may be the one called far.
  const std::vector<SymmetricPlanes> namings = options_.layout == Layout::free
                                                   ? std::vector{SymmetricPlanes{design.planes, {}}}
                                                   : symmetric_namings(design.planes);

  const auto value_of = [&](const SymmetricPlanes& naming, const std::string& name) {
    if (name == "order") {
      return double(std::ranges::find(region->orders, naming.order) - region->orders.begin());
    }
    if (const DesignField* property = find_design_property(name)) return property->get(design);
    return naming.pairs.at(
        static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  };
  for (const SymmetricPlanes& naming : namings) {
    const bool fits = std::ranges::all_of(region->axes,
                                          [&](const Axis& axis) {
                                            return axis.holds(value_of(naming, axis.name));
                                          }) &&
                      std::ranges::all_of(region->fixed, [&](const auto& fixed) {
                        return fixed.second == value_of(naming, fixed.first) ||
                               is_equal(fixed.second, value_of(naming, fixed.first));
                      });
    if (!fits) continue;
    SearchPoint point{static_cast<int>(region - regions_.begin()),
                      Eigen::VectorXd(region->axes.size())};
    for (std::size_t i = 0; i < region->axes.size(); ++i) {
      point.x[Eigen::Index(i)] = region->axes[i].x_of(value_of(naming, region->axes[i].name));
    }
    return point;
  }
  return std::nullopt;
}

std::string DesignSpace::name(int sub_space, std::size_t variable) const {
  return regions_[static_cast<std::size_t>(sub_space)].axes[variable].name;
}

double DesignSpace::value(int sub_space, std::size_t variable, double x) const {
  return regions_[static_cast<std::size_t>(sub_space)].axes[variable].value_at(x);
}

bool DesignSpace::varies(std::string_view property) const {
  return std::ranges::any_of(regions_, [&](const Region& region) {
    return std::ranges::count(region.axes, property, &Axis::name) > 0;
  });
}

std::string design_key(const SensorDesign& design) {
  std::vector<double> values;
  for (const DesignField& property : design_properties()) {
    values.push_back(property.get(design));
  }
  return fmt::format("{:.7g};{:.7g}", fmt::join(design.planes, ","), fmt::join(values, ","));
}

std::string exact_text(const SensorDesign& design) {
  const auto& [planes, detector, reconstruction] = design;
  const auto& [pupil_pixels, detector_window, photons, read_noise, photon_rate, exposure] =
      detector;
  const auto& [max_loops, tolerance, stopping, relaxation_start, relaxation_end, initial_guess,
               window, outside, oversampling, unwrapping] = reconstruction;
  return fmt::format("{};{},{},{},{},{},{};{},{},{},{},{},{},{},{},{},{}", fmt::join(planes, ","),
                     pupil_pixels, detector_window, photons, read_noise, photon_rate, exposure,
                     max_loops, tolerance, static_cast<int>(stopping), relaxation_start,
                     relaxation_end, static_cast<int>(initial_guess), window,
                     static_cast<int>(outside), oversampling, static_cast<int>(unwrapping));
}

}  // namespace nlcwfs
