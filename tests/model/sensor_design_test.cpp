// Tests: What a sensor is: planes, detector and reconstruction.
#include "model/sensor_design.hpp"

#include "tests/message_of.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a design says after a change.
template <class Change>
std::string message_after(const Change& change, const Telescope& telescope = {}) {
  SensorDesign design;
  change(design);
  return message_of([&] { design.validate(telescope); });
}

template <class Change>
std::string message_after_options(const Change& change) {
  return message_after([&](SensorDesign& design) { change(design.reconstruction); });
}

TEST(SensorDesign, DefaultsAreAllowed) {
  EXPECT_EQ(message_after([](SensorDesign&) {}), "");
}

TEST(SensorDesign, NeedsTwoPlanes) {
  EXPECT_THAT(message_after([](SensorDesign& design) { design.planes = {}; }),
              StartsWith("sensor.planes = : at least 2"));
  EXPECT_THAT(message_after([](SensorDesign& design) { design.planes = {1e3}; }),
              StartsWith("sensor.planes = 1000: at least 2"));
  EXPECT_EQ(message_after([](SensorDesign& design) { design.planes = {0.0, 0.0}; }), "");
}

TEST(SensorDesign, ImagesFitIntoTheMemoryThatIsAllowed) {
  // 8192 x 8192 samples of 8 bytes are half a GiB.
  const auto with_planes = [](std::size_t planes) {
    return [=](SensorDesign& design) {
      design.planes.assign(planes, 47e3);
      design.detector.pupil_pixels = 1024;
      design.reconstruction.window = 8.0;
    };
  };
  EXPECT_EQ(message_after(with_planes(32)), "");
  EXPECT_EQ(message_after(with_planes(33)),
            "sensor.planes = 33 distances: at most 32: images of 8192 x 8192 samples take 16.5 GiB "
            "of memory, and 16 GiB are allowed");
}

TEST(SensorDesign, PlanesStayBelowAFresnelNumberOfATenth) {
  // D^2 / (0.1 lambda) = 4699.248 km.
  const auto with_plane = [](double plane) {
    return [=](SensorDesign& design) { design.planes = {plane, 47e3}; };
  };
  EXPECT_EQ(message_after(with_plane(4.699e6)), "");
  EXPECT_EQ(message_after(with_plane(-4.699e6)), "");
  for (const double plane : {4.7e6, -4.7e6, infinity}) {
    EXPECT_THAT(
        message_after(with_plane(plane)),
        AllOf(StartsWith(fmt::format("sensor.planes = {}: ", plane)), HasSubstr("+-4699 km")));
  }
  EXPECT_THAT(message_after(with_plane(nan)), StartsWith("sensor.planes = nan: "));
  // Four times the diameter sees sixteen times as far.
  EXPECT_EQ(message_after(with_plane(16 * 4.699e6), {.diameter = 2.0}), "");
}

TEST(SensorDesign, ReportsTheDetectorsErrors) {
  EXPECT_THAT(message_after([](SensorDesign& design) { design.detector.pupil_pixels = 63; }),
              StartsWith("detector.pupil_pixels = 63: "));
  EXPECT_THAT(message_after([](SensorDesign& design) { design.detector.photons = -1.0; }),
              StartsWith("detector.photons = -1: "));
}

TEST(SensorDesign, LoopsAndToleranceAreInRange) {
  for (const int loops : {1, 10000}) {
    EXPECT_EQ(message_after_options([&](auto& options) { options.max_loops = loops; }), "");
  }
  for (const int loops : {-1, 0, 10001}) {
    EXPECT_THAT(message_after_options([&](auto& options) { options.max_loops = loops; }),
                StartsWith(fmt::format("reconstruction.max_loops = {}: from 1 to 10000", loops)));
  }
  EXPECT_EQ(message_after_options([](auto& options) { options.tolerance = 0.0; }), "");
  for (const double tolerance : {-1e-9, nan, infinity}) {
    EXPECT_THAT(message_after_options([&](auto& options) { options.tolerance = tolerance; }),
                StartsWith(fmt::format("reconstruction.tolerance = {}: ", tolerance)));
  }
}

TEST(SensorDesign, RelaxationLiesBetweenMinusOneAndOne) {
  EXPECT_EQ(message_after_options([](auto& options) {
              options.relaxation_start = 0.999;
              options.relaxation_end = -0.999;
            }),
            "");
  for (const double beta : {1.0, -1.0, 3.0, nan}) {
    const std::string expected = fmt::format("reconstruction.relaxation = {}: above -1", beta);
    EXPECT_THAT(message_after_options([&](auto& options) { options.relaxation_start = beta; }),
                StartsWith(expected));
    EXPECT_THAT(message_after_options([&](auto& options) { options.relaxation_end = beta; }),
                StartsWith(expected));
  }
}

TEST(SensorDesign, OversamplingAndGridAreInRange) {
  for (const int oversampling : {0, -1, 17}) {
    EXPECT_THAT(
        message_after_options([&](auto& options) { options.oversampling = oversampling; }),
        StartsWith(fmt::format("reconstruction.oversampling = {}: from 1 to 16", oversampling)));
  }
  EXPECT_THAT(message_after_options([](auto& options) { options.window = 0.5; }),
              StartsWith("reconstruction.window = 0.5: at least 1 pupil diameter"));
  EXPECT_THAT(message_after_options([](auto& options) { options.window = 8.01; }),
              StartsWith("reconstruction.window = 8.01: window x detector.pupil_pixels x "
                         "reconstruction.oversampling must be an even whole number"));
  EXPECT_THAT(message_after_options([](auto& options) { options.window = 200.0; }),
              StartsWith("reconstruction.window = 200: at most 128 "));
  EXPECT_THAT(message_after_options([](auto& options) { options.window = 3.0; }),
              StartsWith("reconstruction.window = 3: at least detector.window, which is 4"));
  EXPECT_EQ(message_after_options([](auto& options) { options.window = 4.0; }), "");
}

TEST(SensorDesign, GridCoversTheWindowAtTheReconstructionsSampling) {
  SensorDesign design;
  design.detector.pupil_pixels = 32;
  design.reconstruction.oversampling = 3;
  design.reconstruction.window = 6.0;
  EXPECT_EQ(design.pupil_samples(), 96);
  EXPECT_EQ(design.grid_width(), 576);
}

TEST(SensorDesign, RelaxationIsALineFromTheFirstLoopToTheLast) {
  ReconstructionOptions options{.max_loops = 5, .relaxation_start = 0.6, .relaxation_end = -0.2};
  EXPECT_DOUBLE_EQ(options.relaxation(1), 0.6);
  EXPECT_DOUBLE_EQ(options.relaxation(2), 0.4);
  EXPECT_DOUBLE_EQ(options.relaxation(3), 0.2);
  EXPECT_DOUBLE_EQ(options.relaxation(5), -0.2);
  options.max_loops = 1;
  EXPECT_DOUBLE_EQ(options.relaxation(1), 0.6);
}

}  // namespace
}  // namespace nlcwfs
