// Widths that grids may have: bounded, and with small prime factors.
#pragma once

#include <string_view>

namespace nlcwfs {

/// The widest grid that is accepted, in samples per side: a complex field of it takes 1 GiB.
inline constexpr int max_grid_width = 8192;

/// Samples across a window that is `window` pupil diameters wide.
int grid_width(double window, int samples_per_diameter);

/// Demands a window of at least one diameter that is a whole, even number of samples, so that it
/// shares its sample positions with the pupil, and at most max_grid_width of them.
/// @param window_key    the key that holds the window
/// @param samples_key   the key that holds the samples per diameter
/// @throws InputError naming window_key
void validate_grid_window(std::string_view window_key, double window, std::string_view samples_key,
                          int samples_per_diameter);

}  // namespace nlcwfs
