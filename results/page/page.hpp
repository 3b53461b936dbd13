// A run's data become one HTML page.
#pragma once

#include "model/array.hpp"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// A page that shows a run's results, as one HTML file: style, scripts and the library that draws
/// the charts are in it, and it asks nothing of any network. Whatever texts the data hold, they
/// stay texts. The scripts of results/page say which members of the data they draw.
/// @param title  for the browser's tab
std::string page_of(std::string_view title, const nlohmann::ordered_json& data);

/// An image as the page's scripts read it: {"rows", "columns", "samples_per_pixel", "values"}, the
/// values row by row as little-endian 32-bit floats in base64 (zeros may follow them), NaN where
/// there is none.
/// @param most  pixels along each side; a larger image is averaged over square blocks of
///              `samples_per_pixel` samples along each side, of their values that are finite
/// @pre the image is not empty, most > 0
nlohmann::ordered_json page_image(const Image<double>& image, int most);

}  // namespace nlcwfs
