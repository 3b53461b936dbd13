// The section sweep becomes a grid of designs.
#pragma once

#include "objectives/design_grid.hpp"
#include "studies/settings/configuration.hpp"

namespace nlcwfs {

/// The grid of the section sweep. Where no key is set, distances and the order are those of the
/// base's planes.
/// @param base  gives everything else
/// @throws InputError where the section has no axis, or asks for what cannot be
DesignGrid sweep_grid_of(const Configuration& configuration, const Telescope& telescope,
                         SensorDesign base);

}  // namespace nlcwfs
