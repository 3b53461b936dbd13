// The table of all configuration keys, and the presets.
#include "model/words.hpp"
#include "objectives/design_cost.hpp"
#include "objectives/design_metric.hpp"
#include "objectives/design_space.hpp"
#include "optimizer/nlopt_backend.hpp"
#include "studies/settings/configuration_key.hpp"

#include <fmt/format.h>

namespace nlcwfs {
namespace {

Bounds above(double least) { return {.least = least, .least_included = false}; }
Bounds at_least(double least) { return {.least = least}; }
Bounds from_to(double least, double greatest) { return {.least = least, .greatest = greatest}; }

/// Of a telescope, of light and of air that it looks through: a number without its unit is beyond.
constexpr Bounds diameter_bounds{.least = 1e-4, .greatest = 1e3};
constexpr Bounds bench_beam_bounds{.least = 1e-6, .greatest = 1.0};
constexpr Bounds wavelength_bounds{.least = 1e-9, .greatest = 1e-3};
constexpr Bounds path_bounds{.least = 0.0, .greatest = 1e-3, .least_included = false};
constexpr Bounds d_over_r0_bounds{.least = 1e-3, .greatest = 1e4};

/// The relaxation beta diverges at both ends.
constexpr Bounds relaxation_bounds{
    .least = -1.0, .greatest = 1.0, .least_included = false, .greatest_included = false};

/// Everything of a sensor that can be varied.
struct Variation {
  std::string name;
  Kind element;
  std::string description;
  Bounds bounds = {};
  std::string range_example;
  std::string axis_example;
  std::vector<std::string> choices = {};
};

std::vector<Variation> variations() {
  std::vector<Variation> all{
      {"z_near", Kind::length, "Distance of the near pair of a symmetric layout.", above(0),
       "5km:100km", "5km:100km:24"},
      {"z_far", Kind::length, "Distance of the far pair of a symmetric layout.", above(0),
       "50km:400km", "50km:400km:24"},
      {"z_third", Kind::length,
       "Distance of the third pair of a symmetric layout of five or six planes.", above(0),
       "5km:400km", "5km:400km:8"}};
  for (int plane = 1; plane <= 6; ++plane) {
    all.push_back({fmt::format("z{}", plane),
                   Kind::length,
                   fmt::format("Signed distance of plane {} of a free layout.", plane),
                   {},
                   "-200km:-5km",
                   "-250km:250km:51"});
  }
  all.insert(
      all.end(),
      {{"pupil_pixels", Kind::integer, "Detector pixels across the pupil.", from_to(4, 8192),
        "16,32,64", "16,32,64"},
       {"detector_window", Kind::number, "Width of the detector, pupil diameters.", from_to(1, 64),
        "2:6", "2,3,4"},
       {"reconstruction_window", Kind::number,
        "Width of the reconstruction's grid, pupil diameters.", from_to(1, 64), "4:8", "4,8"},
       {"relaxation", Kind::number, "Relaxation beta, the same in every loop.", relaxation_bounds,
        "-0.5:0.8", "-0.5:0.8:14"},
       {"relaxation_start", Kind::number, "Relaxation beta of the first loop.", relaxation_bounds,
        "0:0.8", "0,0.4,0.8"},
       {"relaxation_end", Kind::number, "Relaxation beta of the last loop.", relaxation_bounds,
        "-0.8:0.8", "-0.5,0,0.5"},
       {"initial_guess",
        Kind::choice,
        "First estimate of the phase.",
        {},
        "",
        "",
        word_list<InitialGuess>()},
       {"reconstruction_oversampling", Kind::integer,
        "Reconstruction samples per detector pixel and axis.", from_to(1, 16), "1,2", "1,2,4"},
       {"tolerance", Kind::length, "Tolerance of the reconstruction, optical path.", path_bounds,
        "0.1nm:10nm", "0.1nm:10nm:5:log"},
       {"exposure", Kind::time, "Exposure of a frame, with detector.photon_rate.", above(0),
        "0.1ms:10ms", "0.1ms:10ms:5:log"}});
  return all;
}

void add_variations(std::vector<ConfigurationKey>& keys, const std::string& section, Kind kind) {
  for (const Variation& variation : variations()) {
    keys.push_back(
        {.name = fmt::format("{}.{}", section, variation.name),
         .kind = kind,
         .description = variation.description,
         .bounds = variation.bounds,
         .choices = variation.choices,
         .example = kind == Kind::axis ? variation.axis_example : variation.range_example,
         .element = variation.element});
  }
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const DesignMetric& metric : design_metrics()) names.emplace_back(metric.name);
  return names;
}

/// auto, and what stands alone or on either side of GLOBAL+LOCAL.
std::vector<std::string> optimizer_names() {
  std::vector<std::string> names{"auto", "dlib"};
  for (const std::string_view name : nlopt_algorithms()) names.emplace_back(name);
  return names;
}

/// Long, as it is the table.
std::vector<ConfigurationKey> make_keys() {
  std::vector<ConfigurationKey> keys{
      {.name = "telescope.diameter",
       .kind = Kind::length,
       .default_text = "0.5m",
       .description = "Pupil diameter D.",
       .bounds = diameter_bounds},
      {.name = "telescope.wavelength",
       .kind = Kind::length,
       .default_text = "532nm",
       .description = "Wavelength that the sensor works at.",
       .bounds = wavelength_bounds},
      {.name = "telescope.central_obscuration",
       .kind = Kind::number,
       .default_text = "0",
       .description = "Diameter of the central obscuration as a fraction of D.",
       .bounds = {.least = 0.0, .greatest = 1.0, .greatest_included = false},
       .example = "0.2"},
      {.name = "telescope.relay_beam_diameter",
       .kind = Kind::length,
       .description = "Beam diameter behind a relay; where set, distances on the bench are printed "
                      "too.",
       .bounds = bench_beam_bounds,
       .example = "10mm"},

      {.name = "seeing.d_over_r0",
       .kind = Kind::number_list,
       .default_text = "4",
       .description =
           "Pupil diameter over Fried parameter at telescope.wavelength. One measure of "
           "the seeing: set this, fried_parameter or fwhm. With several values, designs are "
           "tried in each, with each of the lights of the section detector.",
       .bounds = d_over_r0_bounds,
       .example = "4 or 4,8"},
      {.name = "seeing.fried_parameter",
       .kind = Kind::length_list,
       .description = "Fried parameter r0 at seeing.reference_wavelength, instead of d_over_r0.",
       .bounds = above(0),
       .example = "12.5cm"},
      {.name = "seeing.fwhm",
       .kind = Kind::number_list,
       .description = "Full width at half maximum of the seeing disc at "
                      "seeing.reference_wavelength, instead of d_over_r0; r0 = 0.976 wavelength / "
                      "fwhm.",
       .unit = "arcsec",
       .bounds = above(0),
       .example = "0.8"},
      {.name = "seeing.reference_wavelength",
       .kind = Kind::length,
       .description = "Wavelength at which fried_parameter or fwhm holds; r0 goes with its power "
                      "6/5. Not set: telescope.wavelength.",
       .bounds = wavelength_bounds,
       .example = "500nm"},
      {.name = "seeing.outer_scale",
       .kind = Kind::length,
       .description = "Outer scale of the turbulence (von Karman). Not set: infinite (Kolmogorov).",
       .bounds = at_least(1e-3),
       .example = "25m"},

      {.name = "source.bands",
       .kind = Kind::bands,
       .description =
           "Wavelengths of the light, SHORTEST:LONGEST: one band of all planes, or one for each "
           "plane in visiting order. A plane stands where the middle of its band has the Fresnel "
           "number that telescope.wavelength has at the distance of sensor.planes. Not set: "
           "telescope.wavelength alone.",
       .bounds = wavelength_bounds,
       .example = "400nm:500nm,500nm:600nm,600nm:700nm,700nm:800nm"},
      {.name = "source.division",
       .kind = Kind::choice,
       .default_text = "shared",
       .description = "How one band is divided between the planes: each has all of it (shared, by "
                      "beam splitters), or an equal part, shortest wavelengths first (split, by "
                      "dichroics).",
       .choices = {"shared", "split"}},
      {.name = "source.wavelengths",
       .kind = Kind::integer,
       .default_text = "20",
       .description = "How many wavelengths stand for a plane's band.",
       .bounds = from_to(1, 1000)},
      {.name = "source.weights",
       .kind = Kind::number_list,
       .description = "How much light each of the wavelengths has, shortest first. Not set: all "
                      "the same.",
       .bounds = at_least(0),
       .example = "1,2,2,1"},
      {.name = "source.aberration",
       .kind = Kind::choice,
       .default_text = "path",
       .description = "What of the aberration is the same at every wavelength: its optical path in "
                      "m, or its phase in rad.",
       .choices = word_list<ChromaticAberration>()},

      {.name = "screens.count",
       .kind = Kind::integer,
       .default_text = "16",
       .description = "Number of phase screens that a design is tried on.",
       .bounds = from_to(1, 1e6)},
      {.name = "screens.seed",
       .kind = Kind::seed,
       .default_text = "1",
       .description = "Seed of the phase screens and the noise: the same seed gives the same "
                      "answer to the last bit."},
      {.name = "screens.file",
       .kind = Kind::text,
       .description =
           "FITS cube of phase screens (n x n x count) to use instead of simulated ones, "
           "in rad at telescope.wavelength, or in m of optical path with BUNIT = 'm'.",
       .example = "screens.fits",
       .is_file = true},

      {.name = "sensor.planes",
       .kind = Kind::length_list,
       .default_text = "-180km,180km,-47km,47km",
       .description =
           "Signed distances of the measured planes from the pupil, in the order in "
           "which the reconstruction visits them. Not set: these, at their Fresnel numbers "
           "of the paper's telescope."},

      {.name = "frames.file",
       .kind = Kind::text,
       .description =
           "Measured detector frames for the command reconstruct, a FITS file: columns x rows x "
           "planes in the order of sensor.planes, and where there are several sets of frames a "
           "fourth axis. In any unit; values that are not finite count as bad pixels.",
       .example = "frames.fits",
       .is_file = true},
      {.name = "frames.background",
       .kind = Kind::text,
       .default_text = "0",
       .description =
           "What the frames have without light, in their unit, which is subtracted: a number, or a "
           "FITS file of one image, one for each plane or one for each frame.",
       .example = "dark.fits",
       .is_file = true},
      {.name = "frames.bad_pixels",
       .kind = Kind::text,
       .description = "FITS file that is not 0 where a pixel is bad, one image for all planes or "
                      "one for each. What bad pixels would have seen is left open.",
       .example = "bad-pixels.fits",
       .is_file = true},
      {.name = "frames.saturation",
       .kind = Kind::number,
       .description = "Value of the frames from which on a pixel counts as bad. Not set: none.",
       .bounds = above(0),
       .example = "65000"},
      {.name = "frames.centre",
       .kind = Kind::number_list,
       .description =
           "Where the optical axis meets each plane's frame, x1,y1,x2,y2,... in pixels as FITS "
           "counts them: the middle of the first is 1. Not set: the middle of the frames. Frames "
           "are not resampled: the light is brought to their pixels.",
       .unit = "pixels",
       .example = "128.5,128.5,130.2,127.9"},
      {.name = "frames.flux",
       .kind = Kind::number_list,
       .description = "How much light each plane got, relative to the others, as of a beam "
                      "splitter. Not set: not known, each plane's is found with the wavefront.",
       .bounds = above(0),
       .example = "1,1,0.8,0.8"},

      {.name = "detector.pupil_pixels",
       .kind = Kind::integer,
       .default_text = "64",
       .description = "Detector pixels across the pupil diameter, an even number.",
       .bounds = from_to(4, 8192)},
      {.name = "detector.window",
       .kind = Kind::number,
       .default_text = "4",
       .description = "Width of the detector.",
       .unit = "pupil diameters",
       .bounds = from_to(1, 64)},
      {.name = "detector.photons",
       .kind = Kind::number_list,
       .default_text = "0",
       .description =
           "Light per frame in all planes together; 0 = no photon noise. With several values, "
           "designs are tried with each.",
       .unit = "photons",
       .bounds = at_least(0),
       .example = "1e5 or 1e4,1e5"},
      {.name = "detector.photon_rate",
       .kind = Kind::number_list,
       .default_text = "0",
       .description = "Light per second in all planes together, instead of photons: a frame has "
                      "photon_rate x exposure photons; 0 = not used.",
       .unit = "photons/s",
       .bounds = at_least(0),
       .example = "1e8"},
      {.name = "detector.exposure",
       .kind = Kind::time,
       .description = "Exposure time of a frame, which counts towards the latency.",
       .bounds = above(0),
       .example = "1ms"},
      {.name = "detector.read_noise",
       .kind = Kind::number,
       .default_text = "0",
       .description = "Read noise per pixel, root mean square.",
       .unit = "electrons",
       .bounds = from_to(0, 1e6)},

      {.name = "reconstruction.max_loops",
       .kind = Kind::integer,
       .default_text = "20",
       .description = "Gerchberg-Saxton loops after which an unconverged reconstruction ends.",
       .bounds = from_to(1, 10000)},
      {.name = "reconstruction.tolerance",
       .kind = Kind::length,
       .default_text = "1nm",
       .description = "Change between consecutive loops below which the reconstruction has "
                      "converged, as optical path; 0 = always max_loops.",
       .bounds = from_to(0, 1e-3)},
      {.name = "reconstruction.stopping",
       .kind = Kind::choice,
       .default_text = "difference",
       .description = "What the tolerance is held against: the RMS of the change of the phase "
                      "(difference) or the change of the RMS of the wavefront (rms_change).",
       .choices = word_list<StoppingRule>()},
      {.name = "reconstruction.relaxation",
       .kind = Kind::ramp,
       .default_text = "0",
       .description = "Relaxation beta: each plane's amplitude becomes A + beta (A - |E|) for the "
                      "measured A; start:end is a linear ramp over the loops.",
       .bounds = relaxation_bounds,
       .example = "0.5 or 0.5:-0.5"},
      {.name = "reconstruction.initial_guess",
       .kind = Kind::choice,
       .default_text = "flat",
       .description = "First estimate of the phase: flat, or the tilt that the images' centroids "
                      "give.",
       .choices = word_list<InitialGuess>()},
      {.name = "reconstruction.window",
       .kind = Kind::number,
       .default_text = "8",
       .description = "Width of the grid that the reconstruction propagates on.",
       .unit = "pupil diameters",
       .bounds = from_to(1, 64)},
      {.name = "reconstruction.outside",
       .kind = Kind::choice,
       .default_text = "free",
       .description = "The field outside the detector at each plane: left as it is (free) or set "
                      "to zero.",
       .choices = word_list<OutsideDetector>()},
      {.name = "reconstruction.oversampling",
       .kind = Kind::integer,
       .default_text = "1",
       .description = "Reconstruction samples per detector pixel and axis.",
       .bounds = from_to(1, 16)},
      {.name = "reconstruction.unwrapping",
       .kind = Kind::choice,
       .default_text = "least_squares",
       .description = "How the reconstructed phase is unwrapped.",
       .choices = word_list<UnwrappingMethod>()},

      {.name = "simulation.truth",
       .kind = Kind::choice,
       .default_text = "extended",
       .description = "How the measurements are made: free of wrap-around and on a grid of its own "
                      "(extended), on the reconstruction's own periodic grid (matched), or on one "
                      "as wide with simulation.pupil_samples, binned to the pixels (periodic).",
       .choices = word_list<TruthModel>()},
      {.name = "simulation.pupil_samples",
       .kind = Kind::integer,
       .default_text = "128",
       .description = "Samples of the true field across the pupil diameter, a multiple of "
                      "detector.pupil_pixels; matched truth has detector.pupil_pixels.",
       .bounds = from_to(2, 8192)},
      {.name = "simulation.precision",
       .kind = Kind::choice,
       .default_text = "double",
       .description = "Floating point precision of the reconstruction; a search has its own, a "
                      "verification is always in double.",
       .choices = word_list<Precision>()},
      {.name = "simulation.time_limit",
       .kind = Kind::time,
       .description = "Longest time for one wavefront of a design, looked at between its loops: a "
                      "design with a slower one has failed. Not set: no limit.",
       .bounds = above(0),
       .example = "1s or 30min"},

      {.name = "objective.kind",
       .kind = Kind::choice,
       .default_text = "weighted",
       .description = "The cost: wfe / wfe_scale + loop_weight x loops + time_weight x time "
                      "(weighted), or total WFE and servo lag together in nm, without these "
                      "weights (error_budget, which needs greenwood_frequency or wind_speed).",
       .choices = word_list<CostKind>()},
      {.name = "objective.wfe",
       .kind = Kind::choice,
       .description = "Wavefront error in the weighted cost: against the truth on the "
                      "reconstruction's samples, of the unwrapped (residual) or the wrapped phase, "
                      "or at the truth's full resolution (total). Not set: residual, or total "
                      "where designs with different pupil_pixels are compared.",
       .choices = word_list<WavefrontErrorKind>()},
      {.name = "objective.wfe_scale",
       .kind = Kind::length,
       .default_text = "10nm",
       .description = "Wavefront error that costs 1.",
       .bounds = at_least(1e-12)},
      {.name = "objective.loop_weight",
       .kind = Kind::number,
       .default_text = "0.1",
       .description = "Cost of one loop.",
       .bounds = at_least(0)},
      {.name = "objective.time_weight",
       .kind = Kind::number,
       .default_text = "0",
       .description = "Cost of one second of reconstruction, as objective.fft_rate predicts it.",
       .unit = "1/s",
       .bounds = at_least(0)},
      {.name = "objective.fft_rate",
       .kind = Kind::number,
       .default_text = "5e9",
       .description = "Floating point operations per second of one Fourier transform, from which "
                      "the time of a reconstruction is predicted; the command benchmark measures "
                      "it.",
       .unit = "1/s",
       .bounds = above(0)},
      {.name = "objective.terms",
       .kind = Kind::text,
       .description = "METRIC:WEIGHT, separated by commas: adds WEIGHT x the metric to the cost.",
       .choices = metric_names(),
       .example = "latency_seconds:100,plane_count:0.05"},
      {.name = "objective.penalties",
       .kind = Kind::text,
       .description =
           "METRIC>BOUND:WEIGHT or METRIC<BOUND:WEIGHT, separated by commas: adds WEIGHT "
           "for each unit by which a screen's metric is above or below the bound.",
       .choices = metric_names(),
       .example = "total_wfe_nm>30:0.1,captured_energy<0.9:10"},
      {.name = "objective.limits",
       .kind = Kind::text,
       .description = "METRIC<BOUND or METRIC>BOUND, separated by commas: what must hold for a "
                      "design's mean over the screens.",
       .choices = metric_names(),
       .example = "latency_seconds<5e-3,field_strehl>0.9"},
      {.name = "objective.time_per_loop",
       .kind = Kind::time,
       .description = "Time of one loop in the latency. Not set: its Fourier transforms, by "
                      "fft_rate.",
       .bounds = above(0),
       .example = "20us"},
      {.name = "objective.readout_time_per_pixel",
       .kind = Kind::time,
       .default_text = "0",
       .description = "Read-out time of one detector pixel in the latency, which has the pixels of "
                      "all planes.",
       .bounds = at_least(0),
       .example = "0.001us"},
      {.name = "objective.greenwood_frequency",
       .kind = Kind::number,
       .description = "Greenwood frequency of the turbulence at telescope.wavelength, for the "
                      "servo lag.",
       .unit = "Hz",
       .bounds = above(0),
       .example = "30"},
      {.name = "objective.wind_speed",
       .kind = Kind::number,
       .description = "Wind speed of the turbulence, instead of greenwood_frequency: 0.427 v / r0.",
       .unit = "m/s",
       .bounds = above(0),
       .example = "10"},
      {.name = "objective.aggregate",
       .kind = Kind::choice,
       .default_text = "mean",
       .description = "What counts of the costs under several seeings and lights: their mean, the "
                      "condition with the highest (worst), or of all screens and conditions the "
                      "quantile at level or the mean cost beyond it (cvar).",
       .choices = word_list<AggregateKind>()},
      {.name = "objective.level",
       .kind = Kind::number,
       .default_text = "0.9",
       .description = "Level of quantile and cvar.",
       .bounds =
           {.least = 0.0, .greatest = 1.0, .least_included = false, .greatest_included = false}},

      {.name = "search.layout",
       .kind = Kind::choice,
       .default_text = "symmetric",
       .description = "Planes in pairs -z, +z at z_near and z_far (symmetric), or each at its own "
                      "distance z1, z2, ... (free). Their keys are those below; distances that are "
                      "not set are searched between the Fresnel numbers 200 and 2, on either side "
                      "of the pupil in a free layout; what else is not set is not varied.",
       .choices = word_list<Layout>()},
      {.name = "search.plane_count",
       .kind = Kind::domain,
       .default_text = "4",
       .description = "Numbers of planes that are searched. A symmetric layout of an odd number "
                      "leaves one plane of a pair out.",
       .bounds = from_to(2, 6),
       .example = "3,4 or 2:6",
       .element = Kind::integer},
      {.name = "search.order",
       .kind = Kind::orders,
       .default_text = "all",
       .description =
           "Orders in which a symmetric layout may be visited: plane numbers, where 1 is "
           "-z_near, 2 +z_near, 3 -z_far, 4 +z_far, 5 -z_third, 6 +z_third.",
       .choices = {"all"},
       .example = "all or 3412,1234"},
      {.name = "search.optimizer",
       .kind = Kind::text,
       .default_text = "auto",
       .description = "Method: GLOBAL+LOCAL, one of either, or auto, which picks by the space: "
                      "direct_l for continuous variables and one number of planes, else dlib; then "
                      "sbplx for up to two continuous variables, else nelder_mead. Global: "
                      "direct_l, direct_l_rand, crs2, mlsl, isres, esch, dlib (the only one that "
                      "models discrete variables); local: sbplx, nelder_mead, bobyqa, cobyla, "
                      "praxis.",
       .choices = optimizer_names(),
       .example = "direct_l+bobyqa"},
      {.name = "search.budget",
       .kind = Kind::integer,
       .default_text = "150",
       .description = "Designs that the search may try.",
       .bounds = from_to(1, 1e9)},
      {.name = "search.race",
       .kind = Kind::number,
       .default_text = "0.05",
       .description =
           "A design that is worse than the best one so far on its first 4, 8, ... screens "
           "is given up there. This is the chance to give up one that is as good, at "
           "most; 0 = every design is tried on all screens.",
       .bounds = {.least = 0.0, .greatest = 0.2}},
      {.name = "search.stagnation",
       .kind = Kind::integer,
       .default_text = "0",
       .description =
           "Designs in a row that are no better after which the search ends; 0 = however "
           "many.",
       .bounds = from_to(0, 1e9)},
      {.name = "search.target",
       .kind = Kind::number,
       .description = "Cost at which the search ends. Not set: none.",
       .example = "1.0"},
      {.name = "search.cheap_budget",
       .kind = Kind::integer,
       .default_text = "0",
       .description = "Designs of a cheap search before the search proper, in single precision, "
                      "whose best ones it starts from; 0 = none.",
       .bounds = from_to(0, 1e9)},
      {.name = "search.cheap_screens",
       .kind = Kind::integer,
       .default_text = "4",
       .description = "Number of phase screens of the cheap search.",
       .bounds = from_to(1, 1e6)},
      {.name = "search.cheap_window",
       .kind = Kind::number,
       .default_text = "0.5",
       .description = "Window of the reconstruction in the cheap search, as a fraction of "
                      "reconstruction.window, but at least the detector's.",
       .bounds = {.least = 0.0, .greatest = 1.0, .least_included = false}},
      {.name = "search.precision",
       .kind = Kind::choice,
       .default_text = "single",
       .description =
           "Floating point precision of the reconstruction while searching: single takes "
           "0.6 of the time, and residuals of reconstructions that converge agree within 0.02 nm.",
       .choices = word_list<Precision>()},
      {.name = "search.seed",
       .kind = Kind::seed,
       .default_text = "1",
       .description = "Seed of the optimizer's own random numbers."},
      {.name = "search.time_limit",
       .kind = Kind::time,
       .description = "Time after which the search ends with the best design so far. Not set: no "
                      "limit.",
       .bounds = above(0),
       .example = "90s or 30min"}};
  add_variations(keys, "search", Kind::domain);
  keys.insert(
      keys.end(),
      {{.name = "sweep.layout",
        .kind = Kind::choice,
        .default_text = "symmetric",
        .description =
            "Layout of the designs of a sweep, as search.layout. Every key below that is "
            "set is an axis of its grid; distances that are not are those of "
            "sensor.planes, what else is not set is not varied.",
        .choices = word_list<Layout>()},
       {.name = "sweep.crossed_pairs",
        .kind = Kind::choice,
        .default_text = "kept",
        .description = "Points whose z_near is above their z_far: the same planes in another "
                       "visiting order, kept or left out.",
        .choices = {"kept", "left_out"}},
       {.name = "sweep.plane_count",
        .kind = Kind::axis,
        .description = "Numbers of planes. Not set: as many as sensor.planes, and in a free layout "
                       "those that have a key beyond.",
        .bounds = from_to(2, 6),
        .example = "2,3,4",
        .element = Kind::integer},
       {.name = "sweep.order",
        .kind = Kind::orders,
        .description = "Orders in which a symmetric layout is visited, as search.order. Not set: "
                       "the order of sensor.planes.",
        .choices = {"all"},
        .example = "all or 3412,1234"}});
  add_variations(keys, "sweep", Kind::axis);
  const std::vector<ConfigurationKey> others{
      {.name = "trade.objectives",
       .kind = Kind::text,
       .default_text = "total_wfe_nm,model_seconds,detector_pixels,plane_count",
       .description =
           "METRICs that are traded, at least two; objective.limits holds too. The space is that "
           "of the section search, where these are defaults of trade: plane_count 2:5, "
           "pupil_pixels a quarter, a half and all of detector.pupil_pixels, relaxation -0.3:0.7, "
           "initial_guess flat,centroid, reconstruction_oversampling 1,2.",
       .choices = metric_names(),
       .example = "total_wfe_nm,latency_seconds"},
      {.name = "trade.algorithm",
       .kind = Kind::choice,
       .default_text = "nsga2",
       .description = "Method: a genetic algorithm (nsga2) or a particle swarm (nspso), both with "
                      "non-dominated sorting.",
       .choices = {"nsga2", "nspso"}},
      {.name = "trade.population",
       .kind = Kind::integer,
       .default_text = "16",
       .description = "Designs in each generation of each number of planes, a multiple of 4.",
       .bounds = from_to(8, 1e6)},
      {.name = "trade.budget",
       .kind = Kind::integer,
       .default_text = "240",
       .description = "Designs that the search may try.",
       .bounds = from_to(1, 1e9)},
      {.name = "trade.verified",
       .kind = Kind::integer,
       .default_text = "24",
       .description = "How many designs of the front are verified on fresh screens; of more, some "
                      "of each number of planes and pixels.",
       .bounds = from_to(1, 1e6)},
      {.name = "trade.reference",
       .kind = Kind::number_list,
       .description =
           "Reference point of the hypervolume: a bound that counts as worthless, for "
           "each objective in its unit. Not set: a quarter of the wavelength for "
           "wavefront errors, the greatest model time of reconstruction.max_loops loops and "
           "detector pixels that seven planes could have here, seven planes; of other "
           "metrics the worst value in the first populations.",
       .example = "100,0.5,400000,7"},

      {.name = "baseline.planes",
       .kind = Kind::length_list,
       .default_text = "-47km,47km,-180km,180km",
       .description = "Planes, in visiting order, of the design that the best one is compared "
                      "with. Not set: the paper's, at their Fresnel numbers."},
      {.name = "baseline.relaxation",
       .kind = Kind::ramp,
       .default_text = "0",
       .description = "Relaxation of the baseline, as reconstruction.relaxation.",
       .bounds = relaxation_bounds,
       .example = "0.5 or 0.5:-0.5"},
      {.name = "baseline.initial_guess",
       .kind = Kind::choice,
       .default_text = "flat",
       .description = "First estimate of the baseline, as reconstruction.initial_guess.",
       .choices = word_list<InitialGuess>()},

      {.name = "verify.screens",
       .kind = Kind::integer,
       .description =
           "Number of fresh phase screens that the result of a search is verified on. Not "
           "set: 64, or four times screens.count where that is more.",
       .bounds = from_to(2, 1e6),
       .example = "256"},
      {.name = "verify.candidates",
       .kind = Kind::integer,
       .default_text = "3",
       .description = "How many of the search's best designs are verified; the best on the fresh "
                      "screens is reported as the best.",
       .bounds = from_to(1, 5)},
      {.name = "verify.seed",
       .kind = Kind::seed,
       .default_text = "1000003",
       .description = "Seed of the fresh screens, not screens.seed."},
      {.name = "verify.truth_factor",
       .kind = Kind::integer,
       .default_text = "2",
       .description = "How much finer the true field is sampled in the verification than in the "
                      "search.",
       .bounds = from_to(1, 16)},

      {.name = "advise.law",
       .kind = Kind::text,
       .description = "File of the scaling law that advise follows, such as a run of advise leaves "
                      "as law.json. Not set: the law that is built into the program.",
       .example = "law.json",
       .is_file = true},

      {.name = "law.d_over_r0",
       .kind = Kind::number_list,
       .default_text = "3,4,5,6,8,10",
       .description = "Seeings at which law searches designs, to fit the scaling law to them.",
       .bounds = d_over_r0_bounds},

      {.name = "export.formats",
       .kind = Kind::text,
       .default_text = "csv,json,fits",
       .description = "What export writes, one or more of csv (comma-separated values), json and "
                      "fits (a binary table).",
       .choices = {"csv", "json", "fits"}},

      {.name = "reproduce.figures",
       .kind = Kind::text,
       .default_text = "3,4,5,6,7,8,scaling,response,numerics",
       .description = "What of Letchev et al. 2022 reproduce runs: figures by their numbers, the "
                      "scaling by Fresnel numbers, the response to single spatial frequencies, "
                      "what the numerics decide."},
      {.name = "reproduce.grid",
       .kind = Kind::integer,
       .default_text = "32",
       .description = "Distances on each axis of the maps of reproduce, up to 250 km.",
       .bounds = from_to(4, 256)},

      {.name = "response.frequencies",
       .kind = Kind::axis,
       .description = "Spatial frequencies at which response measures a sensor. Not set: 1, 2, ... "
                      "16, as far as they are below half of detector.pupil_pixels.",
       .unit = "cycles per pupil diameter",
       .bounds = above(0),
       .example = "1:16:16 or 0.5,1,2"},
      {.name = "response.amplitude",
       .kind = Kind::length,
       .default_text = "10nm",
       .description = "Amplitude (peak) of the sinusoidal aberrations of response, optical path; "
                      "their orientations and phases are drawn for each of screens.count.",
       .bounds = path_bounds},
      {.name = "response.distances",
       .kind = Kind::axis,
       .description = "Distances z at which response measures pairs of planes -z, +z too: a map. "
                      "Not set: only the configured planes.",
       .bounds = above(0),
       .example = "10km:200km:20",
       .element = Kind::length},

      {.name = "scale.diameter",
       .kind = Kind::length,
       .description = "Pupil diameter of the telescope that a design is moved to. Not set: as "
                      "telescope.diameter.",
       .bounds = diameter_bounds,
       .example = "8.2m"},
      {.name = "scale.wavelength",
       .kind = Kind::length,
       .description = "Wavelength that a design is moved to. Not set: as telescope.wavelength.",
       .bounds = wavelength_bounds,
       .example = "850nm"},
      {.name = "scale.relay_beam_diameter",
       .kind = Kind::length,
       .description =
           "Beam diameter behind a relay at the telescope that a design is moved to. Not "
           "set: as telescope.relay_beam_diameter.",
       .bounds = bench_beam_bounds,
       .example = "10mm"}};
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

}  // namespace

const std::vector<ConfigurationKey>& configuration_keys() {
  static const std::vector<ConfigurationKey> keys = make_keys();
  return keys;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> known{{"paper",
                                          "the set-up of Letchev et al. 2022",
                                          {{"simulation.truth", "matched"},
                                           {"reconstruction.window", "4"},
                                           {"reconstruction.stopping", "rms_change"},
                                           {"source.aberration", "phase"},
                                           {"sensor.planes", "-47km,47km,-180km,180km"}}}};
  return known;
}

}  // namespace nlcwfs
