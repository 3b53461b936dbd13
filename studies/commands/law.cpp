// law: The scaling law of the best designs at several seeings.
#include "model/input_error.hpp"
#include "results/tables/csv_table.hpp"
#include "results/tables/trial_summary.hpp"
#include "studies/commands/key_groups.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/search/design_search.hpp"
#include "studies/settings/law_file.hpp"

#include <cmath>
#include <cstdio>
#include <variant>

#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// That a law is fitted to.
constexpr std::size_t least_seeings = 4;

/// A law has one visiting order: the user's, or far pair first, which searches of all orders end
/// in.
std::array<int, 4> order_of(const Configuration& configuration) {
  const std::vector<VisitingOrder> orders = configuration.orders("search.order");
  if (orders.empty()) return {3, 4, 1, 2};
  if (orders.size() != 1 || orders.front().size() != 4) {
    throw InputError("search.order", configuration.value_text("search.order"),
                     "one order of four planes: a law has one. Not set: 3412");
  }
  std::array<int, 4> order{};
  std::ranges::copy(orders.front(), order.begin());
  return order;
}

/// At least so many, and none twice.
std::vector<double> seeings_of_law(const Configuration& configuration) {
  std::vector<double> ratios = configuration.numbers("law.d_over_r0");
  const std::set<double> distinct(ratios.begin(), ratios.end());
  if (distinct.size() < least_seeings || distinct.size() < ratios.size() ||
      *distinct.rbegin() < ScalingLaw::least_reach * *distinct.begin()) {
    throw InputError("law.d_over_r0", configuration.value_text("law.d_over_r0"),
                     fmt::format("at least {} different values that reach over a factor of {}, to "
                                 "which the lines are fitted",
                                 least_seeings, ScalingLaw::least_reach));
  }
  return ratios;
}

/// A law tells the distances of two pairs, so these are what its searches vary.
void require_two_pairs(const Configuration& configuration) {
  const auto refuse = [&](const std::string& key, const char* allowed) {
    throw InputError(key, configuration.value_text(key), allowed);
  };
  if (configuration.choice("search.layout") != "symmetric") {
    refuse("search.layout", "symmetric: a law tells the distances of two pairs");
  }
  if (configuration.value_text("search.plane_count") != "4") {
    refuse("search.plane_count", "4: a law tells the distances of two pairs");
  }
  for (const char* key : {"search.z_near", "search.z_far"}) {
    const auto domain = configuration.domain(key);
    if (domain && !std::holds_alternative<ValueRange>(*domain)) {
      refuse(key, "a range that the law's searches vary, such as 5km:60km");
    }
  }
}

/// Screens that all end alike (at the last loop) would say that a value is exact.
MeanAndError with_error_floor(const MeanAndError& value) {
  constexpr double least_relative_error = 1e-3;
  return {value.mean, std::max(value.standard_error, least_relative_error * value.mean)};
}

/// A value and how far it may move, as a mean with a standard error: the range that cannot be told
/// from the best by a test at 5 % reaches over about two of them on each side.
MeanAndError with_range(double value, const OptimumRange& range) {
  constexpr double largest_relative_error = 0.9;  // next to nothing is known
  const double relative = std::log(range.greatest / range.least) / 4.0;
  return with_error_floor({value, value * std::min(relative, largest_relative_error)});
}

/// @pre the search was not interrupted
ScalingDatum datum_of(const DesignSearch& task, const DesignSearchResult& result) {
  const Telescope& telescope = task.telescope;
  const double fried_parameter = task.seeing().fried_parameter;
  const auto range_of = [&](std::string_view name) {
    return *std::ranges::find(result.ranges, name, &OptimumRange::name);
  };
  OptimumRange near = range_of("z_near");
  OptimumRange far = range_of("z_far");
  // The pairs of a design do not say which of them the search calls near.
  if (near.best > far.best) std::swap(near, far);
  const Performance performance = pooled(result.best().performances);
  const MeanAndError residual = performance.mean_of(performance_metric("residual_wfe_nm"));
  const double wavelength_nm = 1e9 * telescope.wavelength;
  return {.d_over_r0 = telescope.diameter / fried_parameter,
          .z_near_talbot =
              with_range(near.best / talbot_distance(fried_parameter, telescope.wavelength), near),
          .far_fresnel_number = with_range(fresnel_number(telescope, far.best), far),
          .residual_wfe = with_error_floor(
              {residual.mean / wavelength_nm, residual.standard_error / wavelength_nm}),
          .fractional_loops =
              with_error_floor(performance.mean_of(performance_metric("fractional_loops")))};
}

/// The configuration of the search at one seeing.
Configuration at_seeing(const Configuration& configuration, const std::array<int, 4>& order,
                        double d_over_r0) {
  Configuration here = configuration;
  here.set("search.order", fmt::format("{}", fmt::join(order, "")), "by law");
  here.set("seeing.d_over_r0", fmt::format("{}", d_over_r0), "by law");
  return here;
}

std::string data_table(const std::vector<ScalingDatum>& data, const ScalingLaw& law) {
  std::string table = fmt::format("  {:>6}", "D/r0");
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    table += fmt::format(" {:>26} {:>10}", quantity.name, "law");
  }
  for (const ScalingDatum& datum : data) {
    table += fmt::format("\n  {:>6.4g}", datum.d_over_r0);
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      table += fmt::format(" {:>26} {:>10.4g}", with_error(datum.*quantity.datum),
                           (law.*quantity.line).predict(datum.d_over_r0).mean);
    }
  }
  return table + '\n';
}

std::string data_csv(const std::vector<ScalingDatum>& data) {
  std::vector<std::string> columns{"d_over_r0"};
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    columns.emplace_back(quantity.name);
    columns.push_back(fmt::format("{}_standard_error", quantity.name));
  }
  CsvTable table(columns);
  for (const ScalingDatum& datum : data) {
    table.row().add(datum.d_over_r0);
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      table.add(datum.*quantity.datum);
    }
  }
  return table.text();
}

void run_law(const Request& request) {
  const Configuration& configuration = request.configuration;
  const std::array<int, 4> order = order_of(configuration);
  require_one_condition(configuration);
  const std::vector<double> ratios = seeings_of_law(configuration);
  require_two_pairs(configuration);
  // The one that shows what is wrong with the input, before anything is written.
  const DesignSearch first(at_seeing(configuration, order, ratios.front()));
  RunRecord record(request);

  std::vector<ScalingDatum> data;
  Json searches = Json::array();
  std::string ended_when;
  {
    Progress progress("law", double(ratios.size()), "seeings");
    for (const double ratio : ratios) {
      DesignSearch task(at_seeing(configuration, order, ratio));
      for (DesignTrial* trial : task.trials()) record.adopt(*trial);
      const DesignSearchResult result = task.run(record, &progress);
      if (!result.interrupted_when.empty()) {
        ended_when = fmt::format("; at D/r0 = {:g} {}", ratio, result.interrupted_when);
        break;
      }
      data.push_back(datum_of(task, result));
      record.folder().write("law.csv", data_csv(data));
      searches.push_back(to_json(result.best(), task.verification));
      fmt::print(
          "D/r0 = {:g}: near pair {} Talbot distances, far pair at Fresnel number {}, cost {}\n",
          ratio, with_error(data.back().z_near_talbot), with_error(data.back().far_fresnel_number),
          with_error(mean_and_standard_error(result.best().costs)));
      std::fflush(stdout);
      progress.at(double(data.size()), 1.0);
    }
  }
  if (data.size() < ratios.size()) {
    const std::string done = fmt::format("{} of {} seeings were done", data.size(), ratios.size());
    if (data.size() < least_seeings) {
      throw RunInterrupted(fmt::format("{}, and a law needs {}{}; {}", done, least_seeings,
                                       ended_when, record.how_to_go_on()));
    }
    record.note_interrupted(done + ended_when);
  }
  const LawFile file{law_conditions(at_seeing(configuration, order, ratios.front())), data,
                     fit_scaling_law(data, order)};
  record.folder().write("law.json", to_json(file).dump(2) + '\n');
  record.write_summary({{"law", to_json(file.law)}, {"designs", searches}});

  fmt::print("\nThe best designs, and the law that is fitted to them:\n{}\n",
             data_table(data, file.law));
  fmt::print("nlcwfs advise --advise.law {} follows it.\n",
             record.folder().file("law.json").string());
  record.close();
}

std::string of_law(const Json& summary) {
  const Json& law = summary.at("law");
  return fmt::format("Fitted to {} searches, D/r0 = {:g} to {:g}.", summary.at("designs").size(),
                     number_from_json(law.at("least_d_over_r0")),
                     number_from_json(law.at("greatest_d_over_r0")));
}

}  // namespace

Command law_command() {
  return {
      .name = "law",
      .group = "Laws and scaling",
      .description = "fit the scaling law that advise follows to the best designs at several D/r0",
      .about =
          "Searches the best symmetric design at each of law.d_over_r0 and fits lines to the "
          "planes and what they reach. Its law.json can be the advise.law of another day.",
      .keys = keys::joined({{"telescope", "seeing.outer_scale"},
                            keys::simulation,
                            keys::judgement,
                            keys::search,
                            {"law"}}),
      .examples = {"nlcwfs law --law.d_over_r0 3,4,6,8"},
      .run = run_law,
      .resumption = Resumption::by_trials,
      .files = {{"law.json"}, {"law.csv", FileRole::table}},
      .verdict = of_law,
      .is_of_one_seeing = false};
}

}  // namespace nlcwfs
