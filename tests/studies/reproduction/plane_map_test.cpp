// Tests: a sweep's figures over the distances of two pairs.
#include "studies/reproduction/plane_map.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

/// Loops that are fewest at the near distance 60 km, and from the far distance 150 km on.
/// @param residual  nm, at each near distance
Json grid(const std::function<double(double)>& residual = [](double) { return 5.0; }) {
  const std::vector<double> near{30e3, 60e3, 90e3};
  const std::vector<double> far{50e3, 100e3, 150e3, 200e3, 250e3};
  Json loops = Json::array();
  Json errors = Json::array();
  Json residuals = Json::array();
  for (const double z_near : near) {
    loops.push_back(Json::array());
    errors.push_back(Json::array());
    residuals.push_back(Json::array());
    for (const double z_far : far) {
      const bool is_left_out = z_near > z_far;
      loops.back().push_back(
          is_left_out ? Json(nullptr)
                      : Json(4.0 + std::abs(z_near - 60e3) / 10e3 + (z_far < 150e3 ? 2.0 : 0.0)));
      errors.back().push_back(is_left_out ? Json(nullptr) : Json(0.1));
      residuals.back().push_back(is_left_out ? Json(nullptr) : Json(residual(z_near)));
    }
  }
  return {{"axes",
           {{{"name", "plane_count"}, {"values", {4}}},
            {{"name", "order"}, {"values", {"1234"}}},
            {{"name", "z_near"}, {"values", near}},
            {{"name", "z_far"}, {"values", far}}}},
          {"loops", Json::array({Json::array({loops})})},
          {"residual_wfe_nm", Json::array({Json::array({residuals})})},
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
}

TEST(PlaneMap, PicksWhatIsWanted) {
  const Json json = grid();
  const PlaneMap map(json);
  EXPECT_EQ(map.values_of("loops", [](double near, double) { return near == 60e3; }),
            (std::vector{6.0, 4.0, 4.0, 4.0}));
  EXPECT_TRUE(map.values_of("loops", [](double, double) { return false; }).empty());
  EXPECT_EQ(map.median_at_near("loops", 1), 4.0);
  EXPECT_EQ(map.median_at_near("loops", 0), 7.0);
}

TEST(PlaneMap, FindsWhereResidualAndLoopsAreLowTogether) {
  const Json json = grid();
  EXPECT_EQ(PlaneMap(json).valley(), 1u);
  // Few loops with a large residual are no valley.
  const Json by_chance = grid([](double near) { return near == 60e3 ? 90.0 : 5.0; });
  EXPECT_NE(PlaneMap(by_chance).valley(), 1u);
}

TEST(PlaneMap, FindsHowFarTheFarPairMustBe) {
  const Json json = grid();
  const PlaneMap map(json);
  EXPECT_EQ(map.least_good_far(60e3), 150e3);
  EXPECT_FALSE(map.least_good_far(10e3));  // no near pair is there
  // Loops that go on falling: it may lie beyond the map.
  Json falling = grid();
  for (Json& near : falling["loops"][0][0]) {
    for (std::size_t far = 0; far < near.size(); ++far) {
      if (!near[far].is_null()) near[far] = 20.0 - 3.0 * double(far);
    }
  }
  EXPECT_FALSE(PlaneMap(falling).least_good_far(60e3));
}

}  // namespace
}  // namespace nlcwfs
