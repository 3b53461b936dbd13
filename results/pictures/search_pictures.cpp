// The path of a search and its sensitivity are drawn.
#include "results/pictures/search_pictures.hpp"

#include "results/pictures/curve_picture.hpp"
#include "results/tables/csv_table.hpp"
#include "results/text/axis_text.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace nlcwfs {
namespace {

CurvePicture picture_of(const OptimumRange& range) {
  Curve curve;
  for (const ScannedValue& scanned : range.values) {
    curve.x.push_back(scanned.value);
    curve.y.push_back(scanned.cost_difference.mean);
    curve.spread.push_back(scanned.cost_difference.standard_error);
  }
  const AxisUnit unit = axis_unit_of(unit_of_variable(range.name), curve.x);
  for (double& x : curve.x) x /= unit.size;
  return {.title = "",
          .x_label = label_of(range.name) + unit.suffix(),
          .y_label = "cost above the best design's",
          .curves = {std::move(curve),
                     {.x = {range.best / unit.size}, .y = {0.0}, .colour = 1, .is_points = true}},
          .band = std::pair(range.least / unit.size, range.greatest / unit.size)};
}

}  // namespace

PlannedPicture search_picture(const std::string& title, const std::vector<SearchStep>& steps) {
  CurvePicture picture{.title = title,
                       .x_label = "designs tried",
                       .y_label = "cost",
                       .curves = {},
                       .has_log_y = true};
  Curve given_up{.label = "given up after its first screens", .is_pale = true, .is_points = true};
  Curve tried{.label = "a design", .is_points = true};
  Curve best{.label = "the lowest so far", .colour = 1};
  for (const SearchStep& step : steps) {
    Curve& points = step.given_up ? given_up : tried;
    points.x.push_back(step.evaluation);
    points.y.push_back(step.cost);
    best.x.push_back(step.evaluation);
    best.y.push_back(step.best_cost);
    // Costs may be of any sign.
    picture.has_log_y = picture.has_log_y && !(step.cost <= 0.0);
  }
  picture.curves = {std::move(given_up), std::move(tried), std::move(best)};
  return {"search", [picture](const auto& stem) { return write_picture(picture, stem); }};
}

PlannedPicture sensitivity_picture(const std::string& title,
                                   const std::vector<OptimumRange>& ranges) {
  std::vector<CurvePicture> pictures;
  for (const OptimumRange& range : ranges) pictures.push_back(picture_of(range));
  return {"sensitivity", [title, pictures](const auto& stem) {
            return write_picture(title + ": one variable moved alone; shaded: as good as the best",
                                 pictures, stem);
          }};
}

std::string sensitivity_table(const std::vector<OptimumRange>& ranges) {
  CsvTable table({"variable", "unit", "value", "cost_difference", "cost_difference_standard_error",
                  "is_worse"});
  for (const OptimumRange& range : ranges) {
    for (const ScannedValue& scanned : range.values) {
      table.row().add(range.name).add(unit_of_variable(range.name)).add(scanned.value);
      for (const double number :
           {scanned.cost_difference.mean, scanned.cost_difference.standard_error}) {
        table.add(std::isnan(number) ? "" : fmt::format("{}", number));
      }
      table.add(scanned.is_worse ? 1.0 : 0.0);
    }
  }
  return table.text();
}

}  // namespace nlcwfs
