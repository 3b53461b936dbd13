// Tests: A run's folder is made, written to and cleared, and nothing is overwritten.
#include "results/archive/output_folder.hpp"

#include "tests/full_disk.hpp"
#include "tests/message_of.hpp"
#include "tests/scratch_folder.hpp"

#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using OutputFolderTest = ScratchFolder;

/// What an action that is no InputError fails with; empty where it succeeds.
template <class Action>
std::string failure_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return std::string("input error: ") + error.what();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(OutputFolderTest, IsTheFirstFreeNumberOfItsCommand) {
  EXPECT_EQ(OutputFolder({}, "evaluate").path(), "results/evaluate-1");
  EXPECT_EQ(OutputFolder({}, "evaluate").path(), "results/evaluate-2");
  EXPECT_EQ(OutputFolder({}, "optimize").path(), "results/optimize-1");
  fs::remove("results/evaluate-1");
  std::ofstream("results/evaluate-3") << "a file in the way";
  EXPECT_EQ(OutputFolder({}, "evaluate").path(), "results/evaluate-1");
  EXPECT_EQ(OutputFolder({}, "evaluate").path(), "results/evaluate-4");
  EXPECT_THAT(names_in("results"),
              ElementsAre("evaluate-1", "evaluate-2", "evaluate-3", "evaluate-4", "optimize-1"));
}

TEST_F(OutputFolderTest, IsNeverSharedByRunsThatStartTogether) {
  constexpr int runs = 20;
  std::vector<fs::path> paths(runs);
  std::vector<std::jthread> threads;
  for (fs::path& path : paths) {
    threads.emplace_back([&path] { path = OutputFolder({}, "evaluate").path(); });
  }
  threads.clear();
  EXPECT_EQ(std::set(paths.begin(), paths.end()).size(), paths.size());
  EXPECT_EQ(names_in("results").size(), paths.size());
}

TEST_F(OutputFolderTest, MakesTheRequestedFolderAndItsParents) {
  EXPECT_EQ(OutputFolder("mine", "evaluate").path(), "mine");
  EXPECT_EQ(OutputFolder("deep/er/mine", "evaluate").path(), "deep/er/mine");
  const fs::path absolute = fs::absolute("absolute/ly");
  EXPECT_EQ(OutputFolder(absolute, "evaluate").path(), absolute);
  EXPECT_TRUE(fs::is_directory("mine") && fs::is_directory("deep/er/mine") &&
              fs::is_directory("absolute/ly"));
  EXPECT_FALSE(fs::exists("results"));
}

TEST_F(OutputFolderTest, TakesATrailingSlash) {
  EXPECT_EQ(failure_of([] { OutputFolder("mine/", "evaluate"); }), "");
  EXPECT_TRUE(fs::is_directory("mine"));
  EXPECT_THAT(message_of([] { OutputFolder("mine/", "evaluate"); }), HasSubstr("exists"));
}

TEST_F(OutputFolderTest, RefusesWhateverExistsAlready) {
  fs::create_directory("folder");
  std::ofstream("file") << "precious";
  fs::create_directory_symlink("nowhere", "dangling");
  for (const char* name : {"folder", "file", "dangling", ".", "folder/.."}) {
    const std::string expected = fmt::format("--output = {}: ", name);
    EXPECT_THAT(message_of([&] { OutputFolder::require_free(name); }), StartsWith(expected));
    EXPECT_THAT(message_of([&] { OutputFolder(name, "evaluate"); }), StartsWith(expected));
  }
  EXPECT_EQ(contents("file"), "precious");
  EXPECT_THAT(names_in("."), ElementsAre("dangling", "file", "folder"));
  EXPECT_EQ(message_of([] { OutputFolder::require_free("free"); }), "");
}

TEST_F(OutputFolderTest, NamesPathAndCauseWhereItCannotBeMade) {
  std::ofstream("file") << "a file";
  EXPECT_EQ(message_of([] { OutputFolder("file/mine", "evaluate"); }),
            "--output = file/mine: cannot be made (Not a directory); name a folder where you may "
            "write");
  EXPECT_THAT(message_of([] { OutputFolder("file/deep/er", "evaluate"); }),
              StartsWith("--output = file/deep/er: cannot be made ("));
  // Not even root makes folders there.
  EXPECT_THAT(message_of([] { OutputFolder("/proc/mine", "evaluate"); }),
              StartsWith("--output = /proc/mine: cannot be made ("));
  std::ofstream("results") << "a file";
  EXPECT_THAT(message_of([] { OutputFolder({}, "evaluate"); }),
              StartsWith("--output = results/evaluate-1: cannot be made ("));
}

TEST_F(OutputFolderTest, WritesFilesWhole) {
  const OutputFolder folder("mine", "evaluate");
  const std::string text = std::string("line\r\n\0zero", 11) + std::string(100000, 'x');
  folder.write("table.csv", text);
  EXPECT_EQ(contents("mine/table.csv"), text);
  EXPECT_THAT(names_in("mine"), ElementsAre("table.csv"));
  EXPECT_EQ(folder.file("table.csv"), fs::path("mine/table.csv"));
}

TEST_F(OutputFolderTest, NamesTheFileThatItCannotWrite) {
  const OutputFolder folder("mine", "evaluate");
  fs::remove("mine");
  EXPECT_THAT(failure_of([&] { folder.write("table.csv", "1"); }),
              AllOf(StartsWith("cannot write mine/table.csv"), HasSubstr("No such file")));
}

TEST_F(OutputFolderTest, LeavesNoPartOfAFileThatDidNotFit) {
  const OutputFolder folder("mine", "evaluate");
  const std::string failure = [&] {
    const FullDisk disk(2);
    return failure_of([&] { folder.write("table.csv", "12345"); });
  }();
  EXPECT_THAT(failure, AllOf(StartsWith("cannot write mine/table.csv"), HasSubstr("too large")));
  EXPECT_FALSE(fs::exists("mine/table.csv"));
}

TEST_F(OutputFolderTest, WritesThroughNoLink) {
  const OutputFolder folder("mine", "evaluate");
  std::ofstream("target") << "mine";
  for (const char* name : {"mine/table.csv.part", "mine/table.csv"}) {
    fs::create_symlink(fs::absolute("target"), name);
  }
  folder.write("table.csv", "1");
  EXPECT_EQ(contents("target"), "mine");
  EXPECT_EQ(contents("mine/table.csv"), "1");
  EXPECT_FALSE(fs::is_symlink("mine/table.csv"));
}

TEST_F(OutputFolderTest, RemovesResultsAndLinksOfTheirNamesAlone) {
  const OutputFolder folder("mine", "evaluate");
  std::ofstream("target") << "mine";
  fs::create_symlink(fs::absolute("target"), "mine/worst-images.fits");
  fs::create_symlink("nowhere", "mine/map-cost.png");
  fs::create_directory("mine/search.csv");
  for (const char* name : {"config.cfg", "archive.sqlite", "best.cfg", "search.csv.part",
                           "design.gnuplot.part", "design.svg", "figure-3-map.png",
                           "map-cost.data.part", "report.html", "response-map-wfe.svg"}) {
    std::ofstream(std::string("mine/") + name) << "";
  }
  const std::vector<std::string> users{"mask.fits",    "my.cfg",       "notes.txt",  "search.txt",
                                       "search-2.csv", "screens.fits", "design.cfg", "my.part"};
  for (const std::string& name : users) std::ofstream("mine/" + name) << "";
  const std::vector<RunFile> files =
      joined({{{"best.cfg"}, {"search.csv"}, {"worst-images.fits"}},
              picture_files({"design", "figure-*", "map-*", "response-map-*"})});
  folder.remove_results(files);
  EXPECT_THAT(
      names_in("mine"),
      ElementsAre("archive.sqlite", "config.cfg", "design.cfg", "mask.fits", "my.cfg", "my.part",
                  "notes.txt", "screens.fits", "search-2.csv", "search.csv", "search.txt"));
  EXPECT_EQ(contents("target"), "mine");
}

}  // namespace
}  // namespace nlcwfs
