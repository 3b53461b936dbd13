// Tests: An archive becomes flat tables.
#include "results/tables/evaluation_table.hpp"

#include "results/archive/output_folder.hpp"
#include "results/fits/fits_table.hpp"
#include "results/tables/csv_table.hpp"
#include "tests/scratch_folder.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fitsio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using Json = nlohmann::ordered_json;

using EvaluationTableTest = ScratchFolder;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ArchivedEvaluation four_planes() {
  return {.stage = "sweep",
          .design = R"({"planes_m":[-4.0,4.0,0.1,-0.1],"initial_guess":"flat","tolerance_m":1e-9})",
          .cost = 1.0 / 3.0,
          .failure = "",
          .seconds = 0.25,
          .performance = R"({"residual_wfe_nm":{"mean":2.5,"standard_error":0.5},"screens":16,)"
                         R"("cost":{"mean":9,"standard_error":0.125},)"
                         R"("metrics":{"residual_wfe_nm":{"mean":9,"standard_error":9},)"
                         R"("latency_seconds":{"mean":0.01,"standard_error":0.001}}})",
          .key = "key"};
}

ArchivedEvaluation failed() {
  return {.stage = "search",
          .design = R"({"planes_m":[-1.0,1.0,null]})",
          .cost = nan,
          .failure = "no \"light\",\nsays \xc3\xa9 \x1b[31m \xff",
          .seconds = 0.5,
          .performance = ""};
}

FlatTable table_of(const std::vector<ArchivedEvaluation>& evaluations) {
  return evaluation_table(evaluation_list(evaluations));
}

std::vector<std::string> names_of(const FlatTable& table) {
  std::vector<std::string> names;
  for (const TableColumn& column : table.columns) names.push_back(column.name);
  return names;
}

const TableColumn& column(const FlatTable& table, std::string_view name) {
  for (const TableColumn& column : table.columns) {
    if (column.name == name) return column;
  }
  throw std::logic_error("no such column");
}

TEST_F(EvaluationTableTest, HasAColumnForEveryMemberInTheOrderOfTheArchive) {
  const FlatTable table = table_of({four_planes()});
  EXPECT_THAT(
      names_of(table),
      ElementsAre("evaluation", "stage", "key", "cost", "failure", "seconds", "planes_m_1",
                  "planes_m_2", "planes_m_3", "planes_m_4", "initial_guess", "tolerance_m",
                  "residual_wfe_nm", "residual_wfe_nm_standard_error", "screens",
                  "cost_standard_error", "latency_seconds", "latency_seconds_standard_error"));
  EXPECT_EQ(column(table, "planes_m_3").unit, "m");
  EXPECT_EQ(column(table, "residual_wfe_nm_standard_error").unit, "nm");
  EXPECT_EQ(column(table, "latency_seconds").unit, "s");
  EXPECT_EQ(column(table, "initial_guess").unit, "");
  EXPECT_EQ(column(table, "cost").cells.at(0), TableCell(1.0 / 3.0)) << "the archive's, not 9";
  EXPECT_EQ(column(table, "residual_wfe_nm").cells.at(0), TableCell(2.5)) << "not the metric's";
}

TEST_F(EvaluationTableTest, LeavesCellsEmptyThatAnEvaluationDoesNotHave) {
  for (const auto& evaluations :
       {std::vector{four_planes(), failed()}, std::vector{failed(), four_planes()}}) {
    const FlatTable table = table_of(evaluations);
    ASSERT_EQ(table.rows, 2U);
    for (const TableColumn& any : table.columns) EXPECT_THAT(any.cells, SizeIs(2)) << any.name;
    const std::size_t of_failed = evaluations.front().failure.empty() ? 1 : 0;
    for (const char* name : {"planes_m_3", "planes_m_4", "cost", "key", "residual_wfe_nm"}) {
      EXPECT_EQ(column(table, name).cells[of_failed], TableCell()) << name;
      EXPECT_NE(column(table, name).cells[1 - of_failed], TableCell()) << name;
    }
    EXPECT_EQ(column(table, "planes_m_2").cells[of_failed], TableCell(1.0));
  }
}

TEST_F(EvaluationTableTest, CsvKeepsEveryTextAndNumberExactly) {
  const OutputFolder folder("run", "export");
  folder.write("table.csv", table_of({four_planes(), failed()}).csv());
  const std::vector<CsvRow> rows = read_csv("run/table.csv");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(std::stod(rows[0].at("cost")), 1.0 / 3.0);
  EXPECT_EQ(std::stod(rows[0].at("planes_m_3")), 0.1);
  EXPECT_EQ(rows[0].at("failure"), "");
  EXPECT_EQ(rows[1].at("failure"), failed().failure);
  EXPECT_EQ(rows[1].at("cost"), "");
}

TEST_F(EvaluationTableTest, AnEmptyArchiveIsATableWithoutRows) {
  const FlatTable table = table_of({});
  EXPECT_EQ(table.csv(), "evaluation,stage,key,cost,failure,seconds\n");
  EXPECT_EQ(evaluation_list({}).dump(), "[]");
  write_fits_table("table.fits", table, "EVALUATIONS");
  EXPECT_THAT(contents("table.fits"), HasSubstr("NAXIS2  =                    0"));
}

TEST_F(EvaluationTableTest, JsonHasTheNamesOfSummaries) {
  const Json list = evaluation_list({four_planes(), failed()});
  ASSERT_THAT(list, SizeIs(2));
  EXPECT_EQ(list[0].at("planes_m"), Json({-4.0, 4.0, 0.1, -0.1}));
  EXPECT_EQ(list[0].at("cost"), 1.0 / 3.0);
  EXPECT_EQ(list[0].at("performance").at("residual_wfe_nm").at("standard_error"), 0.5);
  EXPECT_EQ(list[0].at("failure"), nullptr);
  EXPECT_EQ(list[1].at("evaluation"), 2);
  EXPECT_EQ(list[1].at("performance"), nullptr);
  EXPECT_EQ(list[1].at("cost"), nullptr);
}

TEST_F(EvaluationTableTest, NamesTheEvaluationThatIsBroken) {
  for (const char* text : {"", "{", "[1]", "null"}) {
    ArchivedEvaluation broken = four_planes();
    broken.design = text;
    EXPECT_THAT(
        [&] {
          (void)evaluation_list({four_planes(), broken});
        },
        testing::ThrowsMessage<std::runtime_error>(
            HasSubstr("the design of evaluation 2 is no JSON object")))
        << text;
  }
  ArchivedEvaluation broken = four_planes();
  broken.performance = "{\"screens\":";
  EXPECT_THROW((void)evaluation_list({broken}), std::runtime_error);
}

TEST_F(EvaluationTableTest, ADesignChangesNothingOfItsRow) {
  ArchivedEvaluation hostile = four_planes();
  hostile.design = R"({"stage":5,"failure":{},"performance":1,"more":2})";
  const Json row = evaluation_list({hostile}).front();
  EXPECT_EQ(row.at("stage"), "sweep");
  EXPECT_EQ(row.at("failure"), nullptr);
  EXPECT_EQ(row.at("performance").at("screens"), 16);
  EXPECT_EQ(row.at("more"), 2);
}

TEST_F(EvaluationTableTest, FitsIntoTheMemoryThatIsAllowed) {
  // The rows need not have what the columns are for.
  Json list = Json::array();
  for (int i = 0; i < 30000; ++i) list.push_back({{"x", i}});
  Json::object_t many;  // whose own insertion would look through all names
  for (int i = 0; i < 30000; ++i) many.emplace_back(std::to_string(i), "");
  list[0]["x"] = std::move(many);
  EXPECT_THAT([&] { evaluation_table(list); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("evaluations with 30007 columns takes 16 GiB"),
                        HasSubstr("16 GiB are allowed"))));
}

struct CloseTable {
  void operator()(fitsfile* file) const {
    int status = 0;
    fits_close_file(file, &status);
  }
};

/// The table of a file, as another program reads it.
class FitsReader {
 public:
  explicit FitsReader(const char* path) {
    fitsfile* file = nullptr;
    fits_open_table(&file, path, READONLY, &status_);
    file_.reset(file);
    EXPECT_EQ(status_, 0);
  }

  std::string keyword(const std::string& name) {
    std::array<char, FLEN_VALUE> value{};
    fits_read_key(file_.get(), TSTRING, name.c_str(), value.data(), nullptr, &status_);
    EXPECT_EQ(status_, 0) << name;
    return value.data();
  }
  int number_of(const std::string& name) {
    int number = 0;
    fits_get_colnum(file_.get(), CASESEN, std::string(name).data(), &number, &status_);
    EXPECT_EQ(status_, 0) << name;
    return number;
  }
  double number(const std::string& name, LONGLONG row) {
    double value = 0.0;
    int any = 0;
    fits_read_col(file_.get(), TDOUBLE, number_of(name), row, 1, 1, nullptr, &value, &any,
                  &status_);
    EXPECT_EQ(status_, 0) << name;
    return value;
  }
  std::string text(const std::string& name, LONGLONG row) {
    std::array<char, 1000> value{};
    char* to = value.data();
    int any = 0;
    std::array<char, 1> null{};
    fits_read_col(file_.get(), TSTRING, number_of(name), row, 1, 1, null.data(), &to, &any,
                  &status_);
    EXPECT_EQ(status_, 0) << name;
    return value.data();
  }

 private:
  int status_ = 0;
  std::unique_ptr<fitsfile, CloseTable> file_;
};

TEST_F(EvaluationTableTest, FitsHasUnitsAndEveryNumberExactly) {
  write_fits_table("table.fits", table_of({four_planes(), failed()}), "EVALUATIONS");
  FitsReader fits("table.fits");
  EXPECT_EQ(fits.keyword("EXTNAME"), "EVALUATIONS");
  EXPECT_EQ(fits.keyword("NAXIS2"), "2");
  EXPECT_EQ(fits.keyword(fmt::format("TUNIT{}", fits.number_of("planes_m_4"))), "m");
  EXPECT_EQ(fits.keyword(fmt::format("TUNIT{}", fits.number_of("residual_wfe_nm"))), "nm");
  EXPECT_EQ(fits.number("cost", 1), 1.0 / 3.0);
  EXPECT_EQ(fits.number("planes_m_3", 1), 0.1);
  EXPECT_TRUE(std::isnan(fits.number("cost", 2)));
  EXPECT_TRUE(std::isnan(fits.number("planes_m_3", 2)));
  EXPECT_EQ(fits.text("initial_guess", 1), "flat");
  EXPECT_EQ(fits.text("initial_guess", 2), " ");  // CFITSIO has no empty text
  // Two bytes of the letter, the escape, the line's end and what is no letter at all.
  EXPECT_EQ(fits.text("failure", 2), "no \"light\",?says ?? ?[31m ?");
}

TEST_F(EvaluationTableTest, FitsNeverOverwrites) {
  std::ofstream("table.fits") << "precious";
  EXPECT_THAT([&] { write_fits_table("table.fits", table_of({four_planes()}), "EVALUATIONS"); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("table.fits"), HasSubstr("exists"))));
  EXPECT_EQ(contents("table.fits"), "precious");
  EXPECT_THAT(names_in("."), ElementsAre("table.fits"));
}

}  // namespace
}  // namespace nlcwfs
