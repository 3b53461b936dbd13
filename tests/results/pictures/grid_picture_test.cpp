// Tests: A sweep's grid is drawn, with its best and the path of a search.
#include "results/pictures/grid_picture.hpp"

#include "results/fits/fits_cube.hpp"
#include "tests/scratch_folder.hpp"

#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using GridMap = ScratchFolder;

/// As a sweep's summary has it: two distances of each pair at two relaxations.
nlohmann::ordered_json grid() {
  return nlohmann::ordered_json::parse(R"({
    "axes": [{"name": "z_near", "unit": "m", "values": [20000.0, 40000.0]},
             {"name": "relaxation", "unit": "", "values": [0.0]},
             {"name": "z_far", "unit": "m", "values": [80000.0, 160000.0]}],
    "orders": ["3412"],
    "cost": [[[1.0, 2.0]], [[3.0, null]]],
    "residual_wfe_nm": [[[10.0, 20.0]], [[30.0, null]]]})");
}

TEST_F(GridMap, HasTheFirstAxisAlongAxis1) {
  write_grid_map(grid(), "residual_wfe_nm", "nm", "map.fits");
  const FitsCube map = read_fits_cube("map.fits", "test", FitsGaps::allowed);
  EXPECT_EQ(map.unit, "nm");
  ASSERT_EQ(map.slices.size(), 1u);
  // Row = z_far, column = z_near.
  EXPECT_EQ(map.slices[0](0, 0), 10.0);
  EXPECT_EQ(map.slices[0](0, 1), 30.0);
  EXPECT_EQ(map.slices[0](1, 0), 20.0);
  EXPECT_TRUE(std::isnan(map.slices[0](1, 1))) << "there is no design";
  EXPECT_THAT(contents("map.fits"),
              AllOf(HasSubstr("CTYPE1  = 'Z_NEAR  '"), HasSubstr("CTYPE2  = 'Z_FAR   '"),
                    HasSubstr("CDELT2  =               80000."),
                    HasSubstr("distance of the near pair"), HasSubstr("EXTNAME = 'Z_FAR   '")));
}

TEST_F(GridMap, NeedsTwoAxes) {
  nlohmann::ordered_json line = grid();
  line["axes"][0]["values"] = {20000.0};
  line["cost"] = {{{1.0, 2.0}}};
  write_grid_map(line, "cost", "", "map.fits");
  EXPECT_FALSE(std::filesystem::exists("map.fits"));
}

TEST_F(GridMap, OfNoGridIsRefused) {
  const auto expect_refused = [](const std::function<void(nlohmann::ordered_json&)>& change,
                                 const char* why) {
    nlohmann::ordered_json other = grid();
    change(other);
    EXPECT_THAT([&] { write_grid_map(other, "cost", "", "map.fits"); },
                testing::ThrowsMessage<std::runtime_error>(why));
  };
  expect_refused([](auto& g) { g["axes"][1]["values"] = nlohmann::ordered_json::array(); },
                 "the grid has 4 costs at 0 points");
  expect_refused(
      [](auto& g) {
        g["axes"][1]["values"] = {0.0, 0.1};
      },
      "the grid has 4 costs at 8 points");
  expect_refused(
      [](auto& g) {
        g["axes"][0]["values"] = {"near", 1e4};
      },
      "the axis z_near has words and numbers");
  EXPECT_FALSE(std::filesystem::exists("map.fits"));
}

}  // namespace
}  // namespace nlcwfs
