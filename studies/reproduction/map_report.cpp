// Plane maps in the report, as the paper draws them.
#include "studies/reproduction/map_report.hpp"

#include "studies/reproduction/claim_rules.hpp"

#include <cmath>

namespace nlcwfs {

std::string draw_map(MarkdownReport& report, const PlaneMap& map, const DrawnMetric& drawn,
                     int ratio, const std::string& title, const std::string& name) {
  MapPicture picture{.title = title,
                     .x = {.label = "Z_far, km", .values = {}},
                     .y = {.label = "Z_near, km", .values = {}},
                     .value_label = drawn.label,
                     .values = {}};
  Image<double> values(map.near().size(), map.far().size());
  for (const double near : map.near()) picture.y.values.push_back(near / km);
  for (std::size_t far = 0; far < map.far().size(); ++far) {
    picture.x.values.push_back(map.far()[far] / km);
    std::vector<double>& column = picture.values.emplace_back();
    for (std::size_t near = 0; near < map.near().size(); ++near) {
      column.push_back(drawn.scale * map.value(drawn.metric, near, far));
      values(Eigen::Index(near), Eigen::Index(far)) = column.back();
    }
  }
  const double talbot = talbot_distance_of_seeing(ratio) / km;
  const double last = picture.x.values.back();
  picture.overlay.curves = {{"Z_near = Z_T(r0)", {{0.0, talbot}, {last, talbot}}},
                            {"Z_far = Z_T(r0)", {{talbot, 0.0}, {talbot, last}}}};
  const std::string description = "distance of a pair";
  report.write(name, {.unit = drawn.unit,
                      .x = {"Z_FAR", "m", map.far(), {}, description},
                      .y = {"Z_NEAR", "m", map.near(), {}, description},
                      .values = std::move(values)});
  return report.draw(name, picture);
}

Cells draw_maps(MarkdownReport& report, const PlaneMap& map, int ratio, const std::string& title,
                const std::string& name) {
  CsvTable table({"z_near_m", "z_far_m", "residual_wfe_nm", "residual_wfe_standard_error_nm",
                  "loops", "loops_standard_error"});
  for (std::size_t near = 0; near < map.near().size(); ++near) {
    for (std::size_t far = 0; far < map.far().size(); ++far) {
      const MeanAndError residual = map.mean("residual_wfe_nm", near, far);
      const MeanAndError loops = map.mean("loops", near, far);
      if (!std::isfinite(residual.mean)) continue;
      table.row().add(map.near()[near]).add(map.far()[far]);
      table.add(residual.mean).add(residual.standard_error);
      table.add(loops.mean).add(loops.standard_error);
    }
  }
  report.write(name, table);
  return {draw_map(report, map, {"residual_wfe_nm", "residual WFE, nm", "nm"}, ratio, title,
                   name + "-residual_wfe"),
          draw_map(report, map, {"loops", "loops", ""}, ratio, title, name + "-loops")};
}

}  // namespace nlcwfs
