// Tests: A design is shown on its typical and on its worst wavefront.
#include "studies/search/closer_look.hpp"

#include "model/pupil.hpp"
#include "model/wavefront_metrics.hpp"
#include "results/fits/fits_cube.hpp"
#include "results/tables/csv_table.hpp"
#include "tests/objectives/tiny_simulation.hpp"
#include "tests/scratch_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

constexpr double nm = 1e-9;

class CloserLookTest : public ScratchFolder {
 protected:
  static OutputFolder folder(const std::string& name) {
    return {std::filesystem::path(name), "evaluate"};
  }
  static FitsCube cube(const std::string& path) {
    return read_fits_cube(path, "test", FitsGaps::allowed);
  }
  static double residual_nm(const ScreenPerformance& screen) {
    return screen.wavefront.residual_wfe / nm;
  }

  Telescope telescope_;
  SensorDesign design_ = [this] {
    SensorDesign design = tiny_design(telescope_);
    design.detector.photons = 1e5;
    return design;
  }();
};

TEST_F(CloserLookTest, ChoosesTheMedianAndTheWorstScreen) {
  for (const int count : {1, 2, 5, 6}) {
    SCOPED_TRACE(count);
    const DesignTrial trial({tiny_condition(telescope_, 4.0, count)}, {});
    const TriedDesign tried = trial.run(design_);
    const CloserLook look = look_closer(trial, tried, folder(fmt::format("run{}", count)));
    EXPECT_THAT(look.notes, IsEmpty());
    std::vector<double> residuals;
    for (const auto& screen : tried.performances[0].screens) {
      residuals.push_back(residual_nm(screen));
    }
    for (const char* name : {"typical", "worst"}) {
      const auto& object = look.summary.at(name);
      const ScreenPerformance& screen = tried.performances[0].screens.at(object.at("screen"));
      EXPECT_EQ(object.at("residual_wfe_nm"), residual_nm(screen));
      EXPECT_EQ(object.at("loops"), screen.loops);
      EXPECT_FALSE(object.contains("condition"));
    }
    std::ranges::sort(residuals);
    EXPECT_EQ(look.summary["typical"]["residual_wfe_nm"], residuals[(residuals.size() - 1) / 2]);
    EXPECT_EQ(look.summary["worst"]["residual_wfe_nm"], residuals.back());
  }
}

TEST_F(CloserLookTest, LeavesItsFilesAndPictures) {
  const DesignTrial trial({tiny_condition(telescope_, 4.0, 3)}, {});
  look_closer(trial, trial.run(design_), folder("run"));
  EXPECT_THAT(names_in("run"),
              ElementsAre("design.png", "design.svg", "loops.csv", "loops.png", "loops.svg",
                          "typical-images.fits", "typical-images.png", "typical-images.svg",
                          "typical-phases.fits", "typical-phases.png", "typical-phases.svg",
                          "worst-images.fits", "worst-images.png", "worst-images.svg",
                          "worst-phases.fits", "worst-phases.png", "worst-phases.svg"));
}

TEST_F(CloserLookTest, ItsFilesAreWhatTheSimulationSawAndMade) {
  const DesignTrial trial({tiny_condition(telescope_, 4.0, 3)}, {});
  const CloserLook look = look_closer(trial, trial.run(design_), folder("run"));
  const PupilMask mask = pupil_mask(16, 0.0);
  for (const std::string name : {"typical", "worst"}) {
    SCOPED_TRACE(name);
    const Simulation& simulation = *trial.conditions().front().simulation;
    const ScreenRecord record = simulation.record(design_, look.summary[name]["screen"]);

    const FitsCube images = cube("run/" + name + "-images.fits");
    ASSERT_EQ(images.slices.size(), 4u);
    for (int plane = 0; plane < 4; ++plane) {
      EXPECT_TRUE((images.slices[plane] == record.images[plane]).all());
    }
    EXPECT_THAT(
        contents("run/" + name + "-images.fits"),
        AllOf(HasSubstr("NAXIS1  =                   32"), HasSubstr("BUNIT   = '1       '"),
              HasSubstr("CDELT1  =              0.03125"),
              HasSubstr("CRPIX2  =                 16.5"), HasSubstr("CTYPE3  = 'PLANE   '"),
              HasSubstr("PLANE4  ="), HasSubstr("PHOTONS =              100000.")));

    const FitsCube phases = cube("run/" + name + "-phases.fits");
    EXPECT_EQ(phases.unit, "rad");
    ASSERT_EQ(phases.slices.size(), 3u);
    for (const Image<double>& phase : phases.slices) {
      EXPECT_TRUE((phase.isNaN() == !mask).all());
      EXPECT_NEAR(piston(phase, mask), 0.0, 1e-12);
    }
    EXPECT_NEAR(piston_free_rms(phases.slices[2], mask) * telescope_.wavelength /
                    (2.0 * std::numbers::pi) / nm,
                look.summary[name]["residual_wfe_nm"], 1e-9);
    EXPECT_LT(
        mask.select((phases.slices[1] - phases.slices[0] - phases.slices[2]).abs(), 0.0).maxCoeff(),
        1e-12);
    EXPECT_THAT(contents("run/" + name + "-phases.fits"),
                AllOf(HasSubstr("CUNIT1  = 'm       '"), HasSubstr("PHASE2  = 'reconstructed'"),
                      HasSubstr("NAXIS3  =                    3")));
  }
}

TEST_F(CloserLookTest, TheLoopsEndWhereEachScreenStopped) {
  design_.detector.photons = 0.0;
  const DesignTrial trial({tiny_condition(telescope_, 4.0, 6)}, {});
  const CloserLook look = look_closer(trial, trial.run(design_), folder("run"));
  const std::vector<CsvRow> rows = read_csv("run/loops.csv");
  std::size_t most = 0;
  for (const std::string name : {"typical", "worst"}) {
    const std::size_t loops = look.summary[name]["loops"];
    most = std::max(most, loops);
    for (std::size_t loop = 0; loop < rows.size(); ++loop) {
      EXPECT_EQ(rows[loop].at(name + "_residual_wfe_nm").empty(), loop >= loops) << loop;
    }
    EXPECT_EQ(std::stod(rows.at(loops - 1).at(name + "_residual_wfe_nm")),
              look.summary[name]["residual_wfe_nm"]);
  }
  EXPECT_EQ(rows.size(), most);
  EXPECT_EQ(rows.front().at("loop"), "1");
}

TEST_F(CloserLookTest, OfSeveralConditionsTheWorstMayBeOfAny) {
  Condition weak = tiny_condition(telescope_, 2.0, 3);
  weak.name = "weak";
  Condition strong = tiny_condition(telescope_, 8.0, 3);
  strong.name = "strong";
  strong.light = 1e4;
  const DesignTrial trial({weak, strong}, {});
  const TriedDesign tried = trial.run(design_);
  const CloserLook look = look_closer(trial, tried, folder("run"));
  EXPECT_EQ(look.summary["worst"]["condition"], "strong");
  const int screen = look.summary["worst"]["screen"];
  ASSERT_LT(screen, 3);
  EXPECT_EQ(look.summary["worst"]["residual_wfe_nm"],
            residual_nm(tried.performances[1].screens[screen]));
  EXPECT_THAT(contents("run/worst-images.fits"), HasSubstr("PHOTONS =               10000."))
      << "in the light of its condition";
}

TEST_F(CloserLookTest, ReplacesWhatAnInterruptedRunLeft) {
  const DesignTrial trial({tiny_condition(telescope_, 4.0, 2)}, {});
  const TriedDesign tried = trial.run(design_);
  const OutputFolder run = folder("run");
  look_closer(trial, tried, run);
  const std::string before = contents("run/worst-images.fits");
  std::ofstream("run/worst-images.fits") << "half";
  look_closer(trial, tried, run);
  EXPECT_EQ(contents("run/worst-images.fits"), before);
}

TEST_F(CloserLookTest, ThePicturesTellWhatTheyShow) {
  const DesignTrial trial({tiny_condition(telescope_, 4.0, 3)}, {});
  const CloserLook look = look_closer(trial, trial.run(design_), folder("run"));
  EXPECT_THAT(contents("run/worst-images.svg"),
              AllOf(HasSubstr("Worst screen: 0.5 m telescope"), HasSubstr("plane 4"),
                    HasSubstr("x, m"), HasSubstr("intensity")));
  const double residual = look.summary["typical"]["residual_wfe_nm"];
  EXPECT_THAT(contents("run/typical-phases.svg"),
              AllOf(HasSubstr("Typical screen"), HasSubstr("phase, rad"), HasSubstr("path, nm"),
                    HasSubstr(fmt::format("residual, RMS {:.3g} nm", residual))));
  EXPECT_THAT(contents("run/loops.svg"),
              AllOf(HasSubstr("residual WFE, nm"),
                    HasSubstr(fmt::format("typical screen: {:.3g} nm", residual))));
}

}  // namespace
}  // namespace nlcwfs
