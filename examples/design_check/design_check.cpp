// Judges a sensor for a 1 m telescope on a few phase screens. The planes' signed distances in km,
// in visiting order, are the arguments: design_check -250 250 -60 60
#include "model/simulation.hpp"
#include "model/turbulence_screen.hpp"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <vector>

int main(int argc, char** argv) {
  try {
    const nlcwfs::Telescope telescope{.diameter = 1.0, .wavelength = 700e-9};
    const nlcwfs::Seeing seeing{.fried_parameter = 0.2};  // at the telescope's wavelength
    nlcwfs::SensorDesign design;
    design.planes = {-250e3, 250e3, -60e3, 60e3};
    if (argc > 1) design.planes.clear();
    for (int i = 1; i < argc; ++i) design.planes.push_back(1e3 * std::atof(argv[i]));
    design.detector.pupil_pixels = 32;
    design.detector.photons = 1e5;

    // 64 samples of the true wavefront across the pupil; the seed fixes the 16 screens.
    const nlcwfs::TurbulenceScreenGenerator generator(seeing, 64, telescope.diameter, 1);
    const nlcwfs::Simulation simulation(telescope, nlcwfs::generate_screens(generator, 16), {});
    const nlcwfs::Performance performance = simulation.evaluate(design);

    for (const nlcwfs::PerformanceMetric& metric : nlcwfs::performance_metrics()) {
      const nlcwfs::MeanAndError value = performance.mean_of(metric);
      std::cout << metric.name << ": " << value.mean << " +- " << value.standard_error << '\n';
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
