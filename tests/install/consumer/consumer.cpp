#include "model/fourier_transform.hpp"
#include "model/telescope.hpp"

#include <fmt/core.h>

int main() {
  const nlcwfs::LineTransform<double> transform(8);  // needs what the library links to
  fmt::print("{:.0f} m, {} samples\n", nlcwfs::talbot_distance(0.125, 532e-9), transform.length());
}
