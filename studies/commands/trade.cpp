// trade: The designs that no other betters in all of the configured objectives, verified on fresh
// screens.
#include "results/pictures/scatter_picture.hpp"
#include "results/tables/trial_summary.hpp"
#include "results/text/axis_text.hpp"
#include "results/text/quantity_text.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/closer_look.hpp"
#include "studies/search/search_log.hpp"
#include "studies/search/trade_search.hpp"

#include <iterator>
#include <map>

#include <boost/algorithm/string/replace.hpp>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// A design's planes and its pixels across the pupil.
std::pair<std::size_t, int> cell_of(const TradedDesign& traded) {
  const SensorDesign& design = traded.verified.design;
  return {design.planes.size(), design.detector.pupil_pixels};
}

Json front_array(const TradeSearch& task, const TradeResult& result) {
  Json front = Json::array();
  for (const TradedDesign& traded : result.front) {
    Json json = to_json(traded.verified, task.verification);
    for (std::size_t i = 0; i < task.objectives.size(); ++i) {
      json["objectives"][std::string(task.objectives[i].name)] = to_json(traded.objectives[i]);
    }
    json["dominated"] = traded.dominated;
    json["tied_with"] = traded.tied_with ? Json(*traded.tied_with) : Json(nullptr);
    front.push_back(json);
  }
  return front;
}

Json bests_object(const TradeSearch& task, const TradeResult& result) {
  Json all = Json::object();
  for (std::size_t i = 0; i < result.bests.size(); ++i) {
    Json& list = all[std::string(task.objectives[i + 1].name)] = Json::array();
    for (const BoundedBest& best : result.bests[i]) {
      list.push_back({{"bound", best.bound}, {"design", best.design}});
    }
  }
  return all;
}

/// The best in the first objective of each number of planes and pixels.
Json winners_array(const TradeResult& result) {
  std::map<std::pair<std::size_t, int>, std::size_t> best;
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    // They are in order.
    if (result.front[i].stands()) best.emplace(cell_of(result.front[i]), i);
  }
  Json winners = Json::array();
  for (const auto& [cell, design] : best) {
    winners.push_back(
        {{"plane_count", cell.first}, {"pupil_pixels", cell.second}, {"design", design}});
  }
  return winners;
}

Json reference_object(const TradeSearch& task, const TradeResult& result) {
  Json reference = Json::object();
  for (std::size_t i = 0; i < task.objectives.size(); ++i) {
    reference[std::string(task.objectives[i].name)] = result.reference_point[i];
  }
  return reference;
}

/// All but what a clock measured.
std::string front_table(const TradeSearch& task, const TradeResult& result) {
  std::vector<std::string> columns{"design", "dominated", "violation", "planes_m"};
  std::vector<DesignMetric> metrics = task.objectives;
  for (const PerformanceMetric& metric : performance_metrics()) {
    const DesignMetric& known = *find_design_metric(metric.name);
    const bool is_there = std::ranges::count(metrics, known.name, &DesignMetric::name) > 0;
    if (!is_there && known.name != "seconds") metrics.push_back(known);
  }
  for (const DesignField& property : design_properties()) {
    columns.push_back(column_of_variable(property.variable));
  }
  for (const DesignMetric& metric : metrics) {
    columns.emplace_back(metric.name);
    columns.push_back(fmt::format("{}_standard_error", metric.name));
  }
  CsvTable table(columns);
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    const TradedDesign& traded = result.front[i];
    const SensorDesign& design = traded.verified.design;
    table.row()
        .add(double(i))
        .add(traded.dominated ? 1.0 : 0.0)
        .add(traded.evaluated.violation)
        .add(fmt::format("{:.7g}", fmt::join(design.planes, ",")));
    for (const DesignField& property : design_properties()) table.add(property.get(design));
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      const MeanAndError value = k < traded.objectives.size()
                                     ? traded.objectives[k]
                                     : task.verification.mean_of(traded.verified, metrics[k]);
      table.add(value);
    }
  }
  return table.text();
}

MeanAndError mean_of(const TradeSearch& task, const TradedDesign& traded, std::string_view metric) {
  return task.verification.mean_of(traded.verified, *find_design_metric(metric));
}

/// Total WFE against model time, whatever the objectives are.
ScatterPicture front_picture(const TradeSearch& task, const TradeResult& result) {
  ScatterPicture picture{
      .title = fmt::format(
          "Front of {:.4g} m at {}, D/r0 = {:.4g}, on fresh screens; pale: bettered there",
          task.telescope.diameter, format_length(task.telescope.wavelength),
          task.telescope.diameter / task.seeing().fried_parameter),
      .x_label = "model time of a reconstruction, ms",
      .y_label = "total wavefront error, nm",
      .marked = result.knee,
      .mark_label = "knee"};
  std::set<std::size_t> planes;
  std::set<int> pixels;
  for (const TradedDesign& traded : result.front) {
    planes.insert(cell_of(traded).first);
    pixels.insert(cell_of(traded).second);
  }
  for (const std::size_t count : planes) picture.colours.push_back(fmt::format("{} planes", count));
  for (const int count : pixels) picture.symbols.push_back(fmt::format("{} pixels", count));
  for (const TradedDesign& traded : result.front) {
    const auto [plane_count, pupil_pixels] = cell_of(traded);
    picture.points.push_back(
        {.x = 1e3 * mean_of(task, traded, "model_seconds").mean,
         .y = mean_of(task, traded, "total_wfe_nm"),
         .colour = static_cast<int>(std::distance(planes.begin(), planes.find(plane_count))),
         .symbol = static_cast<int>(std::distance(pixels.begin(), pixels.find(pupil_pixels))),
         .is_pale = !traded.stands()});
  }
  return picture;
}

/// A figure of an objective as people read it.
std::string figure_text(const DesignMetric& metric, const MeanAndError& value) {
  if (metric.unit == "s") {
    return value.mean < 1.0 ? fmt::format("{:.3g} ms", 1e3 * value.mean)
                            : fmt::format("{:.3g} s", value.mean);
  }
  if (value.standard_error == 0.0) return fmt::format("{:.6g}", value.mean);
  return with_error(value) + (metric.unit.empty() ? "" : fmt::format(" {}", metric.unit));
}

std::string search_text(const TradeSearch& task, const TradeResult& result,
                        const Configuration& configuration) {
  const std::size_t found = result.search.front.size();
  const std::string planes = boost::algorithm::replace_first_copy(
      configuration.value_text("search.plane_count"), ":", " to ");
  std::string text =
      tried_text(fmt::format("{} designs of {} planes", result.search.evaluations, planes),
                 task.trial, task.search_precision, result.search_seconds,
                 result.search.termination, "trade.budget", "until it brought forth no new ones");
  if (result.search.failures > 0) {
    text += fmt::format("; {} of them failed, see search.csv", result.search.failures);
  }
  text +=
      fmt::format(".\n{} of them are better than each other in one objective or another. ", found);
  if (result.front.size() == found) {
    text += "All of these";
  } else if (result.verification_interrupted) {
    text += fmt::format("{} of these, up to the interruption,", result.front.size());
  } else {
    text += fmt::format("{} of these, from each number of planes and pixels in turn,",
                        result.front.size());
  }
  text += fmt::format(
      " were tried on {} fresh screens, true field {} samples across the pupil; {} stand there.\n",
      result.front.empty() ? 0 : result.front.front().verified.costs.size(),
      task.verification.conditions().front().simulation->truth_samples(),
      std::ranges::count_if(result.front, &TradedDesign::stands));
  return text;
}

/// "total_wfe_nm 5.61 +- 0.01 nm, model_seconds 3.2 ms"
/// @param figures  of each objective
std::string objectives_text(const TradeSearch& task, const std::vector<MeanAndError>& figures) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < task.objectives.size(); ++i) {
    const DesignMetric& objective = task.objectives[i];
    texts.push_back(fmt::format("{} {}", objective.name, figure_text(objective, figures[i])));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The objectives that no other column of the front's table tells.
std::vector<std::size_t> further_objectives(const TradeSearch& task) {
  std::vector<std::size_t> further;
  const bool is_mean = task.trial.cost().aggregate.kind == AggregateKind::mean;
  for (std::size_t i = 0; i < task.objectives.size(); ++i) {
    const std::string_view name = task.objectives[i].name;
    const bool is_told = (is_mean && (name == "total_wfe_nm" || name == "model_seconds")) ||
                         name == "plane_count" ||
                         (name == "detector_pixels" && !task.space.varies("detector_window"));
    if (!is_told) further.push_back(i);
  }
  return further;
}

std::string front_text(const TradeSearch& task, const TradeResult& result) {
  const std::vector<std::size_t> further = further_objectives(task);
  std::string text = fmt::format("  {:>6} {:>7} {:>7} {:>18} {:>7} {:>11}", "design", "planes",
                                 "pixels", "total WFE, nm", "loops", "model time");
  for (const std::size_t i : further) text += fmt::format(" {:>22}", task.objectives[i].name);
  text += "   distances in visiting order, km\n";
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    const TradedDesign& traded = result.front[i];
    const SensorDesign& design = traded.verified.design;
    std::vector<double> distances = design.planes;
    for (double& z : distances) z *= 1e-3;
    text += fmt::format(
        "{:1} {:>6} {:>7} {:>7} {:>18} {:>7.1f} {:>11}", result.knee == i ? "*" : "", i,
        design.planes.size(), design.detector.pupil_pixels,
        with_error(mean_of(task, traded, "total_wfe_nm")),
        mean_of(task, traded, "fractional_loops").mean,
        figure_text(*find_design_metric("model_seconds"), mean_of(task, traded, "model_seconds")));
    for (const std::size_t k : further) {
      text += fmt::format(" {:>22}", figure_text(task.objectives[k], traded.objectives[k]));
    }
    text += fmt::format("   {:.3g}{}\n", fmt::join(distances, ", "),
                        traded.evaluated.violation > 0.0 ? "  breaks a limit there"
                        : traded.dominated               ? "  bettered there"
                        : traded.tied_with ? fmt::format("  a tie with {}", *traded.tied_with)
                                           : "");
  }
  return text;
}

std::string bests_text(const TradeSearch& task, const TradeResult& result) {
  constexpr std::size_t most_rows = 8;
  std::string text;
  for (std::size_t i = 0; i < result.bests.size(); ++i) {
    const std::vector<BoundedBest>& bests = result.bests[i];
    const DesignMetric& bound = task.objectives[i + 1];
    text += fmt::format("\nBest {} with {} of at {}\n", task.objectives.front().name, bound.name,
                        bound.higher_is_better ? "least" : "most");
    for (const std::size_t row : evenly_chosen(std::vector<std::string>(bests.size()), most_rows)) {
      const TradedDesign& traded = result.front[bests[row].design];
      const auto [planes, pixels] = cell_of(traded);
      text += fmt::format("  {:>22}: {:>22} by {} planes of {} pixels, design {}\n",
                          figure_text(bound, traded.objectives[i + 1]),
                          figure_text(task.objectives.front(), traded.objectives.front()), planes,
                          pixels, bests[row].design);
    }
  }
  return text;
}

std::string knee_text(const TradeSearch& task, const TradeResult& result) {
  if (!result.knee) {
    return "warning: no design was found that keeps objective.limits; there is no front.\n";
  }
  const TradedDesign& traded = result.front[*result.knee];
  const Performance performance = pooled(traded.verified.performances);
  return fmt::format(
      "Knee (*), the best where all objectives weigh the same over their ranges on the front:\n{}"
      "  {}\n{}{}",
      planes_table(traded.verified.design, task.telescope, task.seeing(), &performance),
      objectives_text(task, traded.objectives), choices_text(task.space, traded.verified.design),
      design_warnings(traded.verified, task.verification));
}

std::string hypervolume_text(const TradeSearch& task, const TradeResult& result) {
  std::vector<MeanAndError> point;
  for (const double figure : result.reference_point) point.push_back({figure, 0.0});
  return fmt::format(
      "The front dominates {:.1f} % of the room between the best conceivable values and the "
      "reference point\n({}{}).\n",
      100.0 * result.hypervolume_fraction, objectives_text(task, point),
      result.reference_is_of_the_run
          ? "; in part the worst of this run's first designs, so not to be compared with other runs"
          : "");
}

void print_result(const TradeSearch& task, const TradeResult& result,
                  const Configuration& configuration, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n{}\n", telescope_line(task.telescope, task.seeing()),
             search_text(task, result, configuration));
  if (!result.front.empty()) {
    fmt::print("Front, on the fresh screens:\n{}{}\n", front_text(task, result),
               bests_text(task, result));
  }
  fmt::print("{}\n{}", knee_text(task, result), hypervolume_text(task, result));
}

void run_trade(const Request& request) {
  const Configuration& configuration = request.configuration;
  const Stopwatch stopwatch;
  TradeSearch task(configuration);
  RunRecord record(request);
  for (DesignTrial* trial : {&task.trial, &task.verification}) record.adopt(*trial);
  const TradeResult result = task.run(record);
  if (result.verification_interrupted) {
    record.note_interrupted(
        fmt::format("{} of {} designs were verified", result.front.size(), result.chosen_count));
  } else if (result.search.termination == Termination::stop_requested) {
    record.note_interrupted(fmt::format("{} of {} designs were tried", result.search.evaluations,
                                        task.options.evaluation.budget));
  }

  record.folder().write("front.csv", front_table(task, result));
  record.folder().write("search.csv", result.table);
  if (result.knee) {
    record.write_design("knee.cfg", result.front[*result.knee].verified.design, task.space,
                        "by the trade");
  }
  const auto no_picture = write_picture(front_picture(task, result), record.folder().file("front"));
  std::vector<std::string> notes = task.notes;
  if (no_picture) notes.push_back(fmt::format("there is no front.svg: {}", *no_picture));
  Json look(nullptr);
  if (result.knee) {
    CloserLook knee =
        look_closer(task.verification, result.front[*result.knee].verified, record.folder());
    look = std::move(knee.summary);
    std::ranges::move(knee.notes, std::back_inserter(notes));
  }
  Json names = Json::array();
  for (const DesignMetric& objective : task.objectives) names.push_back(objective.name);
  record.write_summary({{"objectives", names},
                        {"front", front_array(task, result)},
                        {"knee", result.knee ? Json(*result.knee) : Json(nullptr)},
                        {"closer_look", look},
                        {"hypervolume", result.hypervolume},
                        {"hypervolume_fraction", result.hypervolume_fraction},
                        {"reference_point", reference_object(task, result)},
                        {"reference_is_of_the_run", result.reference_is_of_the_run},
                        {"best_within", bests_object(task, result)},
                        {"best_of_planes_and_pixels", winners_array(result)},
                        {"front_of_search", result.search.front.size()},
                        {"evaluations", result.search.evaluations},
                        {"cache_hits", result.search.cache_hits},
                        {"failures", result.search.failures},
                        {"reconstructions", result.reconstructions},
                        {"wall_seconds", stopwatch.seconds()},
                        {"search_seconds", result.search_seconds},
                        {"termination", to_string(result.search.termination)},
                        {"verification_interrupted", result.verification_interrupted}});

  print_result(task, result, configuration, notes);
  record.close();
}

std::string of_trade(const Json& summary) {
  const Json& front = summary.at("front");
  const auto standing = std::ranges::count_if(front, [](const Json& design) {
    return !design.at("dominated").get<bool>() && number_from_json(design.at("violation")) == 0.0;
  });
  std::string text = fmt::format(
      "Of {} designs that were tried, {} are verified on fresh screens, and {} of them stay on the "
      "front there. ",
      integer_from_json(summary.at("evaluations")), front.size(), standing);
  if (summary.at("knee").is_null()) return text + "None keeps objective.limits: there is no front.";
  const auto knee = static_cast<std::size_t>(integer_from_json(summary.at("knee")));
  return text + fmt::format("The knee of the front is design {}: {}.", knee,
                            reached_text(front.at(knee), "fresh screens"));
}

}  // namespace

Command trade_command() {
  return {
      .name = "trade",
      .group = "The best design",
      .description = "try several objectives at once: the front of the best compromises, verified",
      .about =
          "Searches designs that no other betters in all of trade.objectives, over numbers of "
          "planes and pixels, and verifies the front on fresh screens. front.csv has the "
          "front, knee.cfg its knee.",
      .keys = keys::joined({keys::site,
                            keys::simulation,
                            keys::judgement,
                            keys::space(),
                            keys::fresh_screens,
                            {"trade"}}),
      .examples = {"nlcwfs trade --trade.objectives total_wfe_nm,model_seconds,plane_count"},
      .run = run_trade,
      .resumption = Resumption::by_trials,
      .set_defaults = set_trade_defaults,
      .files = joined({{{"knee.cfg", FileRole::design}, {"front.csv"}, {"search.csv"}},
                       closer_look_files(),
                       picture_files({"front"})}),
      .verdict = of_trade};
}

}  // namespace nlcwfs
