// Tests: the documents' commands, links and lists of files hold.
#include "tests/studies/program.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::SizeIs;

/// What stands between fences of a Markdown file.
struct Block {
  std::string language;  ///< behind the opening fence
  std::string before;    ///< the last line of text before the block
  std::string text;
};

/// A Markdown file, apart into text and fenced blocks.
struct Document {
  fs::path path;
  std::string text;  ///< without the blocks
  std::vector<Block> blocks;
};

Document document(const fs::path& path) {
  Document document{.path = path, .text = {}, .blocks = {}};
  std::istringstream lines(contents(path));
  std::string before;
  bool in_block = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      in_block = !in_block;
      if (in_block) document.blocks.push_back({line.substr(3), before, {}});
    } else if (in_block) {
      document.blocks.back().text += line + '\n';
    } else {
      document.text += line + '\n';
      if (!line.empty()) before = line;
    }
  }
  return document;
}

/// Every document of the project that people read.
std::vector<Document> documents() {
  std::vector<fs::path> paths;
  for (const char* folder : {"", "docs", "examples", "benchmarks", "results/reference"}) {
    for (const auto& entry : fs::directory_iterator(source_folder() / folder)) {
      if (entry.path().extension() == ".md") paths.push_back(entry.path());
    }
  }
  std::ranges::sort(paths);
  std::vector<Document> all;
  for (const fs::path& path : paths) all.push_back(document(path));
  return all;
}

/// The commands of a block or a text that begin with ./nlcwfs, each on one line.
std::vector<std::string> commands_in(const Document& document) {
  std::vector<std::string> commands;
  for (const Block& block : document.blocks) {
    const std::string joined = std::regex_replace(block.text, std::regex(R"(\\\n *)"), "");
    std::istringstream lines(joined);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("./nlcwfs ")) commands.push_back(line);
    }
  }
  const std::regex inline_code("`(\\./nlcwfs [^`]*)`");
  for (std::sregex_iterator match(document.text.begin(), document.text.end(), inline_code), end;
       match != end; ++match) {
    commands.push_back((*match)[1]);
  }
  return commands;
}

/// Runs commands of documents as they stand, in a folder where ./nlcwfs is the program.
class Documents : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    fs::create_symlink(program_path(), "nlcwfs");
  }

  static ProgramRun shell(const std::string& command) {
    std::ofstream("command.sh") << command << '\n';
    const int status = std::system("sh ./command.sh > output.txt 2> errors.txt");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents("output.txt"),
            contents("errors.txt")};
  }
};

TEST_F(Documents, EveryCommandLineIsValid) {
  // Files that an earlier command would have left.
  for (const char* folder : {"results/optimize-1", "results/sweep-1", "results/bright",
                             "results/faint", "results/both"}) {
    fs::create_directories(folder);
    std::ofstream(fs::path(folder) / "best.cfg") << "[screens]\ncount = 2\n";
    std::ofstream(fs::path(folder) / "config.cfg") << "[screens]\ncount = 2\n";
    std::ofstream(fs::path(folder) / "archive.sqlite") << "";
  }
  std::ofstream("telescope.cfg") << "[telescope]\ndiameter = 1.8m\n";
  std::size_t tried = 0;
  for (const Document& document : documents()) {
    for (const std::string& command : commands_in(document)) {
      const ProgramRun finished = shell(command + " --dump-config");
      EXPECT_EQ(finished.exit_code, 0) << document.path << ": " << command << '\n'
                                       << finished.errors;
      ++tried;
    }
  }
  EXPECT_GT(tried, 30U) << "the documents are not found, or read wrongly";
}

TEST_F(Documents, EveryLinkLeadsToAFile) {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  std::size_t tried = 0;
  for (const Document& document : documents()) {
    for (std::sregex_iterator match(document.text.begin(), document.text.end(), link), end;
         match != end; ++match) {
      const std::string target = (*match)[1];
      EXPECT_TRUE(fs::exists(document.path.parent_path() / target))
          << document.path << ": " << target;
      ++tried;
    }
  }
  EXPECT_GT(tried, 5U);
}

/// What a table of docs/files.md says of the files of a run: by the name of a file, the commands
/// that leave it; those that all leave are of no command.
std::map<std::string, std::set<std::string>> documented_files() {
  std::map<std::string, std::set<std::string>> files;
  std::istringstream lines(document(source_folder() / "docs/files.md").text);
  const std::regex row(R"(\| (`[^|]*`) \| ([^|]*)\|.*)");
  const std::regex word("`([^`]+)`");
  for (std::string line; std::getline(lines, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    std::set<std::string> takers;
    const std::string before_colon = cells[2].str().substr(0, cells[2].str().find(':'));
    for (std::sregex_iterator match(before_colon.begin(), before_colon.end(), word), end;
         match != end; ++match) {
      const std::string name = (*match)[1].str().substr(0, (*match)[1].str().find(' '));
      if (find_command(name) != nullptr) takers.insert(name);
    }
    const std::string names = cells[1];
    for (std::sregex_iterator match(names.begin(), names.end(), word), end; match != end; ++match) {
      files[(*match)[1]].insert(takers.begin(), takers.end());
    }
  }
  return files;
}

TEST_F(Documents, EveryFileOfARunIsInTheListOfFiles) {
  std::map<std::string, std::set<std::string>> known;
  for (const RunFile& file : common_files()) known[file.name];
  for (const Command& command : commands()) {
    // Pictures are told of by their SVG.
    for (const RunFile& file : command.files) {
      if (!file.name.ends_with(".png")) known[file.name].insert(command.name);
    }
  }
  EXPECT_EQ(documented_files(), known);
}

/// The tutorial from its first command to its last, on fewer and coarser screens: ./nlcwfs is a
/// script that lays small.cfg over what the tutorial's own files say.
TEST_F(Documents, TheTutorialRunsFromBeginningToEnd) {
  fs::remove("nlcwfs");
  std::ofstream("small.cfg") << "[detector]\npupil_pixels = 16\nwindow = 2\n"
                                "[reconstruction]\nwindow = 4\nmax_loops = 5\n"
                                "[simulation]\npupil_samples = 32\n"
                                "[screens]\ncount = 2\n"
                                "[verify]\nscreens = 2\n"
                                "[search]\nbudget = 6\n";
  std::ofstream("nlcwfs") << "#!/bin/sh\n"
                             "case $* in *--config*) small='--config small.cfg' ;; esac\n"
                             "exec '"
                          << program_path() << "' \"$@\" $small\n";
  fs::permissions("nlcwfs", fs::perms::owner_all);

  const Document tutorial = document(source_folder() / "docs/tutorial.md");
  std::size_t commands = 0;
  for (const Block& block : tutorial.blocks) {
    if (block.language == "ini") {
      std::smatch name;
      ASSERT_TRUE(std::regex_search(block.before, name, std::regex("`([a-z]+\\.cfg)`")))
          << "the line before a file's contents names the file: " << block.before;
      std::ofstream(name[1].str()) << block.text;
    } else if (block.language == "sh") {
      const ProgramRun finished = shell("set -e\n" + block.text);
      EXPECT_EQ(finished.exit_code, 0) << block.text << finished.output << finished.errors;
      ++commands;
    } else {
      EXPECT_EQ(block.language, "") << "neither a file, a command nor its output";
    }
  }
  EXPECT_GT(commands, 6U);
  // Every file that the text promises is there.
  const std::regex promised("`(results/[^`]*\\.[a-z]+)`");
  for (std::sregex_iterator match(tutorial.text.begin(), tutorial.text.end(), promised), end;
       match != end; ++match) {
    const std::string file = (*match)[1];
    EXPECT_TRUE(fs::exists(file)) << file;
  }
}

}  // namespace
}  // namespace nlcwfs
