#include "studies/commands.hpp"

#include "studies/command_line.hpp"
#include "tests/studies/program.hpp"

#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

class CommandTable : public Program {
 protected:
  static CommandLine parsed(std::vector<std::string> words) {
    std::vector<const char*> arguments{"nlcwfs"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
  }
};

TEST_F(CommandTable, HaveExamplesThatTheCommandLineTakes) {
  std::filesystem::create_directories("results/optimize-1");
  std::filesystem::create_directories("results/sweep-1");
  const std::string everything = Configuration().dump();
  for (const char* file : {"results/optimize-1/best.cfg", "results/sweep-1/config.cfg",
                           "results/sweep-1/archive.sqlite"}) {
    std::ofstream(file) << everything;
  }
  for (const Command& command : commands()) {
    ASSERT_NE(command.run, nullptr) << command.name;
    for (const std::string& example : command.examples) {
      // What a shell does with the output is not the program's.
      std::istringstream text(example.substr(0, example.find_first_of("|>")));
      std::vector<std::string> words;
      for (std::string word; text >> word;) words.push_back(word);
      words.erase(words.begin());
      const CommandLine command_line = parsed(words);
      EXPECT_EQ(command_line.command, command.name);
      for (const ConfigurationKey& key : configuration_keys()) {
        if (command_line.configuration.source(key.name) == "on the command line") {
          EXPECT_TRUE(command.reads(key.name)) << example;
        }
      }
    }
  }
}

TEST_F(CommandTable, SayWhichKeysTheyIgnore) {
  const ProgramRun finished =
      run({"screens", "--config", "tiny.cfg", "--search.budget", "9", "--output", "run"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.errors,
            "nlcwfs: note: screens does not use search.budget; nlcwfs screens "
            "--help lists what it uses\n");
  // A file serves several commands.
  std::ofstream("search.cfg") << "[search]\nbudget = 9\n";
  EXPECT_EQ(done("screens", "run-2", {"--config", "search.cfg"}).errors, "");
}

}  // namespace
}  // namespace nlcwfs
