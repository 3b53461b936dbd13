// Tests of report: the page of an earlier run, again.
#include "studies/commands/report.hpp"

#include "studies/commands/commands.hpp"
#include "studies/run/page_data.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using OrderedJson = nlohmann::ordered_json;

class Report : public Program {
 protected:
  static void replace_in(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = contents(file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(file) << text.replace(at, from.size(), to);
  }

  /// What `report folder` answers where it must not do it.
  static std::string refusal(const std::string& folder) {
    const std::vector<std::string> before = names_in(".");
    const ProgramRun refused = run({"report", folder});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.output, "");
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1);
    EXPECT_FALSE(std::filesystem::exists(folder + "/report.html"));
    return refused.errors;
  }
};

TEST_F(Report, IsMadeByTheRunAndTheSameAgain) {
  const ProgramRun finished = done("evaluate", "run");
  EXPECT_THAT(finished.output, HasSubstr("Open run/report.html in a browser.\n"));
  const std::string page = contents("run/report.html");
  EXPECT_THAT(page, HasSubstr("<title>nlcwfs evaluate: run</title>"));
  std::filesystem::remove("run/report.html");
  const std::vector<std::string> before = names_in("run");
  const ProgramRun again = run({"report", "run"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.output, "run/report.html is written.\n");
  EXPECT_EQ(contents("run/report.html"), page);
  EXPECT_EQ(names_in("run").size(), before.size() + 1);
  EXPECT_EQ(run({"report", "run/"}).exit_code, 0);  // replaces the one that is there
}

TEST_F(Report, HasTheNumbersOfTheFolder) {
  done("optimize", "run");
  const OrderedJson data = page_data("run", command_of_run("run"));
  const OrderedJson written = OrderedJson::parse(contents("run/summary.json"));
  EXPECT_EQ(data.at("command"), "optimize");
  EXPECT_EQ(data.at("version"), written.at("version"));
  EXPECT_EQ(data.at("summary").at("best"), written.at("best"));
  EXPECT_FALSE(data.at("summary").contains("config"));
  EXPECT_EQ(data.at("configuration"), contents("run/config.cfg"));
  EXPECT_EQ(data.at("design_configuration").at("text"), contents("run/best.cfg"));
  EXPECT_EQ(data.at("diameter_m"), 0.5);
  EXPECT_NEAR(data.at("talbot_m"), 2.0 * 0.125 * 0.125 / 532e-9, 1e-6);
  EXPECT_THAT(data.at("telescope").get<std::string>(), StartsWith("0.5 m telescope at 532 nm"));
  EXPECT_THAT(data.at("verdict").get<std::string>(), HasSubstr("aseline"));
  const OrderedJson& search = data.at("tables").at("search.csv");
  EXPECT_EQ(search.at("evaluation").size(), written.at("evaluations"));
  EXPECT_TRUE(search.at("cost").at(0).is_number());
  EXPECT_TRUE(search.at("planes_m").at(0).is_string());
  EXPECT_TRUE(search.at("failure").at(0).is_null());
}

TEST_F(Report, SaysWhatIsMissing) {
  done("optimize", "run");
  for (const char* file : {"search.csv", "best.cfg", "config.cfg"}) {
    std::filesystem::remove(std::filesystem::path("run") / file);
  }
  EXPECT_EQ(run({"report", "run"}).exit_code, 0);
  const OrderedJson data = page_data("run", command_of_run("run"));
  EXPECT_THAT(data.at("notes").dump(),
              AllOf(HasSubstr("Not in the folder"), HasSubstr("search.csv"), HasSubstr("best.cfg"),
                    HasSubstr("config.cfg")));
  EXPECT_FALSE(data.contains("tables") && data.at("tables").contains("search.csv"));
}

TEST_F(Report, SaysWhatItCannotRead) {
  done("optimize", "run");
  std::ofstream("run/search.csv", std::ios::app) << "1,2\n";
  replace_in("run/config.cfg", "[telescope]\n", "[telescope]\nwing_span = 3\n");
  replace_in("run/summary.json", "\"improvement\"", "\"improvements\"");
  EXPECT_EQ(run({"report", "run"}).exit_code, 0);
  const OrderedJson data = page_data("run", command_of_run("run"));
  EXPECT_THAT(data.at("notes").dump(),
              AllOf(HasSubstr("search.csv"), HasSubstr("wing_span"), HasSubstr("verdict")));
  EXPECT_FALSE(data.contains("verdict"));
  EXPECT_THAT(data.at("configuration").get<std::string>(), HasSubstr("wing_span"));
}

TEST_F(Report, RefusesWhatIsNoRunInOneLine) {
  EXPECT_THAT(refusal("nowhere"), HasSubstr("DIR = nowhere: there is no such folder"));
  std::filesystem::create_directory("run");
  EXPECT_THAT(refusal("run"), HasSubstr("DIR = run: has no summary.json"));
  std::filesystem::create_directory("run/summary.json");
  EXPECT_THAT(refusal("run"), HasSubstr("DIR = run: has no summary.json"));
  std::filesystem::remove("run/summary.json");
  std::ofstream("run/summary.json") << R"({"command": "evaluate")";
  EXPECT_THAT(refusal("run"), HasSubstr("no JSON object"));
  std::ofstream("run/summary.json") << "[1, 2]";
  EXPECT_THAT(refusal("run"), HasSubstr("no JSON object"));
  for (const char* command : {R"("bake")", "17", "null", R"("report\n")"}) {
    std::ofstream("run/summary.json") << "{\"command\": " << command << "}";
    EXPECT_THAT(refusal("run"),
                AllOf(HasSubstr("of the command"), HasSubstr("evaluate, export, law")));
  }
  std::ofstream("run/summary.json") << "{}";
  EXPECT_THAT(refusal("run"), HasSubstr("of the command"));
  const ProgramRun bare = run({"report"});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_THAT(bare.errors, HasSubstr("DIR must follow report: nlcwfs report DIR"));
}

TEST_F(Report, AnEmptySummaryIsStillAPage) {
  std::filesystem::create_directories("run");
  for (const Command& command : commands()) {
    const std::set<std::string> without_folder{"report", "manual", "completion"};
    if (without_folder.contains(command.name)) continue;
    std::ofstream("run/summary.json") << OrderedJson{{"command", command.name}};
    const ProgramRun finished = run({"report", "run"});
    EXPECT_EQ(finished.exit_code, 0) << command.name << finished.errors;
    EXPECT_THAT(page_data("run", command_of_run("run")).at("notes"), Not(IsEmpty()));
  }
}

TEST_F(Report, AFrontsConfigurationsAreItsDesigns) {
  done("trade", "run", {"--trade.budget", "16", "--trade.population", "8"});
  const OrderedJson data = page_data("run", command_of_run("run"));
  const OrderedJson& front = data.at("summary").at("front");
  const OrderedJson& texts = data.at("front_configurations");
  ASSERT_EQ(texts.size(), front.size());
  ASSERT_GT(front.size(), 1u);
  for (std::size_t i = 0; i < std::min<std::size_t>(front.size(), 4); ++i) {
    std::ofstream("design.cfg") << texts.at(i).get<std::string>();
    const std::string folder = fmt::format("design-{}", i);
    const ProgramRun tried = run({"evaluate", "--config", "design.cfg", "--output", folder});
    ASSERT_EQ(tried.exit_code, 0) << tried.errors;
    OrderedJson design = OrderedJson::parse(contents(folder + "/summary.json")).at("design");
    OrderedJson expected = front.at(i);
    // Measured on other screens.
    for (const char* measured : {"performance", "cost", "violation", "futility"}) {
      design.erase(measured);
    }
    for (const auto& [name, value] : design.items()) EXPECT_EQ(value, expected.at(name)) << name;
  }
}

TEST_F(Report, MarksTheBestOfASweep) {
  done("sweep", "run", {"--sweep.z_far", "100km,150km", "--sweep.relaxation", "0,0.3"});
  const OrderedJson data = page_data("run", command_of_run("run"));
  const OrderedJson& axes = data.at("summary").at("grid").at("axes");
  const OrderedJson& place = data.at("best_place");
  ASSERT_EQ(place.size(), axes.size());
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const auto values = axes.at(axis).at("values").get<std::vector<double>>();
    EXPECT_THAT(values, testing::Contains(testing::DoubleNear(place.at(axis), 1e-6)));
  }
}

TEST_F(Report, OfAnotherCommandNeedsNoConfiguration) {
  done("screens", "run", {"--screens.count", "3"});
  const OrderedJson images =
      page_data("run", command_of_run("run")).at("images").at("screens.fits");
  EXPECT_EQ(images.at("unit"), "rad");
  EXPECT_EQ(images.at("count"), 3);
  EXPECT_EQ(images.at("slices").size(), 3u);
  EXPECT_EQ(images.at("samples"), 32);
}

}  // namespace
}  // namespace nlcwfs
