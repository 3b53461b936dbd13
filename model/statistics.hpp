#pragma once
#include <cmath>
#include <span>
namespace nlcwfs {
struct MeanAndError {
  double mean;
  double standard_error;
};
inline MeanAndError mean_and_standard_error(std::span<const double> s) {
  double m = 0;
  for (double x : s) m += x;
  m /= double(s.size());
  double v = 0;
  for (double x : s) v += (x - m) * (x - m);
  return {m, s.size() > 1 ? std::sqrt(v / double(s.size() - 1) / double(s.size())) : 0.0};
}
}  // namespace nlcwfs
