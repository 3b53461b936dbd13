// scale: A design moved to another telescope at constant Fresnel numbers.
#include "model/input_error.hpp"
#include "results/tables/design_summary.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/units.hpp"

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// Whether a key holds lengths of a sensor that a search or sweep varies.
bool is_varied_length(const ConfigurationKey& key) {
  return (key.kind == Kind::domain || key.kind == Kind::axis) && key.element == Kind::length;
}

/// Lengths of other sections that scale with a design.
keys::Keys moved_lengths() {
  keys::Keys moved{"baseline.planes", "objective.wfe_scale"};
  for (const ConfigurationKey& key : configuration_keys()) {
    if (is_varied_length(key)) moved.push_back(key.name);
  }
  return moved;
}

/// The telescope of the section scale; what is not set is as at the telescope that it comes from.
Telescope scaled_telescope_of(const Configuration& configuration, Telescope telescope) {
  const auto diameter = configuration.optional_length("scale.diameter");
  const auto wavelength = configuration.optional_length("scale.wavelength");
  const auto relay = configuration.optional_length("scale.relay_beam_diameter");
  if (!diameter && !wavelength && !relay) {
    throw InputError("scale.diameter", "(nothing)",
                     "set scale.diameter, scale.wavelength or scale.relay_beam_diameter, such as "
                     "--scale.diameter 8.2m");
  }
  telescope.diameter = diameter.value_or(telescope.diameter);
  telescope.wavelength = wavelength.value_or(telescope.wavelength);
  if (relay) telescope.relay_beam_diameter = relay;
  telescope.validate();
  return telescope;
}

/// The configuration of the design at the other telescope.
Configuration scaled_configuration(const Configuration& configuration, const Telescope& from,
                                   const Telescope& to, const Seeing& seeing) {
  const double waves = to.wavelength / from.wavelength;
  Configuration scaled = configuration;
  const auto set = [&](std::string_view key, const auto& value) {
    scaled.set(key, fmt::format("{}", value), "by scale");
  };
  set("telescope.diameter", to.diameter);
  set("telescope.wavelength", to.wavelength);
  if (to.relay_beam_diameter) set("telescope.relay_beam_diameter", *to.relay_beam_diameter);
  set("seeing.d_over_r0", to.diameter / seeing.fried_parameter);
  if (seeing.outer_scale) set("seeing.outer_scale", *seeing.outer_scale);
  // Every distance, so that the file also searches at the new telescope.
  const auto moved = [&](double distance) { return scaled_distance(distance, from, to); };
  for (const ConfigurationKey& key : configuration_keys()) {
    if (key.name.ends_with(".planes")) {
      std::vector<double> planes = configuration.lengths(key.name);
      std::ranges::transform(planes, planes.begin(), moved);
      set(key.name, fmt::format("{}", fmt::join(planes, ",")));
    } else if (is_varied_length(key) && configuration.is_set(key.name)) {
      // Tolerances are optical path, everything else is a distance.
      const bool is_path = key.name.ends_with("tolerance");
      set(key.name, with_lengths(configuration.value_text(key.name), [&](double length) {
            return is_path ? length * to.wavelength / from.wavelength : moved(length);
          }));
    }
  }
  if (configuration.is_set("source.bands")) {
    std::vector<std::string> bands;
    for (const Band& band : configuration.bands("source.bands")) {
      bands.push_back(fmt::format("{}:{}", band.shortest * waves, band.longest * waves));
    }
    set("source.bands", fmt::format("{}", fmt::join(bands, ",")));
  }
  // Equal designs are equal in waves, and so are their costs.
  set("objective.wfe_scale",
      configuration.length("objective.wfe_scale") * to.wavelength / from.wavelength);
  set("reconstruction.tolerance", configuration.length("reconstruction.tolerance") * waves);
  return scaled;
}

void run_scale(const Request& request) {
  const Configuration& configuration = request.configuration;
  require_one_condition(configuration);
  const Telescope telescope = telescope_of(configuration);
  const Seeing seeing = seeing_of(configuration, telescope);
  const SensorDesign design = design_of(configuration);
  design.validate(telescope);
  const Telescope target = scaled_telescope_of(configuration, telescope);
  const double size_ratio = target.diameter / telescope.diameter;
  // Equal D/r0 and equal outer scale in diameters: the same turbulence for the larger beam.
  Seeing target_seeing{.fried_parameter = seeing.fried_parameter * size_ratio};
  if (seeing.outer_scale) target_seeing.outer_scale = *seeing.outer_scale * size_ratio;
  SensorDesign scaled = design;
  for (double& plane : scaled.planes) plane = scaled_distance(plane, telescope, target);
  // Tolerances are optical path; equal designs are equal in waves.
  scaled.reconstruction.tolerance *= target.wavelength / telescope.wavelength;
  RunRecord record(request);

  record.folder().write(
      "scaled.cfg", scaled_configuration(configuration, telescope, target, target_seeing).dump());
  record.write_summary({{"design", to_json(design, telescope, seeing.fried_parameter)},
                        {"scaled", to_json(scaled, target, target_seeing.fried_parameter)},
                        {"scaled_telescope",
                         {{"diameter_m", target.diameter},
                          {"wavelength_m", target.wavelength},
                          {"fried_parameter_m", target_seeing.fried_parameter}}}});

  record.print("From: {}\n{}\n", telescope_line(telescope, seeing),
               planes_table(design, telescope, seeing));
  record.print("To: {}\n{}\n", telescope_line(target, target_seeing),
               planes_table(scaled, target, target_seeing));
  record.print(
      "Equal Fresnel numbers and D/r0: the same loops, and the same wavefront error in waves\n"
      "(in nm it is multiplied by {:.4g}). scaled.cfg evaluates the new design.\n",
      target.wavelength / telescope.wavelength);
  record.close();
}

std::string of_scale(const Json& summary) {
  const Json& telescope = summary.at("scaled_telescope");
  return fmt::format("Moved to {} at {}, with the same Fresnel numbers and D/r0.",
                     format_length(number_from_json(telescope.at("diameter_m"))),
                     format_length(number_from_json(telescope.at("wavelength_m"))));
}

}  // namespace

Command scale_command() {
  return {.name = "scale",
          .group = "Laws and scaling",
          .description = "move a design to another telescope or bench at equal Fresnel numbers",
          .about =
              "Moves the configured planes to the telescope of the section scale, where they see "
              "the same diffraction, and writes the moved design as scaled.cfg.",
          .keys = keys::joined({keys::site,
                                {"sensor", "source.bands", "detector", "reconstruction", "scale"},
                                moved_lengths()}),
          .examples = {"nlcwfs scale --config results/optimize-1/best.cfg --scale.diameter 8.2 "
                       "--scale.relay_beam_diameter 10mm"},
          .run = run_scale,
          .files = {{"scaled.cfg", FileRole::design}},
          .verdict = of_scale};
}

}  // namespace nlcwfs
