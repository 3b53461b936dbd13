// Fuzzes configuration files, and what the commands make of them.
#include "studies/settings/configuration.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/sweep_grid.hpp"
#include "tests/fuzz/fuzzer.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <cstdlib>

using namespace nlcwfs;

namespace {

void expect(bool condition) {
  if (!condition) std::abort();
}

void expect_dump_reads_back(const Configuration& configuration) {
  const MemoryFile file(configuration.dump());
  Configuration read;
  read.read_file(file.path());
  expect(read == configuration);
}

/// Every key as what it stands for: what a configuration has taken can be read.
void read_values(const Configuration& configuration) {
  for (const ConfigurationKey& key : configuration_keys()) {
    if (!configuration.is_set(key.name)) continue;
    switch (key.kind) {
      case Kind::number:
        configuration.number(key.name);
        break;
      case Kind::number_list:
        expect(!configuration.numbers(key.name).empty());
        break;
      case Kind::integer:
        configuration.integer(key.name);
        break;
      case Kind::seed:
        configuration.seed(key.name);
        break;
      case Kind::length:
        configuration.length(key.name);
        break;
      case Kind::length_list:
        expect(!configuration.lengths(key.name).empty());
        break;
      case Kind::bands:
        expect(!configuration.bands(key.name).empty());
        break;
      case Kind::domain:
        expect(configuration.domain(key.name).has_value());
        break;
      case Kind::axis:
        expect(configuration.axis(key.name).has_value());
        break;
      case Kind::orders:
        configuration.orders(key.name);
        break;
      case Kind::time:
        expect(configuration.optional_time(key.name).has_value());
        break;
      case Kind::ramp:
        configuration.ramp(key.name);
        break;
      case Kind::choice:
        configuration.choice(key.name);
        break;
      case Kind::text:
        configuration.text(key.name);
        break;
    }
  }
}

/// A grid's first and last design, of a million at most.
void read_grid(const Configuration& configuration, const Telescope& telescope) {
  const DesignGrid grid = sweep_grid_of(configuration, telescope, design_of(configuration));
  expect(grid.size() >= 1 && grid.size() <= DesignGrid::most_points);
  grid.design(0);
  grid.design(grid.size() - 1);
}

void read_space(const Configuration& configuration, const Telescope& telescope) {
  const DesignSpace space = search_space_of(configuration, telescope, design_of(configuration));
  for (const SubSpace& sub_space : space.sub_spaces()) {
    for (const Variable& variable : sub_space.variables) expect(variable.lower <= variable.upper);
  }
}

void check_design(const Configuration& configuration, const Telescope& telescope) {
  // The pupil's samples are laid out to see whether any is lit.
  if (truth_samples(configuration) > 256 || configuration.integer("detector.pupil_pixels") > 256) {
    return;
  }
  const Setup setup(configuration);
  const SimulationOptions& options = setup.options;
  const SensorDesign design = setup.simulated();
  for (std::size_t plane = 0; plane < design.planes.size(); ++plane) {
    options.source.lines(plane, design.planes.size(), telescope.wavelength);
  }
}

/// What the commands do with a configuration before they simulate.
void check_settings(const Configuration& configuration) {
  Telescope telescope;
  if (!is_accepted([&] { telescope = telescope_of(configuration); })) return;
  is_accepted([&] { require_one_condition(configuration); });
  is_accepted([&] { seeings_of(configuration, telescope); });
  is_accepted([&] { baseline_of(configuration); });
  is_accepted([&] { cost_of(configuration, false); });
  is_accepted([&] { cost_of(configuration, true); });
  is_accepted([&] { trade_objectives_of(configuration); });
  is_accepted([&] { simulation_options_of(configuration); });
  is_accepted([&] { precision_of(configuration, "search.precision"); });
  is_accepted([&] { check_design(configuration, telescope); });
  is_accepted([&] { read_space(configuration, telescope); });
  is_accepted([&] { read_grid(configuration, telescope); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(text_of(data, size));
  Configuration configuration;
  // Values before a line that is refused are set.
  is_accepted([&] { configuration.read_file(file.path()); });
  expect_dump_reads_back(configuration);
  read_values(configuration);
  check_settings(configuration);
  Configuration scaled = configuration;
  is_accepted([&] { scale_default_planes(scaled); });
  if (!(scaled == configuration)) expect_dump_reads_back(scaled);
  return 0;
}
