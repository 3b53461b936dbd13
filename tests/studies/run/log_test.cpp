// Tests: What goes to standard error while a command runs.
#include "tests/studies/program.hpp"

#include <regex>
#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;

using Log = Program;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Log, DebugHasEachStageAndDesignWithTimeCostAndDuration) {
  const ProgramRun finished = run({"optimize", "--config", "tiny.cfg", "--search.cheap_budget", "3",
                                   "--log-level", "debug", "--output", "run"});
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  const std::string stamp = R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} )";
  int designs = 0;
  for (const std::string& line : lines_of(finished.errors)) {
    EXPECT_TRUE(std::regex_match(line, std::regex(stamp + "[a-z ]+: .+"))) << line;
    const std::regex a_design(stamp + R"(search: a design, cost [0-9.]+, [-0-9.e]+ s)");
    if (std::regex_match(line, a_design)) ++designs;
  }
  EXPECT_EQ(designs, summary("run")["evaluations"]);
  for (const char* stage : {"cheap search", "search", "verification", "how far each variable"}) {
    EXPECT_THAT(finished.errors, HasSubstr(std::string(" ") + stage));
  }
  EXPECT_THAT(finished.errors, HasSubstr("search: ended, 6 of 6 designs in "));
  done("optimize", "again", {"--search.cheap_budget", "3"});
  EXPECT_EQ(repeatable_summary("again"), repeatable_summary("run"));
}

TEST_F(Log, ShortRunsHaveNoProgressWhereThereIsNoTerminal) {
  for (const Arguments& level :
       {Arguments{}, Arguments{"--quiet"}, Arguments{"--log-level", "info"},
        Arguments{"--log-level", "error"}}) {
    done("evaluate", "run", level);
    std::filesystem::remove_all("run");
  }
}

/// @return the exit code, -1 where a signal ended it
int exit_code_of(const std::string& words_and_streams) {
  const int status = std::system((program_path() + ' ' + words_and_streams).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(Log, StreamsThatCannotBeWrittenToChangeNoExitCode) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const std::string error : {"2> /dev/full", "2>&-", "<&- 2>&-"}) {
    EXPECT_EQ(exit_code_of("--foo > output.txt " + error), 2) << error;
    EXPECT_EQ(exit_code_of("evaluate --resume nowhere > output.txt " + error), 2) << error;
    EXPECT_EQ(exit_code_of("--version > output.txt " + error), 0) << error;
    EXPECT_EQ(exit_code_of("--version > /dev/full " + error), 1) << error;
  }
  EXPECT_EQ(exit_code_of("--version <&- >&- 2>&-"), 1);
}

TEST_F(Log, WhatIsPrintedGoesIntoNoFileOfTheRun) {
  done("evaluate", "whole");
  EXPECT_EQ(exit_code_of("evaluate --config tiny.cfg --output run --log-level debug <&- >&- 2>&-"),
            1);
  EXPECT_EQ(contents("run/screens.csv").substr(0, 20), contents("whole/screens.csv").substr(0, 20));
  EXPECT_EQ(repeatable_summary("run")["design"], repeatable_summary("whole")["design"]);
}

TEST_F(Log, ProgressIsALineOfTheTerminalThatGoesAgain) {
  if (std::system("script --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "there is no script(1) to make a terminal with";
  }
  const auto on_terminal = [](const std::string& level) {
    const std::string command =
        fmt::format("stty columns 30; {} evaluate --config tiny.cfg --output run{} > output.txt",
                    program_path(), level);
    EXPECT_EQ(
        std::system(
            fmt::format("script -qec '{}' terminal.txt > /dev/null < /dev/null", command).c_str()),
        0);
    std::filesystem::remove_all("run");
    std::string text = contents("terminal.txt");
    text = text.substr(text.find('\n') + 1);        // script's own first line
    return text.substr(0, text.rfind("\nScript"));  // and last
  };
  const std::string shown = on_terminal("");
  const std::string erase = "\r\x1b[K";
  EXPECT_THAT(shown, HasSubstr(erase + "evaluate: 0 of 2 screens"));
  std::size_t last = 0;
  for (auto at = shown.find(erase); at != std::string::npos; at = shown.find(erase, at + 1)) {
    const std::size_t begin = at + erase.size();
    const std::size_t end = std::min(shown.find('\r', begin), shown.size());
    EXPECT_LT(end - begin, 30u) << "it is cut to the terminal's width";
    last = end - begin;
  }
  EXPECT_EQ(last, 0u) << "nothing stays";
  EXPECT_EQ(on_terminal(" --quiet"), "");

  const std::string logged = on_terminal(" --log-level debug");
  EXPECT_THAT(logged, HasSubstr("evaluate: a design, cost "));
  for (const std::string& line : lines_of(logged)) {
    EXPECT_TRUE(line.starts_with(erase)) << "a line of progress was there before: " << line;
  }
}

}  // namespace
}  // namespace nlcwfs
