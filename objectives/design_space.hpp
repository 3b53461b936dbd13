// What a search may choose becomes points, and points become sensors.
#pragma once

#include "model/sensor_design.hpp"
#include "model/telescope.hpp"
#include "model/words.hpp"
#include "objectives/design_field.hpp"
#include "optimizer/problem.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace nlcwfs {

/// The numbers from `lower` to `upper`.
struct ValueRange {
  double lower = 0.0;               ///< included
  double upper = 0.0;               ///< included
  std::optional<Scale> scale = {};  ///< not set: as suits the property
};

/// What may be chosen for one property of a sensor, in SI: a number of a range, or one of a list.
/// A list of one fixes it.
using Domain = std::variant<ValueRange, std::vector<double>>;

/// How planes are placed.
enum class Layout {
  symmetric,  ///< in pairs -Z, +Z; with an odd number of planes one is left out
  free        ///< each at its own signed distance
};

/// Those of Layout.
template <>
inline constexpr auto word_table<Layout> =
    std::to_array<Word<Layout>>({{"symmetric", Layout::symmetric}, {"free", Layout::free}});

/// The distances of a symmetric layout's pairs, in the order in which planes are numbered.
inline constexpr std::array<std::string_view, 3> pair_names{"z_near", "z_far", "z_third"};

/// A visiting order of a symmetric layout: plane numbers, where 1 = -Znear, 2 = +Znear, 3 = -Zfar,
/// 4 = +Zfar (Letchev et al. 2022 call them P1 to P4), 5 = -Zthird, 6 = +Zthird.
using VisitingOrder = std::vector<int>;

/// Every visiting order of a number of planes in a symmetric layout.
/// @pre planes is 2 to 6
std::vector<VisitingOrder> all_orders(int planes);

/// Planes of a symmetric layout: the distances of their pairs, nearest first, and their order.
struct SymmetricPlanes {
  std::vector<double> pairs;  ///< m, ascending
  VisitingOrder order;        ///< of the planes
};

/// The pairs of planes that stand symmetrically; nothing for others.
/// @param planes  signed m, in visiting order
std::optional<SymmetricPlanes> symmetric_planes(const std::vector<double>& planes);

/// Every way to call a symmetric layout's pairs near, far and third, with the order that goes with
/// each: `pairs` are in the order of pair_names, not ascending. The first calls the nearest pair
/// near. Empty for other layouts.
std::vector<SymmetricPlanes> symmetric_namings(const std::vector<double>& planes);

/// A range of distances, m.
using DistanceRange = std::pair<double, double>;

/// Where planes are searched by default: |Z| between the Fresnel numbers 200 and 2, which for the
/// paper's telescope is 2.3 to 235 km.
DistanceRange default_distance_range(const Telescope& telescope);

/// What a design space is made of.
struct DesignSpaceOptions {
  SensorDesign base = SensorDesign();   ///< everything that is not varied
  Layout layout = Layout::symmetric;    ///< how planes are placed
  std::vector<int> plane_counts = {4};  ///< each 2 to 6
  /// Orders of a symmetric layout that may be chosen; a number of planes without any has all.
  std::vector<VisitingOrder> orders = {};
  /// By name: the planes' distances in m, z_near, z_far, z_third or z1 to z6, and design
  /// properties. Planes without one may stand anywhere in default_distance_range, on either side.
  std::map<std::string, Domain, std::less<>> domains = {};
  std::string section = "search";  ///< of the configuration, for messages
};

/// The sensors that a search or a sweep may choose from: one sub-space for each number of planes.
///
/// Distances are searched as the logarithm of lambda |Z| / D^2, which is the inverse Fresnel
/// number, so that searches are equal for telescopes of all sizes. A range on both sides of the
/// pupil is searched in log |Z| on each side, from the Fresnel number 200 on.
class DesignSpace {
 public:
  /// @throws InputError where a domain is not valid or belongs to no design of the space
  DesignSpace(const Telescope& telescope, DesignSpaceOptions options);
  ~DesignSpace();
  /// Takes over another's regions.
  DesignSpace(DesignSpace&& other) noexcept;
  DesignSpace(const DesignSpace& other) = delete;
  DesignSpace& operator=(const DesignSpace& other) = delete;
  DesignSpace& operator=(DesignSpace&& other) = delete;

  /// A sub-space may have no variable: all of its design is fixed.
  std::vector<SubSpace> sub_spaces() const;

  /// The sensor at a point. Windows are rounded to whole pixels, that of the reconstruction to a
  /// width with small prime factors and at least the detector's.
  SensorDesign design(const SearchPoint& point) const;

  /// The point whose design has these planes and the same values of what is varied; nothing where
  /// the space has no such design.
  std::optional<SearchPoint> point_of(const SensorDesign& design) const;

  /// The property that a variable stands for: the variable's name without its scale.
  std::string name(int sub_space, std::size_t variable) const;

  /// The property's value, SI, at a value of the variable.
  double value(int sub_space, std::size_t variable, double x) const;

  /// Whether designs of the space differ in a property.
  bool varies(std::string_view property) const;

  /// Whether the space has a domain of a property, be it of one value, so that it may not be as in
  /// `base`.
  bool decides(std::string_view property) const { return options_.domains.contains(property); }

 private:
  struct Axis;
  struct Region;

  /// Of the configuration.
  std::string key_of(std::string_view name) const;
  Region region_of(int planes) const;
  Axis distance_axis(const std::string& name) const;
  Axis property_axis(const DesignField& property, const Domain& domain) const;
  void require_used_domains() const;

  Telescope telescope_;
  DesignSpaceOptions options_;
  std::vector<Region> regions_;  ///< one per sub-space
};

/// A window that a reconstruction's grid can have, in pupil diameters: `window` rounded to an even
/// number of samples with small prime factors.
/// @param samples  across the pupil
double rounded_window(double window, int samples);

/// What identifies a sensor among those of equal fixed properties: its planes in visiting order and
/// the values of all design_properties(), to 7 digits.
std::string design_key(const SensorDesign& design);

/// All that a design is, to the last bit: equal texts are equal designs.
std::string exact_text(const SensorDesign& design);

}  // namespace nlcwfs
