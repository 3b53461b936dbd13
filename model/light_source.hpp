// Bands of light become wavelengths with weights, for each plane.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

namespace nlcwfs {

/// What of an aberration is the same at every wavelength.
enum class ChromaticAberration {
  phase,  ///< its phase in radians: no source of light is so, but papers simulate it
  path    ///< its optical path in m, as that of air and mirrors nearly is
};

/// A range of wavelengths.
struct Band {
  double shortest;  ///< m
  double longest;   ///< m, at least as long

  /// Middle of the band, m.
  double centre() const { return 0.5 * (shortest + longest); }
  /// By the shortest wavelength, then the longest.
  // NOLINTNEXTLINE(modernize-use-nullptr): it compares with 0, which is no pointer
  auto operator<=>(const Band&) const = default;
};

/// One wavelength of a plane's light.
struct SpectralLine {
  double wavelength;  ///< m
  double weight;      ///< share of the plane's light
};

/// The light that a sensor works with. By default it has the telescope's wavelength alone.
///
/// A plane with a band of centre lambda_c stands where lambda_c has the Fresnel number that the
/// telescope's wavelength lambda has at the design's distance Z: at Z lambda / lambda_c. The
/// reconstruction works as if all light had the telescope's wavelength.
/// Source: Letchev et al. 2022, section 5.
struct LightSource {
  /// None: one wavelength. One: the light of all planes, which beam splitters share out. Several:
  /// one for each plane, in visiting order, which dichroics share out.
  std::vector<Band> bands = {};
  /// Of one band each plane gets an equal part, the first plane the shortest wavelengths.
  bool is_split = false;
  int wavelengths = 1;               ///< that stand for a plane's band: the middles of equal parts
  std::vector<double> weights = {};  ///< of these, shortest first, in any unit; none = equal
  ChromaticAberration aberration =
      ChromaticAberration::phase;  ///< what is the same at every wavelength

  /// @throws InputError where values do not go together, or with so many planes
  void validate(std::size_t planes) const;

  /// @param plane       in visiting order, counted from 0
  /// @param planes      that there are
  /// @param wavelength  the telescope's, m
  Band band(std::size_t plane, std::size_t planes, double wavelength) const;

  /// The wavelengths of a plane, shortest first; their weights' sum is 1.
  std::vector<SpectralLine> lines(std::size_t plane, std::size_t planes, double wavelength) const;
};

}  // namespace nlcwfs
