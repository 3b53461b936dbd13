// Gaps of an image are filled from around them.
#include "model/image_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

Image<double> with_gaps_filled(Image<double> image) {
  struct Sample {
    Eigen::Index row;
    Eigen::Index column;
    double value;
  };
  std::vector<Sample> gaps;
  for (Eigen::Index row = 0; row < image.rows(); ++row) {
    for (Eigen::Index column = 0; column < image.cols(); ++column) {
      if (std::isnan(image(row, column))) gaps.push_back({row, column, 0.0});
    }
  }
  while (!gaps.empty()) {
    for (Sample& gap : gaps) gap.value = mean_of_neighbours(image, gap.row, gap.column);
    const std::size_t count = gaps.size();
    for (const Sample& gap : gaps) image(gap.row, gap.column) = gap.value;
    std::erase_if(gaps, [](const Sample& gap) { return !std::isnan(gap.value); });
    if (gaps.size() == count) break;
  }
  return image;
}

}  // namespace nlcwfs
