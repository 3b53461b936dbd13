// Tests: What lets a shell complete commands, keys and their words.
#include "studies/command_line/shell_completion.hpp"

#include "studies/command_line/program_options.hpp"
#include "studies/commands/commands.hpp"
#include "studies/settings/configuration.hpp"
#include "tests/scratch_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

class ShellCompletion : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    std::ofstream("nlcwfs.bash") << shell_completion("bash");
  }

  /// What a real bash offers for the last of the words.
  static std::vector<std::string> offered(const std::string& words) {
    std::ofstream("ask.bash") << "source ./nlcwfs.bash\n"
                                 "compopt() { :; }  # only while a key is pressed\n"
                                 "COMP_WORDS=("
                              << words
                              << ")\n"
                                 "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                                 "$(complete -p nlcwfs | sed 's/.*-F \\([^ ]*\\) .*/\\1/')\n"
                                 "printf '%s\\n' \"${COMPREPLY[@]}\"\n";
    EXPECT_EQ(std::system("bash --norc ask.bash > offered.txt 2> errors.txt"), 0);
    EXPECT_EQ(contents("errors.txt"), "");
    std::vector<std::string> lines;
    std::istringstream text(contents("offered.txt"));
    for (std::string line; std::getline(text, line);) {
      if (!line.empty()) lines.push_back(line);
    }
    return lines;
  }
};

TEST_F(ShellCompletion, OffersCommands) {
  EXPECT_THAT(offered("nlcwfs ''"), UnorderedElementsAreArray(command_names()));
  EXPECT_THAT(offered("nlcwfs opt"), ElementsAre("optimize"));
  EXPECT_THAT(offered("nlcwfs --quiet opt"), ElementsAre("optimize"));
  EXPECT_THAT(offered("nlcwfs --he"), ElementsAre("--help"));
}

TEST_F(ShellCompletion, OffersTheKeysAndOptionsThatTheCommandTakes) {
  EXPECT_THAT(offered("nlcwfs evaluate --telescope.d"), ElementsAre("--telescope.diameter"));
  for (const Command& command : commands()) {
    std::vector<std::string> expected;
    for (const ProgramOption& option : program_options()) {
      if (option.is_of(command)) expected.push_back("--" + option.name);
    }
    for (const ConfigurationKey& key : configuration_keys()) {
      if (command.reads(key.name)) expected.push_back("--" + key.name);
    }
    EXPECT_THAT(offered("nlcwfs " + command.name + " --"), UnorderedElementsAreArray(expected));
  }
}

TEST_F(ShellCompletion, OffersTheWordsOfAChoice) {
  EXPECT_THAT(offered("nlcwfs evaluate --simulation.truth ''"),
              ElementsAre("extended", "matched", "periodic"));
  EXPECT_THAT(offered("nlcwfs evaluate --simulation.truth m"), ElementsAre("matched"));
  EXPECT_THAT(offered("nlcwfs evaluate --simulation.truth ="),
              ElementsAre("extended", "matched", "periodic"));
  EXPECT_THAT(offered("nlcwfs evaluate --simulation.truth = m"), ElementsAre("matched"));
  EXPECT_THAT(offered("nlcwfs evaluate --preset ''"), ElementsAre("paper"));
  EXPECT_THAT(offered("nlcwfs export --export.formats ''"), ElementsAre("csv", "json", "fits"));
  EXPECT_THAT(offered("nlcwfs optimize --search.optimizer d"),
              ElementsAre("dlib", "direct_l", "direct_l_rand"));
  EXPECT_THAT(offered("nlcwfs optimize --search.order ''"), ElementsAre("all"));
  EXPECT_THAT(offered("nlcwfs trade --trade.objectives plane"), ElementsAre("plane_count"));
  EXPECT_THAT(offered("nlcwfs optimize --objective.limits lat"), ElementsAre("latency_seconds"));
  EXPECT_THAT(offered("nlcwfs reproduce --figure ''"), Contains("3"));
  EXPECT_THAT(offered("nlcwfs completion ''"), ElementsAre("bash", "zsh", "fish"));
  EXPECT_THAT(offered("nlcwfs evaluate --telescope.diameter ''"), IsEmpty());
}

TEST_F(ShellCompletion, OffersFilesAndFolders) {
  std::ofstream("my telescope.cfg") << "";
  std::filesystem::create_directory("my run");
  EXPECT_THAT(offered("nlcwfs evaluate --config my"),
              UnorderedElementsAre("my telescope.cfg", "my run"));
  EXPECT_THAT(offered("nlcwfs evaluate --screens.file my"), Contains("my telescope.cfg"));
  EXPECT_THAT(offered("nlcwfs sweep --resume my"), ElementsAre("my run"));
  EXPECT_THAT(offered("nlcwfs compare my"), ElementsAre("my run"));
  EXPECT_THAT(offered("nlcwfs compare 'my run' my"), ElementsAre("my run"));
  EXPECT_THAT(offered("nlcwfs evaluate my"), IsEmpty());
}

TEST_F(ShellCompletion, IsFoundByTheCompletionsOfBash) {
  const std::string package = "/usr/share/bash-completion/bash_completion";
  if (!std::filesystem::exists(package)) GTEST_SKIP() << "bash-completion is not installed";
  std::filesystem::create_directories("share/bash-completion/completions");
  std::filesystem::copy("nlcwfs.bash", "share/bash-completion/completions/nlcwfs");
  std::ofstream("load.bash") << "export XDG_DATA_DIRS=$PWD/share\nsource " << package
                             << "\n_completion_loader nlcwfs\ncomplete -p nlcwfs\n";
  // The loader's own status asks the shell to look again.
  EXPECT_EQ(std::system("bash --norc load.bash > loaded.txt 2> errors.txt"), 0)
      << contents("errors.txt");
  EXPECT_EQ(contents("loaded.txt"), "complete -F _nlcwfs nlcwfs\n");
}

TEST_F(ShellCompletion, OfEveryShellHasEveryCommandAndKey) {
  for (const std::string& shell : completed_shells()) {
    const std::string script = shell_completion(shell);
    for (const Command& command : commands()) EXPECT_THAT(script, HasSubstr(command.name));
    for (const ConfigurationKey& key : configuration_keys()) {
      EXPECT_THAT(script, HasSubstr(key.name)) << shell;
    }
  }
  // Where a shell is there, it reads its script.
  for (const std::string shell : {"zsh", "fish"}) {
    if (std::system(fmt::format("command -v {} > found.txt", shell).c_str()) != 0) continue;
    std::ofstream("script") << shell_completion(shell);
    EXPECT_EQ(std::system(fmt::format("{} -n script", shell).c_str()), 0);
  }
}

}  // namespace
}  // namespace nlcwfs
