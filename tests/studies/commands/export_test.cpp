// Tests of export: a run's archive as flat tables.
#include "results/archive/archive.hpp"
#include "results/tables/csv_table.hpp"
#include "tests/studies/program.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;
using Json = nlohmann::json;

class ExportStudy : public Program {
 protected:
  static ProgramRun exported(const std::string& run_folder, const Arguments& more = {}) {
    Arguments arguments{"export", run_folder, "--output", "table"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  static void expect_refused(const std::string& run_folder, const std::string& why) {
    const ProgramRun finished = exported(run_folder);
    EXPECT_EQ(finished.exit_code, 2) << run_folder;
    EXPECT_THAT(finished.errors,
                AllOf(StartsWith(fmt::format("nlcwfs: RUN = {}: ", run_folder)), HasSubstr(why)));
    EXPECT_EQ(std::ranges::count(finished.errors, '\n'), 1) << finished.errors;
    EXPECT_FALSE(std::filesystem::exists("table")) << run_folder;
  }
};

TEST_F(ExportStudy, HasEveryEvaluationOfASearchInEveryFormat) {
  done("optimize", "search", {"--search.plane_count", "3,4", "--search.layout", "free"});
  const ProgramRun finished = exported("search");
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_THAT(finished.output, EndsWith("Results are in table.\n"));
  EXPECT_THAT(names_in("table"), AllOf(Contains("evaluations.csv"), Contains("evaluations.fits"),
                                       Contains("evaluations.json"), Contains("summary.json")));

  const std::vector<ArchivedEvaluation> archived =
      Archive::reopened("search/archive.sqlite").evaluations();
  const std::vector<CsvRow> rows = read_csv("table/evaluations.csv");
  const Json list = Json::parse(contents("table/evaluations.json"));
  ASSERT_THAT(rows, SizeIs(archived.size()));
  ASSERT_THAT(list, SizeIs(archived.size()));
  for (std::size_t i = 0; i < archived.size(); ++i) {
    const Json design = Json::parse(archived[i].design);
    const Json performance = Json::parse(archived[i].performance);
    EXPECT_EQ(rows[i].at("stage"), archived[i].stage);
    EXPECT_EQ(std::stod(rows[i].at("cost")), archived[i].cost);
    EXPECT_EQ(std::stod(rows[i].at("planes_m_2")), design["planes_m"][1].get<double>());
    EXPECT_EQ(rows[i].at("planes_m_4").empty(), design["planes_m"].size() == 3);
    EXPECT_EQ(std::stod(rows[i].at("residual_wfe_nm_standard_error")),
              performance["residual_wfe_nm"]["standard_error"].get<double>());
    EXPECT_EQ(list[i].at("planes_m"), design["planes_m"]);
    EXPECT_EQ(list[i].at("performance"), performance);
  }
  const Json json = summary("table");
  EXPECT_EQ(json.at("command"), "export");
  EXPECT_EQ(json.at("evaluations"), archived.size());
  EXPECT_EQ(json.at("stages").at("search"), 6);
  EXPECT_EQ(json.at("source"), "search");
}

TEST_F(ExportStudy, TakesTheArchivesOfOtherCommandsToo) {
  done("evaluate", "evaluate");
  done("sweep", "sweep", {"--sweep.relaxation", "0,0.4"});
  for (const auto& [archive, stage] :
       {std::pair("evaluate/archive.sqlite", "evaluate"), std::pair("sweep", "sweep")}) {
    const ProgramRun finished = exported(archive, {"--export.formats", "csv"});
    ASSERT_EQ(finished.exit_code, 0) << finished.errors;
    const std::vector<CsvRow> rows = read_csv("table/evaluations.csv");
    EXPECT_EQ(rows.front().at("stage"), stage);
    EXPECT_GT(std::stod(rows.front().at("residual_wfe_nm")), 0.0);
    std::filesystem::remove_all("table");
  }
}

TEST_F(ExportStudy, WritesTheFormatsThatAreAskedFor) {
  done("evaluate", "one");
  ASSERT_EQ(exported("one", {"--export.formats", "fits, json"}).exit_code, 0);
  EXPECT_THAT(names_in("table"), AllOf(Contains("evaluations.fits"), Contains("evaluations.json"),
                                       Not(Contains("evaluations.csv"))));
  for (const char* formats : {"xml", "csv,", "csv,votable", "CSV"}) {
    const ProgramRun refused =
        run({"export", "one", "--output", "other", "--export.formats", formats});
    EXPECT_EQ(refused.exit_code, 2) << formats;
    EXPECT_THAT(refused.errors, AllOf(HasSubstr(fmt::format("export.formats = {}", formats)),
                                      HasSubstr("csv, json and fits")));
    EXPECT_FALSE(std::filesystem::exists("other"));
  }
}

TEST_F(ExportStudy, AnArchiveWithoutEvaluationsIsATableWithoutRows) {
  done("screens", "none");  // makes an archive, but tries no design
  const ProgramRun finished = exported("none");
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(contents("table/evaluations.csv"), "evaluation,stage,key,cost,failure,seconds\n");
  EXPECT_THAT(Json::parse(contents("table/evaluations.json")), IsEmpty());
  EXPECT_EQ(summary("table").at("evaluations"), 0);
}

TEST_F(ExportStudy, KeepsHostileTextOutOfTheTerminalAndOfOtherCells) {
  const std::string failure = "\"a\",b\n\x1b[31m\xff=SUM(1)";
  {
    Archive archive("hostile.sqlite", "sweep");
    archive.add({.stage = "search\x1b[2J",
                 .design = R"({"planes_m":[1.0,2.0]})",
                 .cost = std::nan(""),
                 .failure = failure,
                 .seconds = 0.0,
                 .performance = ""});
  }
  const ProgramRun finished = exported("hostile.sqlite");
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_THAT(finished.output, AllOf(Not(HasSubstr("\x1b")), HasSubstr("1 of them failed")));
  const std::vector<CsvRow> rows = read_csv("table/evaluations.csv");
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].at("failure"), failure);
  EXPECT_EQ(rows[0].at("planes_m_2"), "2");
  const std::string in_json = Json::parse(contents("table/evaluations.json"))[0].at("failure");
  EXPECT_THAT(in_json, AllOf(StartsWith("\"a\",b\n\x1b[31m"), EndsWith("=SUM(1)")));
}

TEST_F(ExportStudy, RefusesWhatIsNoArchive) {
  expect_refused("missing", "there is no such file");
  std::filesystem::create_directory("empty");
  expect_refused("empty", "has no archive.sqlite");
  std::ofstream("text.sqlite") << "this is not a database at all, it is a text";
  expect_refused("text.sqlite", "is no archive of a run of this version; name the folder of a run");
  std::ofstream("nothing.sqlite") << "";
  expect_refused("nothing.sqlite",
                 "is no archive of a run of this version; name the folder of a run");
  {
    Archive archive("broken.sqlite", "sweep");
    archive.add({.stage = "search",
                 .design = "{\"planes_m\":",
                 .cost = 1.0,
                 .failure = "",
                 .seconds = 0.0,
                 .performance = "{}"});
  }
  expect_refused("broken.sqlite", "the design of evaluation 1 is no JSON object");
}

TEST_F(ExportStudy, NeverOverwritesAndLeavesTheArchiveAsItIs) {
  done("evaluate", "one");
  const std::string before = contents("one/archive.sqlite");
  std::filesystem::create_directory("table");
  std::ofstream("table/evaluations.csv") << "precious";
  EXPECT_EQ(exported("one").exit_code, 2);
  EXPECT_EQ(contents("table/evaluations.csv"), "precious");
  EXPECT_THAT(names_in("table"), ElementsAre("evaluations.csv"));
  EXPECT_EQ(contents("one/archive.sqlite"), before);
}

TEST_F(ExportStudy, WantsOneRun) {
  for (const Arguments& arguments : {Arguments{"export"}, Arguments{"export", "one", "two"}}) {
    const ProgramRun finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_THAT(finished.errors, HasSubstr("export RUN"));
  }
}

}  // namespace
}  // namespace nlcwfs
