// Compares the unwrapping methods on what they are for: the pupil fields that the Gerchberg-Saxton
// loop ends with, clean and noisy, some of them not converged. Each wavefront is reconstructed
// once and unwrapped by every method. Prints a Markdown table.

#include "model/detector.hpp"
#include "model/gerchberg_saxton.hpp"
#include "model/phase_unwrapping.hpp"
#include "model/random_stream.hpp"
#include "model/statistics.hpp"
#include "model/true_light.hpp"
#include "model/turbulence_screen.hpp"
#include "model/wavefront_metrics.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {
namespace {

constexpr int truth_samples = 128;
constexpr int screen_count = 64;
constexpr std::uint64_t seed = 1;
constexpr std::array methods = {UnwrappingMethod::quality_guided, UnwrappingMethod::least_squares};

struct Unwrapping {
  double residual_wfe;  ///< m
  double samples_off;   ///< share of the pupil's samples, see share_of_samples_off
  double seconds;
};

struct Outcome {
  double wrapped_wfe;  ///< m
  std::array<Unwrapping, methods.size()> unwrappings;
};

/// Share of the mask's samples whose unwrapped error is not the wrapped error plus the same number
/// of cycles as most samples'.
double share_of_samples_off(const Field<double>& field, const Image<double>& unwrapped,
                            const PhaseScreen& truth, const PupilMask& mask) {
  const Field<double> quotient = field * pupil_field(truth, mask).conjugate();
  const std::complex<double> sum = mask.select(quotient, std::complex<double>(0.0)).sum();
  const Image<double> wrapped_error = (quotient * std::conj(sum)).arg() + std::arg(sum);
  const Image<double> cycles =
      ((unwrapped - truth - wrapped_error) / (2.0 * std::numbers::pi)).round();
  std::map<double, int> counts;
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    if (mask.data()[i]) ++counts[cycles.data()[i]];
  }
  const auto most = std::ranges::max_element(
      counts, {}, [](const auto& cycles_and_count) { return cycles_and_count.second; });
  return 1.0 - double(most->second) / double(mask.count());
}

/// Reconstructs and unwraps all wavefronts.
std::vector<Outcome> outcomes_of(const Telescope& telescope, const SensorDesign& design,
                                 const std::vector<PhaseScreen>& screens) {
  const GerchbergSaxton<double> reconstructor(telescope, design);
  const PupilMask& mask = reconstructor.mask();
  std::vector<PhaseUnwrapper> unwrappers;
  unwrappers.reserve(methods.size());
  for (const UnwrappingMethod method : methods) unwrappers.emplace_back(mask, method);

  const PupilMask truth_mask = pupil_mask(truth_samples, telescope.central_obscuration);
  const int samples_per_pixel = truth_samples / design.detector.pupil_pixels;
  const TrueLight light(TruthModel::extended, telescope, design, truth_samples);
  std::vector<std::size_t> all_planes(design.planes.size());
  std::iota(all_planes.begin(), all_planes.end(), std::size_t{0});
  const double photons_per_unit = design.detector.photons / double(design.planes.size()) *
                                  (samples_per_pixel * samples_per_pixel) /
                                  double(truth_mask.count());

  std::vector<Outcome> outcomes(screens.size());
  tbb::parallel_for(std::size_t{0}, screens.size(), [&](std::size_t screen) {
    const PhaseScreen& truth = screens[screen];
    std::vector<Image<double>> images = light.images(truth, all_planes);
    if (design.detector.photons > 0.0) {
      for (std::size_t plane = 0; plane < images.size(); ++plane) {
        RandomStream stream = random_stream({seed, screen, plane});
        add_noise(images[plane], photons_per_unit, design.detector.read_noise, stream);
      }
    }
    const Field<double> field = reconstructor.reconstruct(images).pupil_field;
    const PhaseScreen truth_on_pixels = block_average(truth, truth_samples / mask.rows());
    for (std::size_t method = 0; method < methods.size(); ++method) {
      const auto start = std::chrono::steady_clock::now();
      const Image<double> phase = unwrappers[method].unwrap(field);
      const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
      const WavefrontMetrics metrics =
          measure_wavefront(field, phase, mask, truth, truth_mask, telescope.wavelength);
      outcomes[screen].wrapped_wfe = metrics.wrapped_wfe;
      outcomes[screen].unwrappings[method] = {
          metrics.residual_wfe, share_of_samples_off(field, phase, truth_on_pixels, mask),
          duration.count()};
    }
  });
  return outcomes;
}

/// Mean and standard error over the wavefronts, in nm.
template <class Metric>
std::string nanometres(const std::vector<Outcome>& outcomes, const Metric& metric) {
  std::vector<double> values(outcomes.size());
  std::ranges::transform(outcomes, values.begin(), metric);
  const auto [mean, error] = mean_and_standard_error(values);
  return fmt::format("{:.2f} +- {:.2f}", 1e9 * mean, 1e9 * error);
}

void print_row(std::string_view planes, double d_over_r0, double photons,
               const std::vector<Outcome>& outcomes) {
  const auto difference = [](const Outcome& outcome) {
    return outcome.unwrappings[1].residual_wfe - outcome.unwrappings[0].residual_wfe;
  };
  std::array<std::string, methods.size()> residual;
  std::array<double, methods.size()> any_off{};
  std::array<double, methods.size()> region_off{};
  std::array<double, methods.size()> milliseconds{};
  for (std::size_t method = 0; method < methods.size(); ++method) {
    const auto share_above = [&](double samples_off) {
      const auto count = std::ranges::count_if(outcomes, [&](const Outcome& outcome) {
        return outcome.unwrappings[method].samples_off > samples_off;
      });
      return 100.0 * double(count) / double(outcomes.size());
    };
    residual[method] = nanometres(outcomes, [method](const Outcome& outcome) {
      return outcome.unwrappings[method].residual_wfe;
    });
    any_off[method] = share_above(0.0);
    region_off[method] = share_above(0.01);
    const auto seconds = [method](const Outcome& outcome) {
      return outcome.unwrappings[method].seconds;
    };
    milliseconds[method] = 1e3 * seconds(std::ranges::min(outcomes, {}, seconds));
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {:.0f} | {:.0f} | {:.1f} |\n", planes, d_over_r0,
             photons > 0.0 ? fmt::format("{:.0e}", photons) : "no noise",
             nanometres(outcomes, &Outcome::wrapped_wfe), fmt::join(residual, " | "),
             nanometres(outcomes, difference), fmt::join(any_off, " / "),
             fmt::join(region_off, " / "), fmt::join(milliseconds, " / "));
  std::fflush(stdout);
}

void compare() {
  fmt::print(
      "| planes | D/r0 | photons | wrapped | quality_guided | least_squares | difference | "
      "any sample off | more than 1 % off | time / ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  const Telescope telescope;
  for (const std::string_view planes : {"default", "paper"}) {
    for (const double d_over_r0 : {4.0, 6.0, 8.0, 10.0}) {
      const TurbulenceScreenGenerator generator({.fried_parameter = telescope.diameter / d_over_r0},
                                                truth_samples, telescope.diameter, seed);
      const std::vector<PhaseScreen> screens = generate_screens(generator, screen_count);
      for (const double photons : {0.0, 1e5, 1e4}) {
        SensorDesign design;
        if (planes == "paper") design.planes = {-47e3, 47e3, -180e3, 180e3};
        design.detector.photons = photons;
        print_row(planes, d_over_r0, photons, outcomes_of(telescope, design, screens));
      }
    }
  }
}

}  // namespace
}  // namespace nlcwfs

int main() { nlcwfs::compare(); }
