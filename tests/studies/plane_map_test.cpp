#include "studies/plane_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Loops that are fewest at the near distance 60 km, and from the far distance 150 km on.
Json grid() {
  const std::vector<double> near{30e3, 60e3, 90e3};
  const std::vector<double> far{50e3, 100e3, 150e3, 200e3, 250e3};
  Json loops = Json::array();
  Json errors = Json::array();
  for (const double z_near : near) {
    loops.push_back(Json::array());
    errors.push_back(Json::array());
    for (const double z_far : far) {
      const bool is_left_out = z_near > z_far;
      loops.back().push_back(
          is_left_out ? Json(nullptr)
                      : Json(4.0 + std::abs(z_near - 60e3) / 10e3 + (z_far < 150e3 ? 2.0 : 0.0)));
      errors.back().push_back(is_left_out ? Json(nullptr) : Json(0.1));
    }
  }
  return {{"axes",
           {{{"name", "plane_count"}, {"values", {4}}},
            {{"name", "order"}, {"values", {"1234"}}},
            {{"name", "z_near"}, {"values", near}},
            {{"name", "z_far"}, {"values", far}}}},
          {"loops", Json::array({Json::array({loops})})},
          {"standard_error", {{"loops", Json::array({Json::array({errors})})}}}};
}

TEST(PlaneMap, HasTheGridsValues) {
  const Json json = grid();
  const PlaneMap map(json);
  EXPECT_EQ(map.near(), (std::vector{30e3, 60e3, 90e3}));
  EXPECT_EQ(map.far().size(), 5u);
  EXPECT_EQ(map.value("loops", 1, 3), 4.0);
  EXPECT_EQ(map.value("loops", 0, 1), 9.0);
  EXPECT_EQ(map.mean("loops", 1, 3).standard_error, 0.1);
  EXPECT_TRUE(std::isnan(map.value("loops", 2, 0)));
  EXPECT_EQ(map.nearest_far(180e3), 3u);
  EXPECT_EQ(map.lowest("loops"), 4.0);
}

TEST(PlaneMap, AveragesOverWhatIsWanted) {
  const Json json = grid();
  const PlaneMap map(json);
  EXPECT_DOUBLE_EQ(map.mean_over("loops", [](double near, double) { return near == 60e3; }), 4.5);
  EXPECT_TRUE(std::isnan(map.mean_over("loops", [](double, double) { return false; })));
  EXPECT_EQ(map.greatest_over("loops", [](double near, double) { return near == 60e3; }), 6.0);
}

TEST(PlaneMap, FindsTheValleyAndHowFarTheFarPairMustBe) {
  const Json json = grid();
  const PlaneMap map(json);
  EXPECT_EQ(map.valley(), 1u);
  EXPECT_EQ(map.least_good_far(), 150e3);
}

}  // namespace
}  // namespace nlcwfs
