// Tests: results are those of the plain loops, up to rounding.
#include "tests/paths.hpp"
#include "tests/studies/program.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

/// The rows of a table of numbers, by column name.
std::vector<std::map<std::string, double>> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    std::string cell;
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      row[name] = std::stod(cell);
    }
  }
  return rows;
}

class UnchangedResults : public Program {};

TEST_F(UnchangedResults, AreThoseOfThePlainLoopsUpToRounding) {
  // See tests/reference/README.md.
  const auto references =
      nlohmann::json::parse(std::ifstream(test_reference_folder() + "/evaluations.json"));
  ASSERT_GE(references.size(), 6u);
  for (std::size_t i = 0; i < references.size(); ++i) {
    const std::string folder = "run" + std::to_string(i);
    Arguments arguments{"evaluate", "--output", folder};
    for (const auto& argument : references[i]["arguments"]) arguments.push_back(argument);
    const ProgramRun finished = run(arguments);
    ASSERT_EQ(finished.exit_code, 0) << finished.errors;
    const auto rows = rows_of(contents(folder + "/screens.csv"));
    const auto& expected = references[i]["screens"];
    ASSERT_EQ(rows.size(), expected.size());
    for (std::size_t screen = 0; screen < rows.size(); ++screen) {
      for (const auto& [name, value] : expected[screen].items()) {
        const auto reference = value.get<double>();
        EXPECT_NEAR(rows[screen].at(name), reference,
                    references[i]["tolerance"].get<double>() * std::abs(reference))
            << name << " of " << references[i]["arguments"].dump() << ", screen " << screen;
      }
    }
  }
}

}  // namespace
}  // namespace nlcwfs
