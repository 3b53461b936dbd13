// Lists of metrics with weights and bounds are read.
#include "studies/settings/metric_text.hpp"

#include "model/input_error.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/units.hpp"

#include <set>
#include <string>
#include <utility>

#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// One entry of a list, and how to refuse it.
struct Entry {
  std::string_view key;
  std::string_view text;
  std::string_view form;  ///< what it should look like

  [[noreturn]] void refuse() const {
    throw InputError(key, one_line(text), fmt::format("entries must be {}", form));
  }

  double number(std::string_view part) const {
    const auto value = parse_number(part);
    if (!value) refuse();
    return *value;
  }

  /// The two parts around the only one of `separators` in `whole`.
  std::pair<std::string_view, std::string_view> parts(std::string_view whole,
                                                      std::string_view separators) const {
    const auto at = whole.find_first_of(separators);
    if (at == std::string_view::npos) refuse();
    return {whole.substr(0, at), whole.substr(at + 1)};
  }

  DesignMetric metric(std::string_view name) const {
    name = trimmed(name);
    if (const DesignMetric* found = find_design_metric(name)) return *found;
    std::vector<std::string> names;
    for (const DesignMetric& known : design_metrics()) names.emplace_back(known.name);
    throw InputError(key, one_line(text),
                     fmt::format("there is no metric {}{} There are {}", one_line(name),
                                 suggestion(one_line(name), names, "."), fmt::join(names, ", ")));
  }

  /// METRIC<BOUND or METRIC>BOUND: the side that it names.
  MetricBound bound(std::string_view whole) const {
    const auto [name, value] = parts(whole, "<>");
    return {metric(name), whole[name.size()] == '>' ? Side::above : Side::below, number(value)};
  }
};

/// `parse(entry)` of each entry.
template <class Parse>
auto parse_list(std::string_view key, std::string_view text, std::string_view form,
                const Parse& parse) {
  std::vector<decltype(parse(Entry()))> list;
  if (trimmed(text).empty()) return list;
  std::vector<std::string> entries;
  boost::split(entries, text, [](char c) { return c == ','; });
  for (const std::string& entry : entries) list.push_back(parse(Entry{key, trimmed(entry), form}));
  return list;
}

}  // namespace

std::vector<CostTerm> parse_terms(std::string_view key, std::string_view text) {
  return parse_list(key, text, "METRIC:WEIGHT, such as plane_count:0.05", [](const Entry& entry) {
    const auto [name, weight] = entry.parts(entry.text, ":");
    return CostTerm{entry.metric(name), entry.number(weight)};
  });
}

std::vector<Penalty> parse_penalties(std::string_view key, std::string_view text) {
  return parse_list(key, text,
                    "METRIC>BOUND:WEIGHT or METRIC<BOUND:WEIGHT with a weight of at least 0, such "
                    "as total_wfe_nm>30:0.1",
                    [](const Entry& entry) {
                      const auto [bound, weight] = entry.parts(entry.text, ":");
                      Penalty penalty{entry.bound(bound), entry.number(weight)};
                      if (penalty.weight < 0.0) entry.refuse();
                      return penalty;
                    });
}

std::vector<MetricBound> parse_limits(std::string_view key, std::string_view text) {
  return parse_list(key, text, "METRIC<BOUND or METRIC>BOUND, such as latency_seconds<5e-3",
                    [](const Entry& entry) {
                      MetricBound limit = entry.bound(entry.text);
                      limit.side = limit.side == Side::above ? Side::below : Side::above;
                      return limit;
                    });
}

std::vector<DesignMetric> parse_metrics(std::string_view key, std::string_view text) {
  std::set<std::string_view> seen;
  return parse_list(key, text, "METRIC", [&](const Entry& entry) {
    DesignMetric metric = entry.metric(entry.text);
    if (!seen.insert(metric.name).second) {
      throw InputError(key, one_line(text),
                       fmt::format("each metric once, but {} is twice there", metric.name));
    }
    return metric;
  });
}

}  // namespace nlcwfs
