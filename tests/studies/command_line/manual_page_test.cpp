// Tests: The manual page nlcwfs(1).
#include "studies/command_line/manual_page.hpp"

#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/settings/configuration.hpp"
#include "tests/scratch_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <regex>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::HasSubstr;

class ManualPage : public ScratchFolder {};

/// A word as roff has it.
std::string bold(const std::string& word) {
  return "\\fB" + std::regex_replace(word, std::regex("-"), "\\-") + "\\fR";
}

TEST_F(ManualPage, HasEveryCommandOptionAndKey) {
  const std::string page = manual_page();
  for (const Command& command : commands()) {
    EXPECT_THAT(page, HasSubstr(".TP\n" + bold(command.name)));
  }
  for (const ProgramOption& option : program_options()) {
    EXPECT_THAT(page, HasSubstr(".TP\n" + bold("--" + option.name)));
  }
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_THAT(page, HasSubstr(".TP\n" + bold("--" + key.name)));
  }
}

TEST_F(ManualPage, IsReadWithoutComplaints) {
  if (std::system("command -v mandoc > mandoc.txt") != 0) GTEST_SKIP() << "mandoc is not installed";
  std::ofstream("nlcwfs.1") << manual_page();
  EXPECT_EQ(std::system("mandoc -T lint -W all nlcwfs.1 > complaints.txt 2>&1"), 0)
      << contents("complaints.txt");
  EXPECT_EQ(std::system("mandoc -T ascii nlcwfs.1 | col -b > page.txt"), 0);
  // What roff would have taken for its own is still there.
  EXPECT_THAT(contents("page.txt"), HasSubstr("becomes A + beta (A -"));
}

}  // namespace
}  // namespace nlcwfs
