// Gaps of an image are filled from around them.
#include "model/image_gaps.hpp"

#include <algorithm>
#include <cmath>

namespace nlcwfs {
namespace {

/// The mean of the neighbours that have a value; NaN where none has.
double mean_of_neighbours(const Image<double>& image, Eigen::Index row, Eigen::Index column) {
  double sum = 0.0;
  int count = 0;
  for (auto y = std::max<Eigen::Index>(row - 1, 0); y <= std::min(row + 1, image.rows() - 1); ++y) {
    for (auto x = std::max<Eigen::Index>(column - 1, 0);
         x <= std::min(column + 1, image.cols() - 1); ++x) {
      if (std::isnan(image(y, x))) continue;
      sum += image(y, x);
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

std::vector<Gap> gaps_of(const Image<double>& image) {
  std::vector<Gap> gaps;
  if (!image.hasNaN()) return gaps;
  for (Eigen::Index row = 0; row < image.rows(); ++row) {
    for (Eigen::Index column = 0; column < image.cols(); ++column) {
      if (std::isnan(image(row, column))) gaps.push_back({row, column});
    }
  }
  return gaps;
}

Image<double> with_gaps_filled(Image<double> image) {
  std::vector<Gap> gaps = gaps_of(image);
  std::size_t filled = 0;
  do {
    const Image<double> before = image;
    for (const auto& [row, column] : gaps) {
      image(row, column) = mean_of_neighbours(before, row, column);
    }
    filled = std::erase_if(gaps,
                           [&](const Gap& gap) { return !std::isnan(image(gap.row, gap.column)); });
  } while (filled > 0);
  return image;
}

}  // namespace nlcwfs
