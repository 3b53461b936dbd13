// Bands of light become wavelengths with weights, for each plane.
#include "model/light_source.hpp"

#include "model/input_error.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// The most wavelengths of all planes.
constexpr int most_lines = 100000;

}  // namespace

void LightSource::validate(std::size_t planes) const {
  if (bands.empty()) {
    if (!is_split) return;
    throw InputError("source.division", "split", "source.bands must be set, such as 400nm:800nm");
  }
  for (const Band& band : bands) {
    if (band.shortest > 0.0 && band.shortest <= band.longest) continue;
    throw InputError("source.bands", fmt::format("{:g}:{:g}", band.shortest, band.longest),
                     "SHORTEST:LONGEST above 0, such as 500nm:600nm");
  }
  require(!is_split || bands.size() == 1, "source.division", "split",
          fmt::format("source.bands must be one band, but has {}", bands.size()));
  require(bands.size() == 1 || bands.size() == planes, "source.bands",
          fmt::format("{} bands", bands.size()),
          fmt::format("one band, or one for each of the {} planes", planes));
  require(wavelengths >= 1, "source.wavelengths", wavelengths, "at least 1");
  // Each is propagated on its own, with kernels of its own.
  if (double(planes) * wavelengths > most_lines) {
    throw InputError("source.wavelengths", wavelengths,
                     fmt::format("at most {} with {} planes", most_lines / planes, planes));
  }
  if (weights.empty()) return;
  require(weights.size() == static_cast<std::size_t>(wavelengths), "source.weights",
          fmt::format("{} weights", weights.size()),
          fmt::format("one for each of the {} of source.wavelengths", wavelengths));
  require(std::ranges::min(weights) >= 0.0 && std::ranges::max(weights) > 0.0, "source.weights",
          std::ranges::min(weights), "0 or more, not all 0");
}

Band LightSource::band(std::size_t plane, std::size_t planes, double wavelength) const {
  if (bands.empty()) return {wavelength, wavelength};
  if (bands.size() > 1) return bands[plane];
  if (!is_split) return bands.front();
  const auto [shortest, longest] = bands.front();
  const double part = (longest - shortest) / double(planes);
  return {shortest + part * double(plane), shortest + part * double(plane + 1)};
}

std::vector<SpectralLine> LightSource::lines(std::size_t plane, std::size_t planes,
                                             double wavelength) const {
  if (bands.empty()) return {{wavelength, 1.0}};
  const Band range = band(plane, planes, wavelength);
  const double sum = weights.empty() ? wavelengths : std::reduce(weights.begin(), weights.end());
  std::vector<SpectralLine> lines;
  for (int i = 0; i < wavelengths; ++i) {
    const double middle = (i + 0.5) / wavelengths;
    lines.push_back({range.shortest + middle * (range.longest - range.shortest),
                     (weights.empty() ? 1.0 : weights[static_cast<std::size_t>(i)]) / sum});
  }
  return lines;
}

}  // namespace nlcwfs
