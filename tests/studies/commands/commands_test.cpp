// Tests: The list of commands.
#include "studies/commands/commands.hpp"

#include "results/archive/archive.hpp"
#include "studies/command_line/command_line.hpp"
#include "tests/studies/program.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::IsEmpty;

using Names = std::set<std::string, std::less<>>;

class CommandTable : public Program {
 protected:
  static Request parsed(const std::vector<std::string>& words) {
    std::vector<const char*> arguments{"nlcwfs"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
  }

  /// Runs a command on the tiny configuration and adds the keys that it asks for.
  static void note_reads(const std::string& name, const Arguments& more, Names& reads) {
    static int runs = 0;
    Arguments words{name, "--config", "base.cfg", "--output", fmt::format("run-{}", ++runs)};
    words.insert(words.end(), more.begin(), more.end());
    Request command_line = parsed(words);
    command_line.silent = true;
    command_line.log_level = LogLevel::error;
    command_line.configuration.note_reads_in(reads);
    testing::internal::CaptureStdout();
    command_of(name).run(command_line);
    testing::internal::GetCapturedStdout();
  }

  static Names listed(const Command& command) {
    Names keys;
    for (const ConfigurationKey& key : configuration_keys()) {
      if (command.reads(key.name)) keys.insert(key.name);
    }
    return keys;
  }
};

Names difference(const Names& a, const Names& b) {
  Names only_a;
  std::ranges::set_difference(a, b, std::inserter(only_a, only_a.end()));
  return only_a;
}

TEST_F(CommandTable, ReadTheKeysThatTheirHelpLists) {
  // The tiny configuration without its sweep, which the free layout does not take.
  std::ofstream("base.cfg") << contents("tiny.cfg").substr(0, contents("tiny.cfg").find("[sweep]"));
  // What decides on other keys, beside the tiny configuration's own.
  const std::map<std::string, std::vector<Arguments>> variants{
      {"evaluate",
       {{},
        {"--seeing.fwhm", "1"},
        {"--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"}}},
      {"convergence",
       {{},
        {"--seeing.fwhm", "1"},
        {"--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"}}},
      {"response",
       {{},
        {"--seeing.fwhm", "1"},
        {"--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"}}},
      {"screens", {{}, {"--seeing.fwhm", "1"}, {"--seeing.fried_parameter", "12cm"}}},
      {"scale", {{"--scale.diameter", "1m"}, {"--scale.diameter", "1m", "--seeing.fwhm", "1"}}},
      {"sweep",
       {{"--sweep.z_near", "30km,60km"},
        {"--sweep.z_near", "30km,60km", "--seeing.fwhm", "1"},
        {"--sweep.layout", "free", "--sweep.z1", "30km,60km"},
        {"--sweep.z_near", "30km", "--source.bands", "500nm:600nm", "--seeing.fried_parameter",
         "12cm"}}},
      {"optimize",
       {{},
        {"--seeing.fwhm", "1"},
        {"--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"},
        {"--search.cheap_budget", "6"},
        {"--search.layout", "free"}}},
      {"trade",
       {{"--trade.budget", "8"},
        {"--trade.budget", "8", "--seeing.fwhm", "1"},
        {"--trade.budget", "8", "--source.bands", "500nm:600nm", "--seeing.fried_parameter",
         "12cm"},
        {"--trade.budget", "8", "--search.layout", "free", "--search.z1", "30km:60km"}}},
      {"law", {{"--law.d_over_r0", "3,4,6,8"}}},
      {"advise",
       {{"--verify"},
        {"--verify", "--seeing.fwhm", "1"},
        {"--verify", "--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"}}},
      {"benchmark",
       {{},
        {"--seeing.fwhm", "1"},
        {"--source.bands", "500nm:600nm", "--seeing.fried_parameter", "12cm"}}}};
  for (const auto& [name, runs] : variants) {
    Names reads;
    for (const Arguments& more : runs) note_reads(name, more, reads);
    if (name == "optimize") reads.insert("search.cheap_screens");  // handed on as a text
    if (name == "law") {  // gives the seeing itself, and asks where it comes from
      for (const char* key : {"seeing.d_over_r0", "seeing.fried_parameter", "seeing.fwhm"}) {
        reads.erase(key);
      }
    }
    const Names keys = listed(command_of(name));
    EXPECT_THAT(difference(reads, keys), IsEmpty()) << name << " reads what its help does not list";
    EXPECT_THAT(difference(keys, reads), IsEmpty()) << name << " does not read what its help lists";
  }
}

TEST_F(CommandTable, HaveExamplesThatTheCommandLineTakes) {
  std::filesystem::create_directories("results/optimize-1");
  std::filesystem::create_directories("results/sweep-1");
  const std::string everything = Configuration().dump();
  for (const char* file : {"results/optimize-1/best.cfg", "results/sweep-1/config.cfg"}) {
    std::ofstream(file) << everything;
  }
  (void)Archive("results/sweep-1/archive.sqlite", "sweep");
  for (const Command& command : commands()) {
    ASSERT_NE(command.run, nullptr) << command.name;
    for (const std::string& example : command.examples) {
      // What a shell does with the output is not the program's.
      std::istringstream text(example.substr(0, example.find_first_of("|>")));
      std::vector<std::string> words;
      for (std::string word; text >> word;) words.push_back(word);
      words.erase(words.begin());
      const Request command_line = parsed(words);
      EXPECT_EQ(command_line.command->name, command.name);
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
  EXPECT_THAT(finished.output,
              testing::StartsWith("note: screens does not use search.budget; nlcwfs "
                                  "screens --help lists what it uses\n"));
  // A file serves several commands.
  std::ofstream("search.cfg") << "[search]\nbudget = 9\n";
  EXPECT_THAT(done("screens", "run-2", {"--config", "search.cfg"}).output,
              testing::Not(testing::HasSubstr("does not use")));
}

}  // namespace
}  // namespace nlcwfs
