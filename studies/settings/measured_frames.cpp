// A user's own frames are read, as the section frames describes them.
#include "studies/settings/measured_frames.hpp"

#include "model/frame_calibration.hpp"
#include "model/input_error.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/trials.hpp"
#include "studies/settings/units.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

/// The sizes of the frames, which everything that belongs to them must have.
struct FrameShape {
  Eigen::Index rows;
  Eigen::Index columns;
  std::size_t planes;
  std::size_t sets;
};

FrameShape shape_of(const FitsCube& frames, const Configuration& configuration) {
  const std::string& file = configuration.text("frames.file");
  const FrameShape shape{.rows = frames.slices.front().rows(),
                         .columns = frames.slices.front().cols(),
                         .planes = frames.slices.size() / frames.sets,
                         .sets = frames.sets};
  if (configuration.source("sensor.planes").starts_with(Configuration().source("sensor.planes"))) {
    throw InputError("sensor.planes", configuration.value_text("sensor.planes"),
                     "these are the program's own",
                     "give those of your frames, such as --sensor.planes=-120km,120km,-30km,30km");
  }
  const std::size_t planes = configuration.lengths("sensor.planes").size();
  if (shape.planes != planes) {
    throw InputError(
        "frames.file", file,
        fmt::format("the number of its planes is {}, of sensor.planes {}", shape.planes, planes),
        "give the distance of each plane, in the file's order");
  }
  return shape;
}

/// What a file has for each frame.
class FrameSeries {
 public:
  /// @param most_sets  1, or as many as there are sets of frames
  /// @param what       is allowed, for messages
  FrameSeries(const std::string& key, const std::string& file, const FrameShape& shape,
              std::size_t most_sets, std::string_view what)
      : cube_(read_fits_cube(file, key, FitsGaps::allowed, FitsShape::frames, what)),
        planes_(cube_.slices.size() / cube_.sets) {
    const Eigen::Index rows = cube_.slices.front().rows();
    const Eigen::Index columns = cube_.slices.front().cols();
    if (rows != shape.rows || columns != shape.columns) {
      throw InputError(
          key, file,
          fmt::format("its images are {} x {} pixels; as large as the frames, {} x {}, are allowed",
                      columns, rows, shape.columns, shape.rows));
    }
    const bool fits_sets = cube_.sets == 1 || (cube_.sets == most_sets && planes_ == shape.planes);
    if (!fits_sets || (planes_ != 1 && planes_ != shape.planes)) {
      throw InputError(
          key, file,
          fmt::format("it has {} images; one for all planes or {} are allowed", cube_.slices.size(),
                      most_sets == 1 ? fmt::format("one for each, which are {},", shape.planes)
                                     : fmt::format("one for each ({}) or for each frame ({})",
                                                   shape.planes, shape.planes * most_sets)));
    }
  }

  const Image<double>& at(std::size_t set, std::size_t plane) const {
    return cube_.slices[(cube_.sets == 1 ? 0 : set) * planes_ + (planes_ == 1 ? 0 : plane)];
  }

 private:
  FitsCube cube_;
  std::size_t planes_;
};

std::vector<Eigen::Array2d> axes_of(const Configuration& configuration, const FrameShape& shape) {
  std::vector<double> centres;
  if (configuration.is_set("frames.centre")) {
    centres = configuration.numbers("frames.centre");
    if (centres.size() != 2 * shape.planes) {
      throw InputError("frames.centre", configuration.value_text("frames.centre"),
                       fmt::format("x and y of each plane are {} numbers for {} planes, not {}",
                                   2 * shape.planes, shape.planes, centres.size()));
    }
  } else {
    for (std::size_t plane = 0; plane < shape.planes; ++plane) {
      centres.push_back(0.5 * double(shape.columns + 1));
      centres.push_back(0.5 * double(shape.rows + 1));
    }
  }
  const double middle = 0.5 * double(calibrated_width(shape.rows, shape.columns) + 1);
  std::vector<Eigen::Array2d> axes;
  for (std::size_t plane = 0; plane < shape.planes; ++plane) {
    const double x = centres[2 * plane];
    const double y = centres[2 * plane + 1];
    if (!(x >= 1.0 && x <= double(shape.columns) && y >= 1.0 && y <= double(shape.rows))) {
      throw InputError("frames.centre", fmt::format("{},{}", x, y),
                       fmt::format("plane {}: in the frame, x from 1 to {} and y from 1 to {}",
                                   plane + 1, shape.columns, shape.rows));
    }
    axes.emplace_back(x - middle, y - middle);
  }
  return axes;
}

/// Refuses a frame that says nothing.
void require_light(const Image<double>& frame, std::size_t plane, std::size_t set,
                   const Configuration& configuration) {
  const std::string where = fmt::format("plane {} of set {}", plane + 1, set + 1);
  const std::string& file = configuration.text("frames.file");
  if (!frame.isFinite().any()) {
    throw InputError("frames.file", file, fmt::format("{} has no pixel that is not bad", where),
                     "see frames.bad_pixels and frames.saturation");
  }
  const double light = frame.isFinite().select(frame, 0.0).sum();
  if (!(light > 0.0)) {
    throw InputError("frames.file", file,
                     fmt::format("{} has no light: its pixels sum to {:.6g} without the background",
                                 where, light),
                     "see frames.background");
  }
}

/// The keywords that the program itself writes are to be the configuration's.
void require_telescope_of(const FitsCube& frames, const Configuration& configuration) {
  const auto require = [&](const std::string& key, const char* keyword,
                           const std::optional<double>& length) {
    if (!length || is_same_length(*length, configuration.length(key))) return;
    throw InputError(key, configuration.value_text(key),
                     fmt::format("{} of frames.file is {}", keyword, format_length(*length)),
                     fmt::format("set --{} {:g}", key, *length));
  };
  require("telescope.diameter", "DIAMETER", frames.diameter);
  require("telescope.wavelength", "WAVELEN", frames.wavelength);
}

}  // namespace

MeasuredFrames measured_frames_of(const Configuration& configuration) {
  const std::string& file = configuration.text("frames.file");
  if (file.empty()) {
    throw InputError("frames.file", one_line(file),
                     "the FITS file of your frames, such as --frames frames.fits");
  }
  const FitsCube frames = read_fits_cube(file, "frames.file", FitsGaps::allowed, FitsShape::frames);
  require_telescope_of(frames, configuration);
  const FrameShape shape = shape_of(frames, configuration);

  MeasuredFrames result;
  result.unit = frames.unit;
  result.axes = axes_of(configuration, shape);
  if (configuration.is_set("frames.flux")) {
    result.throughputs = configuration.numbers("frames.flux");
    if (result.throughputs.size() != shape.planes) {
      throw InputError("frames.flux", configuration.value_text("frames.flux"),
                       fmt::format("one number for each of {} planes", shape.planes));
    }
  }

  const std::string& background_text = configuration.text("frames.background");
  const std::optional<double> level = parse_number(background_text);
  std::optional<FrameSeries> backgrounds;
  if (!level) {
    backgrounds.emplace("frames.background", background_text, shape, shape.sets,
                        "a number, or a FITS file of one image, one for each plane or one for each "
                        "frame");
  }
  const std::string& bad_file = configuration.text("frames.bad_pixels");
  std::optional<FrameSeries> bad_pixels;
  if (!bad_file.empty()) {
    bad_pixels.emplace("frames.bad_pixels", bad_file, shape, 1,
                       "a FITS file of one image, or one for each plane");
  }
  const double saturation = configuration.optional_number("frames.saturation")
                                .value_or(std::numeric_limits<double>::infinity());

  const auto plain = [&](double value) {
    return Image<double>(Image<double>::Constant(shape.rows, shape.columns, value));
  };
  for (std::size_t set = 0; set < shape.sets; ++set) {
    result.sets.emplace_back();
    for (std::size_t plane = 0; plane < shape.planes; ++plane) {
      const PixelMask bad = (bad_pixels ? bad_pixels->at(set, plane) : plain(0.0)) != 0.0;
      result.sets.back().push_back(
          calibrated_frame(frames.slices[set * shape.planes + plane],
                           level ? plain(*level) : backgrounds->at(set, plane), bad, saturation));
      require_light(result.sets.back().back(), plane, set, configuration);
    }
  }
  return result;
}

void set_detector_window(Configuration& configuration, const MeasuredFrames& frames) {
  const std::string& file = configuration.text("frames.file");
  const int pupil_pixels = configuration.integer("detector.pupil_pixels");
  const double window = double(frames.width()) / pupil_pixels;
  const std::string width = fmt::format(
      "its frames are {} pixels wide, which is {:.6g} pupil "
      "diameters of detector.pupil_pixels = {}",
      frames.width(), window, pupil_pixels);
  if (window < 1.0) {
    throw InputError("frames.file", file, width + "; the pupil must fit on the detector");
  }
  if (const double widest = configuration.number("reconstruction.window"); window > widest) {
    throw InputError("frames.file", file,
                     fmt::format("{}; the grid of the reconstruction must be as wide: set "
                                 "reconstruction.window, which is {:g}, to {:g} or more",
                                 width, widest, std::ceil(window)));
  }
  const std::string key = "detector.window";
  const bool is_default = configuration.source(key) == Configuration().source(key);
  if (!is_default && std::lround(configuration.number(key) * pupil_pixels) != frames.width()) {
    throw InputError(
        key, configuration.value_text(key),
        fmt::format("the frames are {:.6g} pupil diameters of detector.pupil_pixels = {} wide",
                    window, pupil_pixels),
        "leave it away");
  }
  configuration.set(key, fmt::format("{}", window), "by the width of the frames");
}

}  // namespace nlcwfs
