#include "results/archive.hpp"

#include "tests/scratch_folder.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;
using testing::StartsWith;

using ArchiveTest = ScratchFolder;

using Row = std::vector<std::optional<std::string>>;

/// The rows that a query of another program gets, every value as text.
std::vector<Row> query(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> close(database, sqlite3_close);
  std::vector<Row> rows;
  const auto add_row = [](void* to, int count, char** values, char**) {
    Row row;
    for (int i = 0; i < count; ++i) {
      row.push_back(values[i] == nullptr ? std::nullopt : std::optional<std::string>(values[i]));
    }
    static_cast<std::vector<Row>*>(to)->push_back(std::move(row));
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), add_row, &rows, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  return rows;
}

ArchivedEvaluation success() {
  return {.stage = "search",
          .design = R"({"planes_m":[-1.0,1.0],"name":"it's \"quoted\""})",
          .cost = 1.0 / 3.0,
          .failure = "",
          .seconds = 0.25,
          .performance = R"({"screens":2})"};
}

std::string failure_of_opening(const std::filesystem::path& path) {
  try {
    const Archive archive(path, "sweep");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(ArchiveTest, HasItsTableBeforeTheFirstEvaluation) {
  const Archive archive("archive.sqlite", "sweep");
  EXPECT_THAT(query("archive.sqlite", "SELECT count(*) FROM evaluations"),
              ElementsAre(ElementsAre("0")));
}

TEST_F(ArchiveTest, KeepsEveryEvaluationInOrder) {
  Archive archive("archive.sqlite", "sweep");
  for (const char* stage : {"search", "search", "verify"}) {
    ArchivedEvaluation evaluation = success();
    evaluation.stage = stage;
    archive.add(evaluation);
  }
  // While the archive is still open: a killed run leaves what it had.
  EXPECT_THAT(query("archive.sqlite", "SELECT id, stage FROM evaluations ORDER BY id"),
              ElementsAre(ElementsAre("1", "search"), ElementsAre("2", "search"),
                          ElementsAre("3", "verify")));
}

TEST_F(ArchiveTest, KeepsTextAndNumbersExactly) {
  Archive("archive.sqlite", "sweep").add(success());
  EXPECT_THAT(query("archive.sqlite",
                    "SELECT design, cost = 1.0 / 3.0, seconds, performance FROM evaluations"),
              ElementsAre(ElementsAre(success().design, "1", "0.25", success().performance)));
}

TEST_F(ArchiveTest, IsReadableByTheJsonFunctionsOfSqlite) {
  Archive("archive.sqlite", "sweep").add(success());
  EXPECT_THAT(query("archive.sqlite",
                    "SELECT json_extract(design, '$.planes_m[0]'), "
                    "json_extract(performance, '$.screens') FROM evaluations"),
              ElementsAre(ElementsAre("-1.0", "2")));
}

TEST_F(ArchiveTest, AFailureHasAReasonAndNullsForWhatItLacks) {
  {
    Archive archive("archive.sqlite", "sweep");
    archive.add({.stage = "search",
                 .design = "{}",
                 .cost = std::numeric_limits<double>::quiet_NaN(),
                 .failure = "no light",
                 .seconds = 0.5,
                 .performance = ""});
    archive.add(success());
  }
  EXPECT_THAT(
      query("archive.sqlite", "SELECT cost, failure, performance FROM evaluations ORDER BY id"),
      ElementsAre(
          ElementsAre(std::nullopt, Optional(std::string("no light")), std::nullopt),
          ElementsAre(testing::Ne(std::nullopt), std::nullopt, Optional(success().performance))));
  // What a trade study asks for: the best design, failures aside.
  EXPECT_THAT(query("archive.sqlite", "SELECT min(cost) < 0.4, count(cost) FROM evaluations"),
              ElementsAre(ElementsAre("1", "1")));
}

TEST_F(ArchiveTest, GivesBackWhatWasAdded) {
  ArchivedEvaluation failed = success();
  failed.cost = std::numeric_limits<double>::quiet_NaN();
  failed.failure = "no light";
  failed.performance = "";
  failed.key = "-1,1;64";
  {
    Archive archive("archive.sqlite", "sweep");
    archive.add(success());
    archive.add(failed);
  }
  Archive archive = Archive::reopened("archive.sqlite");
  archive.add(failed);
  const std::vector<ArchivedEvaluation> all = archive.evaluations();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].cost, success().cost) << "to the last bit";
  EXPECT_TRUE(std::isnan(all[1].cost));
  const std::vector<ArchivedEvaluation> expected{success(), failed, failed};
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].stage, expected[i].stage);
    EXPECT_EQ(all[i].key, expected[i].key);
    EXPECT_EQ(all[i].design, expected[i].design);
    EXPECT_EQ(all[i].failure, expected[i].failure);
    EXPECT_EQ(all[i].seconds, expected[i].seconds);
    EXPECT_EQ(all[i].performance, expected[i].performance);
  }
}

TEST_F(ArchiveTest, GoesOnWithNoOtherTable) {
  const auto failure_of_reopening = [](const std::string& path) -> std::string {
    try {
      Archive::reopened(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(failure_of_reopening("none.sqlite"), StartsWith("cannot open the archive none"));
  EXPECT_FALSE(std::filesystem::exists("none.sqlite"));

  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open("old.sqlite", &database), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> close(database, sqlite3_close);
  ASSERT_EQ(sqlite3_exec(database, "CREATE TABLE evaluations (id INTEGER PRIMARY KEY, stage TEXT)",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  EXPECT_EQ(failure_of_reopening("old.sqlite"), "old.sqlite is no archive of a run of nlcwfs");
  std::ofstream("text") << std::string(200, '.');
  EXPECT_THAT(failure_of_reopening("text"), HasSubstr("not a database"));
}

TEST_F(ArchiveTest, NamesPathAndCauseWhereItCannotBeMade) {
  std::ofstream("file") << "a text that is no database, longer than its header of 100 bytes "
                        << std::string(100, '.');
  EXPECT_THAT(failure_of_opening("no/such/folder.sqlite"),
              AllOf(StartsWith("cannot open the archive no/such/folder.sqlite: "),
                    HasSubstr("unable to open")));
  EXPECT_THAT(failure_of_opening("file"),
              AllOf(StartsWith("cannot write to the archive file: "), HasSubstr("not a database")));
  EXPECT_THAT(failure_of_opening("/dev/full"), HasSubstr("the archive /dev/full: "));
}

TEST_F(ArchiveTest, DoesNotAppendToAnother) {
  Archive("archive.sqlite", "sweep").add(success());
  EXPECT_THAT(failure_of_opening("archive.sqlite"),
              StartsWith("cannot write to the archive archive.sqlite: "));
  EXPECT_EQ(query("archive.sqlite", "SELECT id FROM evaluations").size(), 1u);
}

TEST_F(ArchiveTest, KnowsWhoseRunItIsAndWhatItsTrialsFound) {
  {
    Archive archive("archive.sqlite", "optimize");
    EXPECT_EQ(archive.find("trial", "design"), std::nullopt);
    archive.keep("trial", "design", {{1, 0, 2}});
    archive.keep("trial", "design", {{1, 0, 2, 3}});
    archive.keep("trial", "it's bad", {{}, "no light"});
    archive.keep("other", "design", {{9}});
  }
  Archive archive = Archive::reopened("archive.sqlite");
  EXPECT_EQ(archive.command(), "optimize");
  EXPECT_TRUE(archive.has_trials());
  EXPECT_EQ(archive.known_designs("trial"), 2u);
  EXPECT_EQ(archive.find("trial", "design"), (ArchivedTrial{{1, 0, 2, 3}, ""}));
  EXPECT_EQ(archive.find("trial", "it's bad"), (ArchivedTrial{{}, "no light"}));
  EXPECT_EQ(archive.find("trial", "' OR ''='"), std::nullopt);
  EXPECT_GT(archive.seconds_before(), 0.0);
  archive.add(success());
  archive.clear_evaluations();
  EXPECT_TRUE(archive.evaluations().empty());
  EXPECT_EQ(archive.known_designs("trial"), 2u);
}

TEST_F(ArchiveTest, ReadsThoseOfOlderVersionsAndRefusesThoseOfNewerOnes) {
  const auto execute = [](const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> close(database, sqlite3_close);
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  };
  Archive("old.sqlite", "sweep").add(success());
  execute("old.sqlite", "DROP TABLE run; DROP TABLE trials; PRAGMA user_version = 0");
  const Archive old = Archive::reopened("old.sqlite");
  EXPECT_FALSE(old.has_trials());
  EXPECT_EQ(old.evaluations().size(), 1u);

  Archive("new.sqlite", "sweep").add(success());
  execute("new.sqlite", "PRAGMA user_version = 2");
  try {
    Archive::reopened("new.sqlite");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "new.sqlite is the archive of a newer version of nlcwfs");
  }
}

}  // namespace
}  // namespace nlcwfs
