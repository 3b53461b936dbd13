// Whether the rules tell what they should from runs that are made up.

#include "studies/reproduction/figures.hpp"
#include "studies/reproduction/paper_bands.hpp"
#include "tests/scratch_folder.hpp"

#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

double talbot(int ratio) { return 58.74e3 * 16.0 / (ratio * ratio); }

class ClaimRules : public ScratchFolder {
 protected:
  static void write(const std::string& run, const std::string& file, const std::string& text) {
    std::filesystem::create_directories(run);
    std::ofstream(run + "/" + file) << text;
  }

  static std::string of_paper(const std::string& figure, const std::string& run) {
    return figure + "/paper" + (run.empty() ? "" : "-" + run);
  }

  /// For both set-ups, as a run that reproduces something has to have both.
  static void write_both(const std::string& figure, const std::string& run, const std::string& file,
                         const std::string& text) {
    write(of_paper(figure, run), file, text);
    write(figure + "/extended" + (run.empty() ? "" : "-" + run), file, text);
  }

  using Figure = std::function<double(double near, double far)>;

  /// A map of 5 to 250 km.
  static void write_map(const std::string& figure, const std::string& run, const Figure& residual,
                        const Figure& loops) {
    std::vector<double> distances;
    for (int i = 1; i <= 50; ++i) distances.push_back(5e3 * i);
    const auto matrix = [&](const Figure& value) {
      Json rows = Json::array();
      for (const double near : distances) {
        Json row = Json::array();
        for (const double far : distances) {
          row.push_back(near > far ? Json(nullptr) : Json(value(near, far)));
        }
        rows.push_back(std::move(row));
      }
      return rows;
    };
    const Json zero = matrix([](double, double) { return 0.0; });
    const Json grid{
        {"axes",
         {{{"name", "z_near"}, {"values", distances}}, {{"name", "z_far"}, {"values", distances}}}},
        {"residual_wfe_nm", matrix(residual)},
        {"loops", matrix(loops)},
        {"fft_count", matrix([&](double near, double far) { return 10.0 * loops(near, far); })},
        {"standard_error", {{"residual_wfe_nm", zero}, {"loops", zero}}}};
    write_both(figure, run, "summary.json", Json{{"grid", grid}}.dump());
  }

  static void write_design(const std::string& name, const std::vector<double>& residuals,
                           const std::vector<double>& loops, double seconds_per_loop = 1e-3) {
    std::string table = "residual_wfe_nm,loops,fft_count\n";
    for (std::size_t i = 0; i < loops.size(); ++i) {
      table += fmt::format("{},{},{}\n", residuals[i], loops[i], 10.0 * loops[i]);
    }
    write_both("designs", name, "screens.csv", table);
    const auto mean = [](const std::vector<double>& values, double scale) {
      const MeanAndError found = mean_and_standard_error(values);
      return Json{{"mean", scale * found.mean}, {"standard_error", scale * found.standard_error}};
    };
    const Json performance{{"residual_wfe_nm", mean(residuals, 1.0)},
                           {"loops", mean(loops, 1.0)},
                           {"fft_count", mean(loops, 10.0)},
                           {"seconds", mean(loops, seconds_per_loop)}};
    write_both("designs", name, "summary.json",
               Json{{"design", {{"performance", performance}}}}.dump());
  }

  /// Maps whose valley is at so many Talbot distances, and which need a far distance of 150 km.
  static void write_valleys(double valley) {
    for (const int ratio : {4, 6, 8}) {
      const double best = valley * talbot(ratio);
      const auto depth = [best](double near, double far) {
        return std::abs(std::log(near / best)) + (far < 150e3 ? 1.0 : 0.0);
      };
      write_map(
          "figure-3", fmt::format("{}", ratio),
          [=](double near, double far) { return 7.0 * (1.0 + 0.1 * depth(near, far)); },
          [=](double near, double far) { return 4.0 * (1.0 + 0.3 * depth(near, far)); });
    }
    write_design("four-planes", {6.0, 7.0, 6.5, 7.5}, {4.0, 5.0, 4.0, 5.0});
    write_design("pairs-exchanged", {6.1, 7.0, 6.4, 7.5}, {4.0, 5.0, 4.0, 5.0});
  }

  static ClaimVerdict verdict(const std::string& figure, const std::string& start) {
    for (const Claim& claim : checked_claims(ReproducedRuns("."), {figure})) {
      if (claim.sentence.starts_with(start)) return claim.findings.at(StudySetup::paper).verdict;
    }
    ADD_FAILURE() << "no claim " << start;
    return ClaimVerdict::open;
  }
};

TEST_F(ClaimRules, FindWhereTheValleyLies) {
  write_valleys(1.0);
  EXPECT_EQ(verdict("3", "The valley lies"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "The valley moves towards"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "The valley shows"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "Recommended designs"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "Z_near at the Talbot"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "Planes very close"), ClaimVerdict::not_reproduced);
  EXPECT_EQ(verdict("3", "The least optimal Z_far."), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("3", "The least optimal Z_far is no"), ClaimVerdict::reproduced);
  // It is at 150 km for each D/r0.
  EXPECT_EQ(verdict("3", "The valley moves in partly"), ClaimVerdict::not_reproduced);
  write_valleys(2.0);
  EXPECT_EQ(verdict("3", "The valley lies"), ClaimVerdict::in_trend);
  write_valleys(3.5);
  EXPECT_EQ(verdict("3", "The valley lies"), ClaimVerdict::not_reproduced);
}

TEST_F(ClaimRules, TellWhetherPairsMayBeExchanged) {
  write_valleys(1.0);
  EXPECT_EQ(verdict("3", "Near and far pair may"), ClaimVerdict::reproduced);
  write_design("pairs-exchanged", {5.2, 6.0, 5.4, 6.4}, {3.5, 4.4, 3.5, 4.4});
  EXPECT_EQ(verdict("3", "Near and far pair may"), ClaimVerdict::in_trend);
  // Alike on the mean, but no two wavefronts are.
  write_design("pairs-exchanged", {1.0, 12.0, 1.5, 12.5}, {4.0, 5.0, 4.0, 5.0});
  EXPECT_EQ(verdict("3", "Near and far pair may"), ClaimVerdict::open);
  write_design("pairs-exchanged", {3.0, 3.5, 3.2, 3.7}, {2.0, 2.5, 2.0, 2.5});
  EXPECT_EQ(verdict("3", "Near and far pair may"), ClaimVerdict::not_reproduced);
}

TEST_F(ClaimRules, CompareThreePlanesWavefrontByWavefront) {
  const auto even = [](double value) { return [value](double, double) { return value; }; };
  write_map("figure-3", "4", even(6.0), even(4.0));
  for (const char* name : {"without-p3", "without-p1"}) {
    write_map("figure-4", name, even(8.0), even(6.0));
    // One loop more on each wavefront, less than they differ by among themselves.
    write_design(name, {6.0, 7.0, 8.0, 9.0}, {4.0, 7.0, 10.0, 13.0}, 0.88e-3);
  }
  write_design("four-planes", {6.0, 7.0, 8.0, 9.0}, {3.0, 6.0, 9.0, 12.0});
  EXPECT_EQ(verdict("4", "Three planes are about"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("4", "Three planes take more"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("4", "A three-plane loop"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("4", "Three planes take longer"), ClaimVerdict::reproduced);
  write_design("without-p1", {6.0, 7.0, 8.0, 9.0}, {2.0, 5.0, 8.0, 11.0}, 1.2e-3);
  EXPECT_EQ(verdict("4", "Three planes take more"), ClaimVerdict::in_trend);
  EXPECT_EQ(verdict("4", "A three-plane loop"), ClaimVerdict::not_reproduced);
  write_map("figure-4", "without-p1", even(12.0), even(6.0));
  EXPECT_EQ(verdict("4", "Three planes are about"), ClaimVerdict::in_trend);
}

TEST_F(ClaimRules, FindTheThresholdOfSampling) {
  const auto write_sampling = [](double threshold) {
    for (const int ratio : {4, 6, 8, 10}) {
      Json strehl = Json::array();
      Json seconds = Json::array();
      const std::vector<double> pixels{128, 64, 32, 16, 8};
      for (const double here : pixels) {
        strehl.push_back(here / ratio >= threshold ? 0.95 : 0.65);
        seconds.push_back(1e-6 * here * here);
      }
      const Json grid{{"axes", {{{"name", "pupil_pixels"}, {"values", pixels}}}},
                      {"field_strehl", strehl},
                      {"seconds", seconds},
                      {"standard_error", {{"field_strehl", {0.01, 0.01, 0.01, 0.01, 0.01}}}}};
      write_both("figure-6", fmt::format("{}", ratio), "summary.json", Json{{"grid", grid}}.dump());
    }
  };
  write_sampling(3.9);
  EXPECT_EQ(verdict("6", "Fewer than"), ClaimVerdict::in_trend);
  EXPECT_EQ(verdict("6", "More pixels"), ClaimVerdict::reproduced);
  write_sampling(1.0);
  EXPECT_EQ(verdict("6", "Fewer than"), ClaimVerdict::not_reproduced);
  EXPECT_EQ(verdict("6", "4 to 5"), ClaimVerdict::reproduced);
  write_sampling(20.0);
  EXPECT_EQ(verdict("6", "4 to 5"), ClaimVerdict::in_trend);
}

TEST_F(ClaimRules, CompareBandsWavefrontByWavefront) {
  const auto write_bands = [](double step, double scatter) {
    double floor = 1.0;
    for (const PaperBand& band : paper_bands) {
      Json screens = Json::array();
      for (int loop = 0; loop < 20; ++loop) {
        const double excess = 100.0 * std::exp(-double(loop));
        screens.push_back({floor + excess, 3.0 * floor + 2.0 * excess + scatter});
      }
      Json means = Json::array();
      for (const Json& loop : screens) means.push_back(0.5 * (double(loop[0]) + double(loop[1])));
      write_both("figure-8", std::string(band.name), "summary.json",
                 Json{{"aberrations_nm", {200.0, 400.0}},
                      {"residual_after_loops_nm", {{"mean", means}, {"screens", screens}}}}
                     .dump());
      write_both("figure-8", std::string(band.name), "screens.csv",
                 fmt::format("loops\n{}\n{}\n", floor, floor + 1.0));
      floor += step;
      scatter = -scatter;
    }
  };
  write_bands(10.0, 0.0);
  EXPECT_EQ(verdict("8", "The floor of"), ClaimVerdict::in_trend);  // 31 and 93 nm
  EXPECT_EQ(verdict("8", "Wider bands"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("7", "In the medium"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("7", "Every aberration"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict("7", "The residual starts"), ClaimVerdict::reproduced);
  write_bands(-0.1, 0.0);
  EXPECT_EQ(verdict("8", "The floor rises"), ClaimVerdict::not_reproduced);
  EXPECT_EQ(verdict("8", "The floor of"), ClaimVerdict::reproduced);
}

}  // namespace
}  // namespace nlcwfs
