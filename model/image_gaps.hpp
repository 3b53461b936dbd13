// Gaps of an image are filled from around them.
#pragma once

#include "model/array.hpp"

#include <vector>

namespace nlcwfs {

/// A sample without a value.
struct Gap {
  Eigen::Index row;     ///< of the image
  Eigen::Index column;  ///< likewise
};

/// The samples that have no value (NaN), row by row.
std::vector<Gap> gaps_of(const Image<double>& image);

/// The image with a value wherever it has none (NaN): ring by ring from the edge of a gap inwards,
/// each sample gets the mean of those of its eight neighbours that have a value. An image without
/// any value stays as it is.
Image<double> with_gaps_filled(Image<double> image);

}  // namespace nlcwfs
