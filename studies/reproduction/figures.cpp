// The paper's figures: all that the program knows of each, and what goes through their list.
#include "studies/reproduction/figures.hpp"

#include "model/input_error.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>

#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

constexpr const char* figures_key = "reproduce.figures";

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  boost::split(names, text, [](char c) { return c == ','; });
  for (std::string& name : names) name = std::string(trimmed(name));
  return names;
}

}  // namespace

std::vector<std::string> figures_of(const Configuration& configuration) {
  const std::string& text = configuration.text(figures_key);
  const std::vector<std::string> known = names_in(Configuration().text(figures_key));
  std::vector<std::string> figures = names_in(text);
  for (const std::string& figure : figures) {
    if (std::ranges::count(known, figure) == 0) {
      throw InputError(figures_key, one_line(text),
                       fmt::format("a list of {}", fmt::join(known, ", ")));
    }
  }
  for (const std::string& figure : figures) {
    if (std::ranges::count(figures, figure) > 1) {
      throw InputError(figures_key, one_line(text),
                       fmt::format("each value once, but {} is twice", figure));
    }
  }
  return figures;
}

std::vector<PlannedRun> planned_runs(const Configuration& configuration) {
  Plan plan(configuration, figures_of(configuration));
  // In the order of the key's default, which is not that of the report.
  std::vector<const PaperFigure*> figures;
  for (const std::string& name : figures_of(Configuration())) {
    if (!plan.has(name)) continue;
    figures.push_back(&*std::ranges::find(paper_figures(), name, &PaperFigure::name));
  }
  for (const StudySetup setup : setups) {
    for (const PaperFigure* figure : figures) {
      if (figure->plan) figure->plan(plan, setup);
    }
  }
  for (const PaperFigure* figure : figures) {
    if (figure->plan_alone) figure->plan_alone(plan);
  }
  return std::move(plan).runs();
}

std::vector<Claim> checked_claims(const ReproducedRuns& runs,
                                  const std::vector<std::string>& figures) {
  std::vector<Claim> claims;
  for (const PaperFigure& figure : paper_figures()) {
    if (std::ranges::count(figures, figure.name) == 0) continue;
    for (const ClaimRule& rule : figure.claims) {
      Claim claim{.figure = std::string(figure.name),
                  .sentence = std::string(rule.sentence),
                  .papers = std::string(rule.papers),
                  .rule = std::string(rule.rule),
                  .findings = {}};
      for (const StudySetup setup : setups) {
        ClaimFinding finding = rule.find(SetupRuns(runs, setup));
        finding.why = setup == StudySetup::paper ? rule.why : rule.extended_why;
        claim.findings.emplace(setup, std::move(finding));
      }
      claims.push_back(std::move(claim));
    }
  }
  return claims;
}

}  // namespace nlcwfs
