// Tests: Every evaluation and every trial of a run, in SQLite.
#include "results/archive/archive.hpp"

#include "tests/full_disk.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/sqlite_query.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

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
  archive.commit();
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

/// An archive with what is hostile in it.
std::string failure_with(const char* sql) {
  std::filesystem::remove("hostile.sqlite");
  { const Archive archive("hostile.sqlite", "sweep"); }
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open("hostile.sqlite", &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  try {
    Archive::reopened("hostile.sqlite");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(ArchiveTest, IsOpenedWhileAnotherProgramWrites) {
  (void)Archive("archive.sqlite", "sweep");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open("archive.sqlite", &database), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> close(database, sqlite3_close);
  ASSERT_EQ(sqlite3_exec(database, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  const std::jthread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr), SQLITE_OK);
  });
  EXPECT_EQ(Archive::reopened("archive.sqlite").command(), "sweep");
}

TEST_F(ArchiveTest, OpensNoneThatComputesItsRows) {
  EXPECT_EQ(failure_with("CREATE INDEX costs ON evaluations (cost)"), "");
  for (const char* sql :
       {"ALTER TABLE evaluations RENAME TO hidden;"
        "CREATE VIEW evaluations AS WITH RECURSIVE row(i) AS (VALUES(1) UNION ALL SELECT i + 1 "
        "FROM row) SELECT i AS id, 's' AS stage, 'k' AS key, '{}' AS design, 1 AS cost, NULL AS "
        "failure, 1 AS seconds, NULL AS performance FROM row",
        "CREATE TRIGGER after_all AFTER DELETE ON evaluations BEGIN DELETE FROM trials; END",
        "ALTER TABLE evaluations ADD COLUMN more AS (abs(id)) VIRTUAL"}) {
    EXPECT_EQ(failure_with(sql), "hostile.sqlite is no archive of a run of nlcwfs") << sql;
  }
}

TEST_F(ArchiveTest, OpensNoneWhoseJournalNamesAnotherFile) {
  { const Archive archive("archive.sqlite", "sweep"); }
  std::ofstream("victim") << "mine";
  const std::string end = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::ofstream("archive.sqlite-journal", std::ios::binary) << std::string(600, '\0') << end;
  std::filesystem::create_symlink("archive.sqlite", "link.sqlite");
  for (const char* path : {"archive.sqlite", "link.sqlite"}) {
    EXPECT_THAT([&] { Archive::reopened(path); },
                testing::ThrowsMessage<std::runtime_error>(std::string(path) +
                                                           " is no archive of a run of nlcwfs"));
  }
  EXPECT_TRUE(std::filesystem::exists("archive.sqlite-journal"));
  // One without such a name is that of a run that was killed.
  std::ofstream("archive.sqlite-journal", std::ios::binary) << std::string(600, '\0');
  EXPECT_NO_THROW(Archive::reopened("archive.sqlite"));
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

TEST_F(ArchiveTest, PutsEvaluationsOnDiskWithTheNextTrial) {
  const auto rows = [] { return query("archive.sqlite", "SELECT id FROM evaluations").size(); };
  {
    Archive archive("archive.sqlite", "sweep");
    archive.add(success());
    EXPECT_EQ(archive.evaluations().size(), 1u);
    EXPECT_EQ(rows(), 0u);
    archive.keep("trial", "design", {{1}});
    EXPECT_EQ(rows(), 1u);
    archive.add(success());
    archive.commit();
    archive.commit();
    EXPECT_EQ(rows(), 2u);
    archive.add(success());
  }
  EXPECT_EQ(rows(), 3u);
}

TEST_F(ArchiveTest, KeepsWhatManyThreadsGiveItAtOnce) {
  constexpr int threads = 16;
  constexpr int each = 20;
  Archive archive("archive.sqlite", "sweep");
  const auto name = [](int thread, int i) { return std::to_string(thread * each + i); };
  {
    std::vector<std::jthread> all;
    for (int thread = 0; thread < threads; ++thread) {
      all.emplace_back([&, thread] {
        for (int i = 0; i < each; ++i) {
          archive.keep("trial", name(thread, i), {{std::uint8_t(thread), std::uint8_t(i)}});
          // On disk when the function returns, as another program sees it.
          if (i % 10 == 9) {
            EXPECT_EQ(query("archive.sqlite",
                            "SELECT 1 FROM trials WHERE design = " + name(thread, i) + " || ''")
                          .size(),
                      1u);
          }
        }
      });
    }
  }
  EXPECT_EQ(archive.known_designs("trial"), std::size_t(threads * each));
  EXPECT_EQ(archive.find("trial", name(3, 7)), (ArchivedTrial{{3, 7}}));
}

TEST_F(ArchiveTest, TellsEveryThreadThatItCannotKeep) {
  Archive archive("archive.sqlite", "sweep");
  std::atomic<int> failures = 0;
  {
    const FullDisk disk(100);
    std::vector<std::jthread> all;
    for (int thread = 0; thread < 8; ++thread) {
      all.emplace_back([&, thread] {
        try {
          archive.keep("trial", std::to_string(thread), {std::vector<std::uint8_t>(10000)});
        } catch (const std::runtime_error&) {
          ++failures;
        }
      });
    }
  }
  EXPECT_EQ(failures, 8);
  // Where there is room again, it goes on.
  archive.keep("trial", "0", {std::vector<std::uint8_t>(10000)});
  EXPECT_TRUE(archive.find("trial", "0"));
  EXPECT_FALSE(archive.find("trial", "1"));
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
